import numpy as np
import pytest

from usdmotion.demos.body import humanoid, sole, solids
from usdmotion.kernels import forward


def _rest(height):
    skeleton, _, _ = humanoid(height)
    positions, _ = forward(
        skeleton.parents, skeleton.rest_translations[None], skeleton.rest_rotations[None]
    )
    return skeleton, positions[0]


def test_the_masses_of_all_segments_add_up_to_the_body():
    _, body, _ = humanoid(1.7, mass=68.0)
    assert np.sum(body.masses) == pytest.approx(68.0, rel=1e-12)
    assert np.all(body.masses >= 0.0)


def test_the_centre_of_mass_is_where_anthropometry_has_it():
    _, positions = _rest(1.0)
    _, body, _ = humanoid(1.0)
    center = np.average(positions + body.mass_centers, axis=0, weights=body.masses)
    assert center[0] == pytest.approx(0.0, abs=1e-12)
    # 0.57 with hanging arms (de Leva 1996: 0.569); a T-pose lifts it by about 0.02.
    assert 0.57 < center[1] < 0.60
    assert abs(center[2]) < 0.01


def test_left_and_right_are_mirror_images():
    skeleton, positions = _rest(1.7)
    _, body, parts = humanoid(1.7)
    for left, token in enumerate(skeleton.joints):
        if "Right" in token:
            continue
        right = skeleton.index[token.replace("Left", "Right")]
        np.testing.assert_allclose(positions[left] * (-1, 1, 1), positions[right], atol=1e-12)
        np.testing.assert_allclose(body.mass_centers[left] * (-1, 1, 1), body.mass_centers[right])
        assert parts[right] == ("r_" + parts[left][2:] if "Left" in token else parts[left])


def test_it_stands_in_a_t_pose_with_its_soles_on_the_ground():
    skeleton, positions = _rest(1.7)
    points = sole(1.7)
    for side in ("Left", "Right"):
        ankle, toes = (skeleton.index[_token(skeleton, side + n)] for n in ("Foot", "ToeBase"))
        for joint, point in ((ankle, points.heel), (toes, points.ball), (toes, points.toe_tip)):
            assert (positions[joint] + point)[1] == pytest.approx(0.0, abs=1e-12)
        arm = [skeleton.index[_token(skeleton, side + n)] for n in ("Arm", "ForeArm", "Hand")]
        assert np.ptp(positions[arm, 1]) == pytest.approx(0.0, abs=1e-12)
    assert positions[skeleton.index[_token(skeleton, "LeftHand")], 0] > 0.6


def test_every_length_scales_with_the_height():
    tall, short = humanoid(2.0), humanoid(1.0)
    np.testing.assert_allclose(tall[0].rest_translations, 2.0 * short[0].rest_translations)
    np.testing.assert_allclose(tall[1].mass_centers, 2.0 * short[1].mass_centers)
    np.testing.assert_array_equal(tall[1].masses, short[1].masses)
    for big, small in zip(solids(2.0), solids(1.0), strict=True):
        np.testing.assert_allclose(big.end, 2.0 * small.end)
        assert big.radius == pytest.approx(2.0 * small.radius)


def test_the_top_of_the_head_is_the_height():
    skeleton, positions = _rest(1.7)
    head = solids(1.7)[skeleton.index[_token(skeleton, "Head")]]
    assert (positions[head.joint] + head.end)[1] + head.radius == pytest.approx(1.7, abs=1e-3)


def test_knees_and_elbows_bend_one_way_only():
    skeleton, body, _ = humanoid()
    for name, axis, sign in (
        ("LeftLeg", 0, 1),
        ("RightLeg", 0, 1),
        ("LeftForeArm", 1, -1),
        ("RightForeArm", 1, 1),
    ):
        joint = skeleton.index[_token(skeleton, name)]
        limits = sorted((sign * body.limits_min[joint, axis], sign * body.limits_max[joint, axis]))
        assert limits == [0.0, 150.0]
    assert np.all(body.limits_min <= 0.0)
    assert np.all(body.limits_max >= 0.0)


def _token(skeleton, name):
    return next(token for token in skeleton.joints if token.rsplit("/", 1)[-1] == name)
