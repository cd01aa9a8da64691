"""The cast: every joint of every character in one numbering."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion.cast import Cast
from usdmotion.errors import SceneError
from usdmotion.kernels import from_vector, rotate
from usdmotion.motion import Motion, Placement
from usdmotion.testing import ARM, HUMANOID, arm_scene, humanoid_scene

ONE = arm_scene(frame_count=6).characters[0]
OTHER = humanoid_scene(frame_count=6).characters[0]


def test_each_characters_space_stands_before_its_joints() -> None:
    cast = Cast.of([ONE, OTHER])
    assert cast.joints[0] == (ARM, "")
    assert cast.joints[1] == (ARM, "base")
    assert cast.joints[5] == (HUMANOID, "")
    assert cast.node_count == 4 + 16 + 2
    assert cast.index[HUMANOID, "pelvis"] == 6


def test_parents_stand_before_their_children_and_in_their_own_character() -> None:
    cast = Cast.of([ONE, OTHER])
    assert (cast.parents < np.arange(cast.node_count)).all()
    for node, parent in enumerate(cast.parents):
        path, token = cast.joints[node]
        if not token:
            assert parent == -1
        else:
            assert cast.joints[parent] == (path, token.rpartition("/")[0])


def test_what_belongs_to_a_joint_is_found_at_its_node() -> None:
    cast = Cast.of([ONE, OTHER])
    node = cast.index[HUMANOID, "pelvis/spine"]
    joint = OTHER.skeleton.index["pelvis/spine"]
    assert cast.masses[node] == OTHER.body.masses[joint]
    np.testing.assert_array_equal(cast.rotations[:, node], OTHER.motion.rotations[:, joint])
    assert cast.masses[cast.index[HUMANOID, ""]] == 0.0


def test_only_the_root_of_each_solve_translates() -> None:
    cast = Cast.of([ONE, replace(OTHER, root=1)])
    moving = [cast.joints[node] for node in np.flatnonzero(cast.translates)]
    assert moving == [(ARM, "base"), (HUMANOID, "pelvis/spine")]


def test_world_positions_have_the_placement_in_them() -> None:
    turn = from_vector(np.array([0.0, 1.0, 0.0]))
    shift = np.array([1.0, 2.0, 3.0])
    place = Placement(np.tile(shift, (6, 1)), np.tile(turn, (6, 1)))
    here, there = Cast.of([ONE]), Cast.of([replace(ONE, placement=place)])
    np.testing.assert_allclose(there.positions, rotate(turn, here.positions) + shift, atol=1e-12)


def test_a_chain_ends_at_the_root_of_the_solve_and_ancestors_at_the_top() -> None:
    cast = Cast.of([replace(ONE, root=1)])
    wrist = cast.index[ARM, "base/shoulder/elbow/wrist"]
    assert [cast.joints[node][1].rpartition("/")[2] for node in cast.chain(wrist)] == [
        "wrist",
        "elbow",
        "shoulder",
    ]
    assert len(cast.ancestors(wrist)) == 4
    assert cast.ancestors(0) == ()


def test_characters_of_different_times_are_refused_by_name() -> None:
    motion = OTHER.motion
    late = replace(OTHER, motion=Motion(motion.times + 1.0, motion.translations, motion.rotations))
    with pytest.raises(SceneError, match="</Humanoid> is not sampled at the times of the others"):
        Cast.of([ONE, late])


def test_an_unknown_joint_is_refused_with_some_that_are_there() -> None:
    with pytest.raises(SceneError, match=r"</A/hand> names the joint 'paw', .* it has base, "):
        Cast.of([ONE]).node((ARM, "paw"), "/A/hand")
