"""Knees and hands that come down to the ground, and may carry a body there."""

from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.cast import Character
from usdmotion.constraints import ContactConstraint
from usdmotion.kernels import forward, rotate
from usdmotion.s4d import Held, Morphology
from usdmotion.travelling import Meanings, Traveller

_PARTS = tuple(f"{side}_{part}" for side in "lr" for part in ("knee", "radiocarpal"))
_NEAR = 0.1
"""A joint no higher than this above the lowest place of all joints is near the ground, over the
length of a leg."""


def low_joints(
    character: Character, body: Morphology, up: Floats, held: Collection[str] = ()
) -> tuple[str, ...]:
    """Return the tokens of the knees and wrists that come near the ground at some time.

    Where something is asked of any of them, who asked knows what carries the body: there are none.

    Args:
        character: Who moves.
        body: The body that it is.
        up: The direction away from the ground, shape (3,).
        held: H-Anim names of the joints of which something is asked.
    """
    if not set(held).isdisjoint(_PARTS):
        return ()
    heights, most = _heights(character, body, up)
    joints = [joint for joint in map(body.parts.joint, _PARTS) if joint is not None]
    low = [joint for joint in joints if heights[:, joint].min() <= most]
    return tuple(body.skeleton.joints[joint] for joint in low)


def on_ground(
    travellers: Sequence[Traveller],
    found: Sequence[str],
    meanings: Meanings,
    character: Character,
    body: Morphology,
    up: Floats,
) -> tuple[tuple[Traveller, ...], list[Held]]:
    """Return what is to travel, its knees and hands on the ground only, and what these carry.

    Who stands still holds his knees still too, and nobody wants them held. On the ground knees and
    hands are held as points, since how shanks lie depends on how long they are. Who rests on a knee
    does so between two contacts too, as long as it stays low.

    Args:
        travellers: Constraints on the body.
        found: What the names of contacts begin with that nobody has asked for.
        meanings: What parts mean on it.
        character: Who moves.
        body: The body.
        up: The direction away from the ground, shape (3,).

    Returns:
        Constraints, and the parts on the ground with the times for which they are [s].
    """
    heights, most = _heights(character, body, up)
    times = character.motion.times
    kept: list[Traveller] = []
    held: dict[Held, None] = {}
    for each in travellers:
        contact = each.constraint
        joint = meanings.named(contact.joint) if contact.joint else None
        is_one = joint is not None and body.parts.parts[joint] in _PARTS
        if not is_one or not each.name.startswith(tuple(found)):
            kept.append(each)
            continue
        assert isinstance(contact, ContactConstraint) and joint is not None
        start, end = np.searchsorted(times, contact.held(times)).clip(0, len(times) - 1)
        low = heights[:, joint] <= most
        if low[start : end + 1].all():
            high = np.flatnonzero(~low)
            first = times[int(high[high < start].max(initial=-1)) + 1]
            last = times[int(high[high > end].min(initial=len(times))) - 1]
            # It comes to its place while it is down already and not quite still.
            eased = (min(contact.times[0], float(first)), *contact.times[1:])
            kept.append(replace(each, constraint=replace(contact, kind="point", times=eased)))
            held[body.parts.parts[joint], float(first), float(last)] = None
    return tuple(kept), list(held)


def _heights(character: Character, body: Morphology, up: Floats) -> tuple[Floats, float]:
    """Return how high joints are [m], (F, joint_count), and how high they are near the ground."""
    motion, placement = character.motion, character.placement
    places, _ = forward(body.skeleton.parents, motion.translations, motion.rotations)
    world = rotate(placement.rotations[:, None], places) + placement.translations[:, None]
    heights = np.asarray(world @ (up / np.linalg.norm(up)))
    return heights, float(heights.min()) + _NEAR * body.leg_length
