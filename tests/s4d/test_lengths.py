"""Lengths that a motion has, and those that a rest pose tells nothing of."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from usdmotion.demos.body import Proportions
from usdmotion.kernels import forward
from usdmotion.motion import Motion
from usdmotion.s4d import Morphology

from .conftest import UP, apart, built, moving, put, taken

TOKENS = {
    "the same tokens": lambda joints: joints,
    "tokens below another parent": lambda joints: tuple(f"Rig/{token}" for token in joints),
}


@pytest.mark.parametrize("tokens", TOKENS.values(), ids=TOKENS)
def test_joints_of_the_same_name_move_alike_on_a_body_that_is_built_otherwise(
    body: Morphology, tokens: Callable[[tuple[str, ...]], tuple[str, ...]]
) -> None:
    """A joint that slides does so under another parent; one that is only elsewhere stays."""
    motion, shape = moving(body), body.skeleton
    moved = np.array(motion.translations)
    moved[:, body.joint("l_shoulder"), 1] += 0.02 * np.sin(motion.times)
    moved[:, body.joint("r_shoulder"), 1] += 0.02
    other = Morphology.of(replace(shape, joints=tokens(shape.joints)), body.parts)
    told = Motion(motion.times, moved, motion.rotations)
    source = Morphology.of(shape, body.parts, poses=told)
    copied = put(taken(told, source), other)
    away = copied.translations - shape.rest_translations
    assert np.ptp(away[:, body.joint("l_shoulder"), 1]) > 0.015
    assert np.abs(away[:, body.joint("r_shoulder")]).max() < 1e-9


@pytest.mark.parametrize("tokens", TOKENS.values(), ids=TOKENS)
def test_a_body_whose_motion_has_other_lengths_than_its_rest_pose_keeps_them_to_itself(
    body: Morphology, tokens: Callable[[tuple[str, ...]], tuple[str, ...]]
) -> None:
    """Legs are 15 % longer than at rest; another body stands on its own, on the same ground."""
    motion, shape = moving(body, size=0.0), body.skeleton
    longer = np.array(motion.translations)
    for part in ("l_knee", "r_knee", "l_talocrural", "r_talocrural"):
        longer[:, body.joint(part)] *= 1.15
    longer[:, body.joint("humanoid_root")] += 0.15 * body.leg_length * UP
    told = Motion(motion.times, longer, motion.rotations)
    source = Morphology.of(shape, body.parts, poses=told)
    assert np.isclose(source.leg_length, 1.15 * body.leg_length)
    metres, _ = apart(shape, told, put(taken(told, source), source))
    assert metres < 1e-9
    small = built(1.2)
    other = Morphology.of(
        replace(small.skeleton, joints=tokens(small.skeleton.joints)), small.parts
    )
    there = put(taken(told, source), other)
    own = np.delete(there.translations, body.joint("humanoid_root"), axis=1)
    rest = np.delete(small.skeleton.rest_translations, body.joint("humanoid_root"), axis=0)
    np.testing.assert_allclose(own, np.broadcast_to(rest, own.shape), atol=1e-9)
    places = {
        who: forward(who.skeleton.parents, each.translations, each.rotations)[0]
        for who, each in ((source, told), (other, there))
    }
    over = {who: each[:, who.joint("l_talocrural"), 1] for who, each in places.items()}
    heights = {who: who.standing_heights[0] for who in places}
    lifted = {who: (over[who] - heights[who]) / who.leg_length for who in places}
    np.testing.assert_allclose(lifted[other], lifted[source], atol=1e-9)


@pytest.mark.parametrize("thick", [0.5, 1.0, 2.0])
def test_soles_of_any_thickness_stand_on_the_ground_on_legs_of_another_length(
    body: Morphology, thick: float
) -> None:
    """Feet may be half, or twice, as thick at the ball as those that lengths are told from."""
    motion, ball = moving(body, size=0.0), "l_metatarsophalangeal"
    height = body.standing_heights[1]
    raised = np.array(motion.translations)
    lowest = forward(body.skeleton.parents, raised, motion.rotations)[0][:, body.joint(ball), 1]
    raised[:, body.joint("humanoid_root"), 1] += thick * height - lowest
    source = taken(Motion(motion.times, raised, motion.rotations), body)
    for legs in (0.8, 1.2):
        other = built(proportions=Proportions(legs=legs))
        there = put(source, other)
        places, _ = forward(other.skeleton.parents, there.translations, there.rotations)
        own = thick * other.standing_heights[1]
        off = np.abs(places[:, other.joint(ball), 1] - own).max()
        # Heights over those that are taken for a foot's go by the legs.
        assert off <= 0.25 * abs(thick - 1.0) * height + 1e-9
