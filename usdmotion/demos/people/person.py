"""Somebody on a skeleton of somebody else's making."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from usdmotion.arrays import Floats, Ints
from usdmotion.demos.body import USUAL, Proportions, assembled, proportioned, sole
from usdmotion.demos.people.joints import segments
from usdmotion.demos.people.namings import renamed
from usdmotion.humanoid import FEET
from usdmotion.kernels import conjugate, from_vector, multiply, rotate
from usdmotion.motion import Body, Skeleton

RESTS: Mapping[str, tuple[float, float]] = {
    "T": (0.0, 0.0),
    "A": (45.0, 0.0),
    "down": (75.0, 20.0),
    "I": (90.0, 0.0),
}
"""Rest poses: how far the arms are lowered out of the T-pose, and the elbows bent [degrees]."""
_UPRIGHT = np.array((0.0, 0.0, 0.0, 1.0))


@dataclass(frozen=True, eq=False)
class Person:
    """A skeleton, the body around it, and what of it is not in its joints."""

    skeleton: Skeleton
    """Its joints [m]."""
    body: Body
    """What it weighs and how far it turns."""
    parts: tuple[str, ...]
    """H-Anim name of each joint, "" for none."""
    tip_joints: Ints
    """Joints that a segment hangs on, shape (tip_count,)."""
    tip_points: Floats
    """Where the segment ends in the joint's frame [m], shape (tip_count, 3)."""
    sole_joints: Ints
    """Left ankle and toes, right ankle and toes, shape (4,)."""
    sole_points: Floats
    """What touches the ground of each, in its frame: heel, ball, heel, ball [m], shape (4, 3)."""


def person(
    height: float = 1.7,
    *,
    mass: float = 68.0,
    proportions: Proportions = USUAL,
    naming: str = "plain",
    vertebrae: int = 3,
    finger_joints: int = 0,
    twists: bool = False,
    rest: str = "T",
    axes: int | None = None,
    z_up: bool = False,
) -> Person:
    """Return somebody who stands on the ground.

    Args:
        height: Of the body [m].
        mass: Of the body [kg].
        proportions: How it differs from the usual one.
        naming: One of `NAMINGS`.
        vertebrae: How many joints the back has, 1 to 9.
        finger_joints: How many each finger has, 0 to 3.
        twists: Whether upper arms, forearms and thighs have a joint for their twist.
        rest: The rest pose, one of `RESTS`.
        axes: A seed, with which every joint's axes are turned in a way of its own, and limits are
            lost, which are boxes along axes; None has all axes along the world's in the T-pose.
        z_up: Whether it stands along Z and faces -Y, and not along Y facing +Z.
    """
    plain = segments(vertebrae=vertebrae, finger_joints=finger_joints, twists=twists)
    grown = proportioned(plain, proportions)
    skeleton, body, parts = assembled(renamed(grown, naming), height, mass)
    under = sole(height, proportions)
    ends = height * np.array([np.subtract(s.end, s.place) for s in grown])
    joints = np.array([parts.index(part) for part in FEET])
    points = np.array([under.heel, under.ball, under.heel, under.ball])
    made = Person(skeleton, body, parts, np.arange(len(parts)), ends, joints, points)
    made = _resting(made, *RESTS[rest])
    made = made if axes is None else _turned(made, axes)
    return _raised(made) if z_up else made


def _resting(made: Person, lowered: float, bent: float) -> Person:
    """Return somebody whose rest pose has lowered arms and bent elbows [degrees]."""
    rotations = np.array(made.skeleton.rest_rotations)
    low, high = np.array(made.body.limits_min), np.array(made.body.limits_max)
    for side, sign in (("l", 1.0), ("r", -1.0)):
        shoulder, elbow = (made.parts.index(f"{side}_{part}") for part in ("shoulder", "elbow"))
        rotations[shoulder] = from_vector(np.radians((0.0, 0.0, -sign * lowered)))
        rotations[elbow] = from_vector(np.radians((0.0, -sign * bent, 0.0)))
        # Limits count from the rest pose.
        low[elbow, 1] += sign * bent
        high[elbow, 1] += sign * bent
    return replace(
        made,
        skeleton=replace(made.skeleton, rest_rotations=rotations),
        body=replace(made.body, limits_min=low, limits_max=high),
    )


def _turned(made: Person, seed: int) -> Person:
    """Return somebody the axes of whose joints lie anyhow."""
    skeleton, count = made.skeleton, len(made.parts)
    drawn = np.random.default_rng(seed).normal(size=(count, 4))
    turns = drawn / np.linalg.norm(drawn, axis=1, keepdims=True)
    above = np.where(skeleton.parents[:, None] < 0, _UPRIGHT, turns[skeleton.parents])
    into = conjugate(turns)
    free = np.full((count, 3), np.inf)
    return replace(
        made,
        skeleton=replace(
            skeleton,
            rest_translations=rotate(conjugate(above), skeleton.rest_translations),
            rest_rotations=multiply(conjugate(above), multiply(skeleton.rest_rotations, turns)),
        ),
        body=replace(
            made.body,
            mass_centers=rotate(into, made.body.mass_centers),
            limits_min=-free,
            limits_max=free,
        ),
        tip_points=rotate(into[made.tip_joints], made.tip_points),
        sole_points=rotate(into[made.sole_joints], made.sole_points),
    )


def _raised(made: Person) -> Person:
    """Return somebody who stands along Z."""
    up = from_vector(np.array((0.5 * np.pi, 0.0, 0.0)))
    translations = np.array(made.skeleton.rest_translations)
    rotations = np.array(made.skeleton.rest_rotations)
    top = made.skeleton.parents < 0
    translations[top], rotations[top] = rotate(up, translations[top]), multiply(up, rotations[top])
    return replace(
        made,
        skeleton=replace(made.skeleton, rest_translations=translations, rest_rotations=rotations),
    )
