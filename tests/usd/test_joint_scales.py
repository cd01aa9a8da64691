"""Joints that are scaled: even ones are read, uneven ones refused."""

import numpy as np
import pytest

from usdmotion.errors import SceneError


def scaled(text, scales, times=(1, 2, 3, 4, 5)):
    return text.poses(scales=False) + f"\nhalf3[] scales.timeSamples = {text.sampled(scales)}"


def test_joints_may_be_scaled_evenly_and_over_time(text, save, check):
    scales = {1: [(1, 1, 1)] * 4, 3: [(2, 2, 2), (0.5, 0.5, 0.5), (1, 1, 1), (3, 3, 3)]}
    check(save(text.man(animation=scaled(text, scales), xform=text.MOVING)))


def test_a_joint_at_the_end_of_a_chain_may_be_scaled_anyhow(text, save, check):
    scales = {1: [(1, 1, 1), (1, 1, 1), (1, 2, 3), (1, 1, 0.5)]}
    check(save(text.man(animation=scaled(text, scales))))


def test_joints_may_be_mirrored_through_a_point(text, save, check):
    scales = {1: [(1, 1, 1), (-2, -2, -2), (1, 1, 1), (-1, -1, -1)]}
    check(save(text.man(animation=scaled(text, scales))))


def test_a_mirrored_joint_at_the_end_of_a_chain_keeps_its_own_rotation(text, save, read):
    plain = read(save(text.man(animation=scaled(text, {1: [(1, 1, 1)] * 4}))))
    scales = {1: [(1, 1, 1), (1, 1, 1), (-2, -2, -2), (0, 0, 0)]}
    other = read(save(text.man(animation=scaled(text, scales)), "other.usda"))
    one, two = (shot.scenes[0].characters[0].motion for shot in (plain, other))
    np.testing.assert_array_equal(one.rotations, two.rotations)
    np.testing.assert_array_equal(one.translations, two.translations)


@pytest.mark.parametrize(
    ("scale", "why"), [((1, 2, 1), "unevenly"), ((-1, 1, 1), "unevenly"), ((0, 0, 0), "zero")]
)
def test_any_other_scale_of_a_joint_with_children_is_refused_by_name(text, save, read, scale, why):
    scales = {1: [(1, 1, 1)] * 4, 3: [(1, 1, 1), scale, (1, 1, 1), (1, 1, 1)]}
    with pytest.raises(SceneError, match=f"</Man/Walk> scales the joint 'hip/knee' .*{why}"):
        read(save(text.man(animation=scaled(text, scales))))
