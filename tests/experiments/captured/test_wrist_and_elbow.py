"""2005, figure 13, on captured arms: the wrist has its place, the elbow what its circle leaves."""

from dataclasses import dataclass

import numpy as np
import pytest

from usdmotion.arrays import Floats
from usdmotion.constraints import Goal, PositionConstraint

ARM = ("l_shoulder", "l_elbow", "l_radiocarpal")
STRETCH = 0.8
"""How far the wrist is to be from the shoulder, over the length of the arm."""
SWING, TURN = np.radians((25.0, 60.0))
"""How far the wrist swings about the shoulder, and the elbow turns about both."""
BEYOND = 0.5
"""How far out of its circle an elbow is asked to be, over the circle's radius."""


@dataclass(frozen=True, eq=False)
class Places:
    """Where wrist and elbow are to be on each frame [m], each of shape (F, 3)."""

    wrist: Floats
    on_circle: Floats
    beyond: Floats


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def across(vectors, axes):
    return vectors - np.sum(vectors * axes, axis=-1, keepdims=True) * axes


@pytest.fixture(scope="module")
def keys(clip):
    return clip.keys(clip.calm(ARM[2]))


@pytest.fixture(scope="module")
def places(clip):
    shoulder, elbow, wrist = (clip.take.point(clip.token(part)) for part in ARM)
    upper, lower = (
        np.linalg.norm(b - a, axis=1, keepdims=True) for a, b in ((shoulder, elbow), (elbow, wrist))
    )
    way = unit(wrist - shoulder)
    toward = unit(across(clip.ahead(clip.calm(ARM[2])) + clip.up, way))
    axis = np.cos(SWING) * way + np.sin(SWING) * toward
    distance = STRETCH * (upper + lower)
    ahead = (upper**2 - lower**2 + distance**2) / (2.0 * distance)
    radius = np.sqrt(upper**2 - ahead**2)
    side = unit(across(elbow - shoulder, axis))
    out = np.cos(TURN) * side + np.sin(TURN) * np.cross(axis, side)
    center = shoulder + ahead * axis
    return Places(
        shoulder + distance * axis, center + radius * out, center + (1.0 + BEYOND) * radius * out
    )


@pytest.fixture(scope="module", params=["on_circle", "beyond"])
def solved(request, clip, ask, keys, places):
    goals = {"l_elbow": getattr(places, request.param), "l_radiocarpal": places.wrist}
    constraints = [
        PositionConstraint(
            path=part,
            skeleton=clip.skeleton,
            joint=clip.token(part),
            priority={"l_radiocarpal": 1, "l_elbow": 2}[part],
            recruits=tuple(clip.token(each) for each in ARM[:2]),
            goals=(Goal(path="Place", translation=place, times=keys),),
        )
        for part, place in goals.items()
    ]
    return ask(clip, constraints, solver="ccd")


def test_the_wrist_is_at_its_place_and_the_elbow_as_near_as_the_circle_allows(
    clip, solved, keys, places
):
    there = clip.within(keys)
    for part, place in (("l_radiocarpal", places.wrist), ("l_elbow", places.on_circle)):
        missed = solved.after.point(clip.token(part)) - place
        assert solved.millimetres(missed[there]) <= 1.0
