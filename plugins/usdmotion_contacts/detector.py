"""The detector as the host sees it (2006)."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from usdmotion import Contact, Detected, NoisePattern, OptionError, Search, Template, option
from usdmotion_contacts.clock import restored, slowed
from usdmotion_contacts.displacements import SLACK, displacements
from usdmotion_contacts.estimate import estimate
from usdmotion_contacts.instants import at_rest, turning
from usdmotion_contacts.merging import left_of
from usdmotion_contacts.pattern import is_taught, pattern_of, taught, taught_by
from usdmotion_contacts.places import places
from usdmotion_contacts.projection import SigmaEpsilon, project
from usdmotion_contacts.settling import settle
from usdmotion_contacts.sliding import slides
from usdmotion_contacts.stacking import LINE, POINT
from usdmotion_contacts.turning import turns

KINDS = ("space", "line", "point", "plane", "slide")
"""What it looks for."""


@dataclass(frozen=True)
class ContactDetector:
    """Finds where an object is stationary, or turns about a line or a point, in spite of noise."""

    name: ClassVar[str] = "contacts"

    clock: float = option(
        1.0,
        "Speed at which the motion is looked at: below 1, as with 0.25, taps are found that are "
        "too quick otherwise, or that are taken for one.",
        minimum=0.01,
        maximum=1.0,
    )
    reach: float = option(
        1.5,
        "How far from the middle of an object a line or point may be, in sizes of it: a foot that "
        "swings about its knee touches nothing. 0 allows any distance.",
        minimum=0.0,
    )
    rounds: int = option(
        0,
        "How often what was found is taken for examples, to look again: a foot is then held while "
        "it stands, and not while it sets down or rolls off.",
        minimum=0,
        maximum=5,
    )

    def detect(self, search: Search) -> Detected:
        """Return what an object obeys.

        Raises:
            OptionError: It cannot look for one of the kinds; the sentence lists what it can.
        """
        for kind in search.kinds:
            if kind not in KINDS:
                raise OptionError(
                    f"the detector '{self.name}' cannot look for '{kind}'; it looks for "
                    + ", ".join(KINDS)
                )
        found = self._looked(search)
        left_out = found.left_out
        for _ in range(self.rounds):
            found = self._looked(taught_by(search, found))
        return replace(found, left_out=left_out)

    def _looked(self, search: Search) -> Detected:
        if self.clock < 1.0 and len(search.times) > 1:
            slow = slowed(search, self.clock)
            return restored(self._detected(slow), self.clock, slow, search)
        return self._detected(search)

    def _detected(self, search: Search) -> Detected:
        """Return what an object obeys, step by step as in the paper's section 3.2."""
        points = project(displacements(search))
        if not points.displacements.count:
            step = points.displacements.step
            note = f"'{search.name}' has no two samples {step:g} s apart"
            reason = f"it holds no step of {step:g} s"
            left_out = dict.fromkeys(search.templates, reason)
            return Detected((), search.pattern, (note,), left_out)
        pattern, left_out = _pattern(search, points)
        contacts = []
        if {"line", "point"} & set(search.kinds):
            turned = _turns(search, points, pattern)
            contacts = [each for each in turned if _is_near(search, each, self.reach)]
        if "space" in search.kinds:
            contacts += _spaces(search, points, pattern, contacts)
        for kind in ("plane", "slide"):
            if kind in search.kinds:
                epsilon = pattern.epsilon.at(search.times)
                contacts += slides(search, points.displacements, kind, epsilon)
        contacts.sort(key=lambda each: (each.start, KINDS.index(each.kind)))
        return Detected(tuple(contacts), pattern, left_out=left_out)


def _pattern(search: Search, points: SigmaEpsilon) -> tuple[NoisePattern, dict[Template, str]]:
    """Return the noise pattern of the templates, else the one given, else an estimated one.

    With it are the templates that say nothing, and why.
    """
    noises, left_out = taught(search, points)
    if is_taught(noises):
        return pattern_of(noises, None), left_out
    otherwise = search.pattern or estimate(search, points)
    return (pattern_of(noises, otherwise) if noises else otherwise), left_out


def _spaces(
    search: Search, points: SigmaEpsilon, pattern: NoisePattern, turned: list[Contact]
) -> list[Contact]:
    """Return where an object rests, but for the moments at which a turn goes the other way."""
    resting = at_rest(search, points, pattern)
    groups, owners = places(search, points.displacements, resting, pattern)
    origins = np.zeros((len(groups.into), 3))
    contacts = settle(search, "space", groups, left_of(groups), owners, origins, origins)
    moment = 2.0 * points.displacements.step - SLACK
    return [
        each
        for each in contacts
        if each.end - each.start >= moment
        or not any(one.start <= each.start and each.end <= one.end for one in turned)
    ]


def _turns(search: Search, points: SigmaEpsilon, pattern: NoisePattern) -> list[Contact]:
    """Return the lines and points that it turns about."""
    moves, contacts = points.displacements, []
    found = turns(search, moves, turning(search, points, pattern), pattern)
    for kind, number in (("line", LINE), ("point", POINT)):
        left = left_of(found.groups)
        left = left[found.kinds[left] == number]
        if kind in search.kinds:
            contacts += settle(
                search, kind, found.groups, left, found.owners, found.points, found.axes
            )
    return contacts


def _is_near(search: Search, contact: Contact, reach: float) -> bool:
    """Return whether the held point is near an object, unless nobody knows how large that is."""
    size = float(np.ptp(search.points, axis=0).max())
    away = float(np.linalg.norm(contact.point - search.points.mean(axis=0)))
    return reach * size == 0.0 or away <= reach * size
