"""2003, figure 7: arms that are raised against the thorax, whatever the body does meanwhile."""

import numpy as np
import pytest

from usdmotion.constraints import Goal, PositionConstraint

ARM = ("sternoclavicular", "shoulder", "elbow")
RAISED = (0.9, 0.35, 0.25)
"""Where upper arms point: outward, up, ahead."""
BENT = (0.2, 0.95, 0.25)
"""Where forearms point."""


@pytest.fixture(scope="module")
def keys(clip):
    return clip.keys(len(clip.take.times) // 2)


@pytest.fixture(scope="module")
def places(clip):
    """Return where elbows and wrists are to be in the frame of the thorax [m]."""
    found = {}
    for side, outward in (("l", 1.0), ("r", -1.0)):
        place = clip.at_rest(f"{side}_shoulder")
        for upper, lower, way in (("shoulder", "elbow", RAISED), ("elbow", "radiocarpal", BENT)):
            left, up, ahead = np.array(way) / np.linalg.norm(way)
            toward = clip.rest_way(outward * left, up, ahead)
            place = place + clip.length(upper, lower, side) * toward
            found[f"{side}_{lower}"] = place
    return {part: clip.in_rest_of(clip.thorax, place) for part, place in found.items()}


@pytest.fixture(scope="module")
def solved(clip, ask, keys, places):
    def hold(part, place):
        goal = Goal(path="Place", translation=place, joint=(clip.skeleton, clip.thorax), times=keys)
        return PositionConstraint(
            path=part,
            skeleton=clip.skeleton,
            joint=clip.token(part),
            recruits=tuple(clip.token(f"{part[0]}_{each}") for each in ARM),
            goals=(goal,),
        )

    return ask(clip, [hold(part, place) for part, place in places.items()])


def test_wrists_and_elbows_are_at_their_places_on_the_plateau(clip, solved, keys, places):
    for part, place in places.items():
        seen = solved.after.seen_from(clip.thorax, clip.token(part))
        assert solved.millimetres((seen - place)[clip.within(keys)]) <= 2.0


def test_the_body_moves_as_it_did(clip, solved):
    assert solved.moved(clip.thorax) == 0.0
    assert solved.turned(clip.thorax) == 0.0
