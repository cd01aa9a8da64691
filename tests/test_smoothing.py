"""What a solve has changed is filtered, and nothing else."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from usdmotion.constraints import Goal, PositionConstraint
from usdmotion.measuring import measure
from usdmotion.motion import Motion
from usdmotion.plugins import host
from usdmotion.smoothing import enforced, low_pass, reach, smoothed, winds
from usdmotion.solving import Problem
from usdmotion.testing import arm_scene

TIMES = np.arange(121) / 24.0


def wave(frequency: float, times: np.ndarray = TIMES) -> np.ndarray:
    return np.sin(2.0 * np.pi * frequency * times)[:, None]


def random_motion(seed: int, joints: int = 4) -> Motion:
    random = np.random.default_rng(seed)
    turns = Rotation.random(len(TIMES) * joints, random_state=seed).as_quat()
    return Motion(
        TIMES,
        random.normal(size=(len(TIMES), joints, 3)),
        turns.reshape(len(TIMES), joints, 4),
    )


def test_a_motion_that_was_not_changed_stays_as_it_is() -> None:
    motion = random_motion(0)
    after = smoothed(motion, motion, 2.0)
    assert np.allclose(after.translations, motion.translations, atol=1e-12)
    assert np.allclose(after.rotations, motion.rotations, atol=1e-12)


def test_a_constant_displacement_passes() -> None:
    assert np.allclose(low_pass(TIMES, np.full((121, 2), 3.0), 1.0), 3.0)


def test_slow_displacements_pass_and_fast_ones_do_not() -> None:
    middle = slice(40, 81)
    assert np.abs(low_pass(TIMES, wave(0.5), 4.0) - wave(0.5))[middle].max() < 0.02
    assert np.abs(low_pass(TIMES, wave(10.0), 4.0))[middle].max() < 0.02


def test_half_of_the_amplitude_is_left_at_the_cutoff() -> None:
    middle = slice(40, 81)
    left = low_pass(TIMES, wave(3.0), 3.0)[middle]
    assert np.abs(left).max() == pytest.approx(0.5, abs=0.05)


def test_nothing_is_delayed() -> None:
    pulse = np.exp(-(((TIMES - 2.5) / 0.1) ** 2))[:, None]
    assert np.argmax(low_pass(TIMES, pulse, 1.0)) == np.argmax(pulse)


def test_uneven_samples_are_filtered_as_even_ones_are() -> None:
    keep = np.sort(np.random.default_rng(1).choice(121, 100, replace=False))
    keep[[0, -1]] = 0, 120
    even = low_pass(TIMES, wave(0.7), 3.0)
    uneven = low_pass(TIMES[keep], wave(0.7)[keep], 3.0)
    assert np.abs(uneven - even[keep]).max() < 0.05


def test_a_cutoff_above_what_the_samples_hold_changes_nothing() -> None:
    values = np.random.default_rng(2).normal(size=(121, 3))
    assert low_pass(TIMES, values, 12.0) is values


def test_what_is_out_of_reach_does_not_change_a_frame() -> None:
    values = np.random.default_rng(4).normal(size=(121, 2))
    width = reach(TIMES, 3.0)
    for moved in range(0, 121, 7):
        other = np.array(values)
        other[moved] += 1.0
        apart = np.abs(low_pass(TIMES, other, 3.0) - low_pass(TIMES, values, 3.0)).max(axis=1)
        near = np.abs(np.arange(121) - moved) <= width
        assert apart[~near].max() < 1e-12 < apart[near].max()
    part = slice(30, 90)
    inner, whole = low_pass(TIMES[part], values[part], 3.0), low_pass(TIMES, values, 3.0)[part]
    assert np.abs(inner - whole)[width:-width].max() < 1e-12


def test_uneven_frames_are_all_within_reach_and_none_where_nothing_is_filtered() -> None:
    uneven = TIMES + 0.01 * np.sin(TIMES)
    assert reach(uneven, 3.0) == len(uneven)
    assert reach(TIMES, 12.0) == 0


def test_a_displacement_winds_where_it_turns_by_more_than_half_a_turn() -> None:
    still = Motion(TIMES, np.zeros((121, 1, 3)), np.tile((0.0, 0.0, 0.0, 1.0), (121, 1, 1)))
    for most, wound in ((0.9 * np.pi, False), (1.1 * np.pi, True)):
        angles = np.linspace(0.0, most, 121)
        turns = Rotation.from_rotvec(angles[:, None] * (0.0, 1.0, 0.0)).as_quat()[:, None]
        assert winds(still, Motion(TIMES, still.translations, turns)) == wound


def test_a_displacement_of_a_whole_turn_does_not_jump() -> None:
    still = Motion(TIMES, np.zeros((121, 1, 3)), np.tile((0.0, 0.0, 0.0, 1.0), (121, 1, 1)))
    angles = np.linspace(0.0, 1.5 * np.pi, 121)
    turns = Rotation.from_rotvec(angles[:, None] * (0.0, 1.0, 0.0)).as_quat()[:, None]
    after = smoothed(still, Motion(TIMES, still.translations, turns), 3.0)
    apart = Rotation.from_quat(after.rotations[:, 0]) * Rotation.from_quat(turns[:, 0]).inv()
    assert np.degrees(apart.magnitude()[20:-20].max()) < 1.0


def test_the_last_pass_enforces_what_the_filter_has_disturbed() -> None:
    hand = "base/shoulder/elbow/wrist"
    lifted = Goal(mode="offset", translation=np.array([0.0, 0.1, 0.0]), times=(0.1, 0.2, 0.5, 0.6))
    path = arm_scene().characters[0].path
    asked = PositionConstraint(path="/Hand", skeleton=path, joint=hand, goals=(lifted,))
    scene = arm_scene([asked])
    problem = Problem.of(scene)
    solver = host().solver("prioritized_ik")()
    once = enforced(solver, problem, cutoff=0.0, passes=1)
    twice = enforced(solver, problem, cutoff=3.0, passes=2)
    for solution in (once, twice):
        assert measure(problem, solution, scene.constraints).max() < 1e-6
    assert not np.array_equal(once.rotations, twice.rotations)
    assert np.all(twice.iterations >= once.iterations)


def test_the_last_pass_leaves_the_root_where_the_filter_has_put_it() -> None:
    moved = Goal(mode="offset", translation=np.array([0.1, 0.1, 0.0]), times=(0.1, 0.2, 0.3, 0.4))
    path = arm_scene().characters[0].path
    hand = PositionConstraint(
        path="/Hand", skeleton=path, joint="base/shoulder/elbow/wrist", goals=(moved,)
    )
    problem = Problem.of(arm_scene([hand]))
    solver = host().solver("prioritized_ik")()
    cast = problem.cast
    given = Motion(cast.times, cast.translations, cast.rotations)
    first = solver.solve(problem)
    filtered = smoothed(given, Motion(cast.times, first.translations, first.rotations), 3.0)
    twice = enforced(solver, problem, cutoff=3.0, passes=2)
    (root,) = np.flatnonzero(cast.translates)
    apart = twice.translations[:, root] - filtered.translations[:, root]
    assert np.abs(filtered.translations[:, root] - first.translations[:, root]).max() > 1e-3
    assert np.abs(apart).max() < 1e-6
    assert measure(problem, twice, [hand]).max() < 1e-6


def test_a_filter_enforces_twice_even_where_one_pass_is_asked_for() -> None:
    problem = Problem.of(arm_scene())
    solver = host().solver("prioritized_ik")()
    one = enforced(solver, problem, cutoff=3.0, passes=1)
    two = enforced(solver, problem, cutoff=3.0, passes=2)
    assert np.array_equal(one.rotations, two.rotations)


def test_what_is_on_its_way_at_an_end_goes_on_and_the_ends_stay() -> None:
    ramp = 3.0 * TIMES[:, None]
    assert np.allclose(low_pass(TIMES, ramp, 2.0), ramp)
    noise = np.random.default_rng(3).normal(size=(121, 2))
    assert np.allclose(low_pass(TIMES, noise, 2.0)[[0, -1]], noise[[0, -1]])
