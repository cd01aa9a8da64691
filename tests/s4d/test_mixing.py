"""Blending and warping normalized motions."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion.curves import Spline
from usdmotion.errors import SceneError
from usdmotion.humanoid import PartMap
from usdmotion.kernels import from_vector
from usdmotion.motion import Motion
from usdmotion.s4d import Morphology, NormalizedMotion, blend, warp

from .conftest import apart, built, moving, put, steps, taken


def halves(motion: NormalizedMotion, first: float = 0.5) -> np.ndarray:
    return np.tile((first, 1.0 - first), (len(motion.times), 1))


def test_a_motion_that_counts_alone_is_the_blend(body: Morphology) -> None:
    one, other = moving(body, seed=1), moving(body, seed=2)
    blended = blend((taken(one, body), taken(other, body)), halves(taken(one, body), 0.0))
    metres, degrees = apart(body.skeleton, put(blended, body), other)
    assert metres < 1e-9
    assert degrees < 1e-6


def test_blending_a_motion_with_itself_changes_nothing(body: Morphology) -> None:
    motion = moving(body, size=1.5)
    normalized = taken(motion, body)
    blended = blend((normalized,) * 3, np.full((61, 3), 1.0 / 3.0))
    metres, degrees = apart(body.skeleton, put(blended, body), motion)
    assert metres < 1e-9
    assert degrees < 1e-6


def test_one_motion_becomes_another_without_a_jump(body: Morphology) -> None:
    one, other = moving(body, seed=3), moving(body, seed=4)
    share = np.linspace(0.0, 1.0, 61)
    blended = blend((taken(one, body), taken(other, body)), np.stack([1.0 - share, share], axis=1))
    fastest = max(steps(each.rotations).max() for each in (one, other))
    assert steps(put(blended, body).rotations).max() < 1.5 * fastest


def test_the_sign_of_a_quaternion_stays_when_another_motion_comes_to_count_most(
    body: Morphology,
) -> None:
    one, other = (taken(moving(body, seed=seed, size=1.5), body) for seed in (3, 4))
    share = np.linspace(0.0, 1.0, 61)
    blended = blend((one, other), np.stack([1.0 - share, share], axis=1))
    for name in ("limb_frames", "segment_rotations", "root_heading", "root_orientation"):
        turns = getattr(blended, name)
        assert np.sum(turns[1:] * turns[:-1], axis=-1).min() >= 0.0, name


def test_a_knee_goes_through_straight_where_it_bends_the_other_way(body: Morphology) -> None:
    """Half way between a knee bent by 6° and one overstretched by 6° it is straight."""
    knee = body.limbs[1].middle

    def bent(degrees: float) -> NormalizedMotion:
        turns = np.zeros((11, len(body.skeleton.joints), 3))
        turns[:, knee, 0] = np.radians(degrees)
        places = np.broadcast_to(body.skeleton.rest_translations, turns.shape)
        return taken(Motion(np.arange(11) / 10.0, places, from_vector(turns)), body)

    share = np.linspace(0.0, 1.0, 11)
    shares = np.stack([1.0 - share, share], axis=1)
    through = put(blend((bent(6.0), bent(-6.0)), shares), body)
    angles = np.degrees(2.0 * np.arcsin(through.rotations[:, knee, 0]))
    assert np.allclose(angles, np.linspace(6.0, -6.0, 11), atol=0.05)


def test_bodies_with_other_parts_blend(body: Morphology) -> None:
    """A motion without clavicles, necks and toes, on one vertebra, is told by the first's parts."""
    poor = tuple(
        ""
        if part in ("vt12", "vt6", "vc7") or part.endswith(("clavicular", "phalangeal"))
        else part
        for part in body.parts.parts
    )
    motion = moving(body, size=0.0)
    first = taken(motion, body)
    other = taken(motion, Morphology.of(body.skeleton, PartMap(poor)))
    assert set(other.segments) < set(first.segments)
    blended = blend((first, other), halves(first))
    metres, degrees = apart(body.skeleton, put(blended, body), motion)
    assert metres < 1e-5  # heights of ankles without toes are estimated
    assert degrees < 1e-6


def test_what_carries_blends_with_what_carries(body: Morphology) -> None:
    stood = taken(moving(body, size=0.1), body)
    hands = ("l_radiocarpal", "r_radiocarpal")
    on_hands = replace(stood, carriers=hands, carrier_shares=halves(stood))
    blended = blend((stood, on_hands), halves(stood, 0.25))
    shares = dict(zip(blended.carriers, blended.carrier_shares[0], strict=True))
    assert np.isclose(shares["l_talocrural"], 0.125)
    assert np.isclose(shares["l_radiocarpal"], 0.375)


def test_its_own_times_are_no_warp(body: Morphology) -> None:
    motion = moving(body, size=1.5)
    normalized = taken(motion, body)
    metres, degrees = apart(
        body.skeleton, put(warp(normalized, motion.times, motion.times), body), motion
    )
    assert metres < 1e-9
    assert degrees < 1e-6


def test_a_curve_of_keys_changes_the_pace_and_not_the_path(body: Morphology) -> None:
    motion = moving(body, frames=241)
    curve = Spline.through(np.array((0.0, 1.0, 3.0)), np.array((0.0, 4.0, 8.0)))
    times = np.linspace(0.0, 3.0, 91)
    at = curve.at(times)
    warped = warp(taken(motion, body), times, at)
    assert np.array_equal(warped.times, times)
    nearest = np.abs(motion.times[:, None] - at).argmin(axis=0)
    off = np.abs(motion.times[nearest] - at).max()
    metres, _ = apart(body.skeleton, put(warped, body), motion.during(nearest))
    assert off < 1.0 / 60.0 + 1e-9
    assert metres < 0.05


def test_a_taller_body_blends_as_its_own_size(body: Morphology) -> None:
    motion = moving(body)
    tall = built(2.2)
    own = taken(motion, body)
    blended = blend((own, taken(put(own, tall), tall)), halves(own))
    metres, degrees = apart(body.skeleton, put(blended, body), motion)
    assert metres < 1e-9
    assert degrees < 1e-6


def test_what_does_not_fit_is_refused(body: Morphology) -> None:
    motion = taken(moving(body), body)
    later = replace(motion, times=motion.times + 1.0)
    with pytest.raises(SceneError, match="warp them to the same"):
        blend((motion, later), halves(motion))
    with pytest.raises(SceneError, match="add up to 1"):
        blend((motion, motion), 2.0 * halves(motion))
    with pytest.raises(SceneError, match="nothing to blend"):
        blend((), np.zeros((61, 0)))
    with pytest.raises(SceneError, match="ascend"):
        warp(motion, motion.times[::-1], motion.times)
