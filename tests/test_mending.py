"""The recruiting rule over scenes: who breaks it by name, and a scene in which nobody does."""

from dataclasses import replace

import numpy as np

from usdmotion import Goal, PositionConstraint, Scene
from usdmotion.mending import broken, mended, sentence
from usdmotion.testing import HUMANOID, humanoid_scene

ANKLE = "pelvis/left_hip/left_knee/left_ankle"
WRIST = "pelvis/spine/chest/left_shoulder/left_elbow/left_wrist"
LEG = ("pelvis/left_hip", "pelvis/left_hip/left_knee", ANKLE)
FOOT = PositionConstraint(
    path="/Humanoid/Edit/foot", skeleton=HUMANOID, joint=ANKLE, priority=1, recruits=LEG
)
HAND = PositionConstraint(path="/Humanoid/Edit/hand", skeleton=HUMANOID, joint=WRIST, priority=2)


def recruits(scene: Scene) -> dict[str, tuple[str, ...]]:
    return {each.path: each.recruits for each in scene.constraints}


def test_a_hand_that_moves_the_pelvis_above_a_foot_is_named_with_what_mends_it() -> None:
    (found,) = broken(humanoid_scene([FOOT, HAND]))
    assert (found.high, found.low, found.joints) == (FOOT.path, HAND.path, ("pelvis",))
    assert "let </Humanoid/Edit/foot> recruit pelvis" in sentence(found)


def test_a_scene_that_keeps_the_rule_is_left_as_it_is() -> None:
    kept = humanoid_scene([replace(FOOT, recruits=()), HAND])
    assert broken(kept) == []
    assert recruits(mended(kept)) == recruits(kept)


def test_a_mended_scene_keeps_the_rule_with_the_fewest_joints_more() -> None:
    scene = mended(humanoid_scene([FOOT, HAND]))
    assert broken(scene) == []
    assert recruits(scene) == {FOOT.path: ("pelvis", *LEG), HAND.path: ()}


def test_equal_ranks_break_nothing() -> None:
    assert broken(humanoid_scene([FOOT, replace(HAND, priority=1)])) == []


def test_a_goal_that_rides_on_a_joint_counts_as_what_can_be_moved() -> None:
    riding = replace(
        HAND,
        priority=1,
        recruits=(WRIST,),
        goals=(Goal(joint=(HUMANOID, ANKLE), translation=np.zeros(3)),),
    )
    scene = humanoid_scene([riding, replace(FOOT, priority=2)])
    (found,) = broken(scene)
    assert (found.high, found.joints) == (HAND.path, LEG)
    assert broken(mended(scene)) == []
