"""A motion that is slowed down, so that what is quick in it is found (2006, section 9).

A tap may be shorter than a step, and the time between two taps so short that they are taken for
one. In a motion that plays at half the speed, with as many samples a second as before, each lasts
twice as long, while the step and what may be bridged last as long as ever.
"""

import math
from dataclasses import replace

import numpy as np

from usdmotion import Contact, Detected, Floats, NoisePattern, Search, Spline
from usdmotion.kernels import slerp
from usdmotion_contacts.displacements import SLACK


def slowed(search: Search, clock: float) -> Search:
    """Return a search in a motion that plays at some share of its speed.

    Between its samples it goes straight: that invents no motion where it rests.
    """
    steps, parts = np.diff(search.times), math.ceil(1.0 / clock)
    starts = np.repeat(np.arange(len(steps)), parts)
    shares = np.tile(np.arange(parts) / parts, len(steps))
    times, places, turns = search.times, search.translations, search.rotations
    moved = places[starts] + shares[:, None] * np.diff(places, axis=0)[starts]
    turned = slerp(turns[starts], turns[starts + 1], shares)
    return replace(
        search,
        times=np.append(times[starts] + shares * steps[starts], times[-1:]) / clock,
        translations=np.concatenate([moved, places[-1:]]),
        rotations=np.concatenate([turned, turns[-1:]]),
        templates=tuple(
            replace(each, start=each.start / clock, end=each.end / clock)
            for each in search.templates
        ),
        pattern=search.pattern and _stretched(search.pattern, 1.0 / clock),
        minimum=search.minimum / clock,
    )


def restored(detected: Detected, clock: float, slow: Search, search: Search) -> Detected:
    """Return what was found in a slowed motion as of the motion itself, from sample to sample.

    What has fewer than two of its samples was found in what is between them, and is left out.

    Args:
        detected: What was found.
        clock: At which share of its speed the motion was looked at.
        slow: The search in the slowed motion.
        search: The search that it was made of.
    """
    contacts = [_restored(each, clock, search.times) for each in detected.contacts]
    pattern = detected.pattern and _stretched(detected.pattern, clock)
    kept = tuple(each for each in contacts if each.start < each.end)
    pairs = zip(slow.templates, search.templates, strict=True)
    left_out = {own: detected.left_out[each] for each, own in pairs if each in detected.left_out}
    return Detected(kept, pattern, detected.notes, left_out)


def _restored(contact: Contact, clock: float, times: Floats) -> Contact:
    """Return a contact from the first sample that it has to the last."""
    first = np.searchsorted(times, contact.start * clock - SLACK)
    last = np.searchsorted(times, contact.end * clock + SLACK, side="right") - 1
    return replace(contact, start=float(times[first]), end=float(times[last]))


def _stretched(pattern: NoisePattern, factor: float) -> NoisePattern:
    """Return a noise pattern over times that are multiplied."""
    return NoisePattern(
        *(
            Spline(each.times * factor, each.values, each.slopes / factor)
            for each in (pattern.sigma, pattern.epsilon)
        )
    )
