"""The low-pass by its laws, and whole scenes: noise goes, the motion and its contacts stay."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from usdmotion.cleaning import cleaned
from usdmotion.cleaning.contacts import find_rests, places_of
from usdmotion.cleaning.inputs import low_passed
from usdmotion.demos.gait import walk
from usdmotion.demos.kick import kick
from usdmotion.kernels import from_vector, multiply
from usdmotion.motion import Motion
from usdmotion.plugins import host
from usdmotion.smoothing import low_pass
from usdmotion.solving import Problem, Solution
from usdmotion.testing.scenes import moved

TIMES = np.arange(241) / 120.0


@pytest.fixture(scope="module")
def solve() -> Callable[[Problem], Solution]:
    return host().solver("prioritized_ik")().solve


def gain(cutoff: float, times: np.ndarray = TIMES) -> float:
    """Return what a filter leaves of independent errors, by its impulse response."""
    impulse = np.zeros((len(times), 1))
    impulse[len(times) // 2] = 1.0
    return float(np.sqrt(np.sum(low_pass(times, impulse, cutoff) ** 2)))


def backwards(motion: Motion) -> Motion:
    return Motion(
        motion.times[-1] - motion.times[::-1], motion.translations[::-1], motion.rotations[::-1]
    )


@pytest.mark.parametrize("speed", [90.0, 720.0, 2000.0])
def test_an_even_turn_stays_however_fast_it_is(speed, apart) -> None:
    turn = from_vector(np.radians(speed) * TIMES[:, None, None] * (0.6, 0.0, 0.8))
    motion = Motion(TIMES, np.zeros((241, 1, 3)), turn)
    changed = apart(low_passed(motion, 10.0), motion)
    assert changed[20:-20].max() < 1e-5
    assert changed.max() < 1.0


@pytest.mark.parametrize("cutoff", [6.0, 10.0, 20.0])
def test_noise_is_reduced_as_the_filter_says(cutoff, noisy, apart) -> None:
    still = Motion(TIMES, np.zeros((241, 40, 3)), np.tile((0.0, 0.0, 0.0, 1.0), (241, 40, 1)))
    given = noisy(still, 1.0)
    middle = slice(40, -40)
    before, after = (
        np.sqrt(np.mean(apart(each, still)[middle] ** 2))
        for each in (given, low_passed(given, cutoff))
    )
    assert before == pytest.approx(np.sqrt(3.0), rel=0.03)
    assert after / before == pytest.approx(gain(cutoff), rel=0.05)


def test_the_filter_takes_no_frame_no_sign_and_no_direction_of_time(smooth, noisy, apart) -> None:
    motion = noisy(smooth(), 2.0)
    expected = low_passed(motion, 8.0)
    random = np.random.default_rng(5)
    left, right = (each / np.linalg.norm(each) for each in random.normal(size=(2, 4)))

    def turned(each: Motion) -> Motion:
        return replace(each, rotations=multiply(multiply(left, each.rotations), right))

    signs = random.choice([-1.0, 1.0], (motion.frame_count, 4, 1))
    flipped = replace(motion, rotations=motion.rotations * signs)
    assert apart(low_passed(turned(motion), 8.0), turned(expected)).max() < 1e-5
    assert apart(low_passed(flipped, 8.0), expected).max() < 1e-5
    assert apart(backwards(low_passed(backwards(motion), 8.0)), expected).max() < 1e-5
    assert np.allclose(
        backwards(low_passed(backwards(motion), 8.0)).translations, expected.translations
    )


def test_the_unit_of_length_does_not_matter(smooth) -> None:
    motion = smooth()
    larger = replace(motion, translations=100.0 * motion.translations)
    after = low_passed(larger, 5.0).translations
    assert np.allclose(after, 100.0 * low_passed(motion, 5.0).translations)


def test_slow_motion_stays_and_so_do_its_ends_and_what_does_not_move(smooth, apart) -> None:
    motion = smooth()
    rotations = np.array(motion.rotations)
    rotations[:, 2] = rotations[0, 2]
    motion = replace(motion, rotations=rotations)
    after = low_passed(motion, 10.0)
    assert apart(after, motion).max() < 0.2
    assert apart(after, motion)[[0, -1]].max() < 1e-5
    assert np.array_equal(after.rotations[:, 2], motion.rotations[:, 2])


def test_a_cutoff_beyond_the_samples_gives_the_same_motion_back(smooth) -> None:
    motion = smooth(24.0)
    assert low_passed(motion, 12.0) is motion
    still = replace(motion, rotations=motion.rotations[[0] * motion.frame_count])
    still = replace(still, translations=motion.translations[[0] * motion.frame_count])
    assert low_passed(still, 1.0) is still


def test_a_scene_that_does_not_ask_for_it_is_the_same_scene(walker, as_scene, solve) -> None:
    scene = as_scene(walker, cutoff=0.0)
    assert cleaned(scene, solve) == (scene, {})


def test_clean_input_beyond_the_samples_keeps_its_bits(walker, as_scene) -> None:
    def never(problem: Problem) -> Solution:
        raise AssertionError("there is nothing to solve")

    scene = as_scene(walker, cutoff=60.0)
    after, told = cleaned(scene, never)
    assert after.characters == scene.characters
    (each,) = told.values()
    assert (each.low_passed, each.moved, each.moved_time, each.held) == (False, 0.0, None, ())
    assert "none is filtered" in each.sentence("/Walker/Edit")


@pytest.mark.parametrize("rate", [24.0, 60.0, 120.0])
def test_a_clean_walk_hardly_changes(rate, as_scene, solve, apart) -> None:
    walker = walk(3.0, rate)
    scene = as_scene(walker)
    after, told = cleaned(scene, solve)
    distances = np.linalg.norm(after.cast.positions - scene.cast.positions, axis=-1)
    assert np.sqrt(np.mean(distances**2)) < 1e-3
    assert distances.max() < 8e-3
    assert told["/Walker/Edit"].moved == pytest.approx(distances.max())
    assert apart(after.characters[0].motion, walker.motion).max() < 2.0


def test_a_kick_keeps_its_speed(as_scene, solve, apart) -> None:
    kicker = kick()
    after = cleaned(as_scene(kicker), solve)[0].characters[0].motion
    for name in ("RightUpLeg", "RightLeg", "LeftUpLeg", "LeftLeg"):
        joint = kicker.joint(name)
        before, now = (
            apart(
                Motion(each.times[1:], each.translations[1:], each.rotations[1:]),
                Motion(each.times[1:], each.translations[1:], each.rotations[:-1]),
            )[:, joint].max()
            for each in (kicker.motion, after)
        )
        assert now > 0.95 * before


@pytest.mark.parametrize("sigma", [0.2, 0.5, 1.0])
def test_noise_goes_and_feet_slide_less_than_in_the_input(
    sigma, walker, as_scene, noisy, solve
) -> None:
    scene, truth = as_scene(walker, noisy(walker.motion, sigma)), as_scene(walker)
    after, told = cleaned(scene, solve)
    before, now = (
        np.sqrt(np.mean(np.sum((each.cast.positions - truth.cast.positions) ** 2, axis=-1)))
        for each in (scene, after)
    )
    assert now < 0.5 * before
    held = told["/Walker/Edit"].held
    assert len(held) == 4
    for each in held:
        assert each.slide_after < 0.2 * each.slide_before


def test_feet_that_stand_still_stay_still_when_much_is_filtered(walker, as_scene, solve) -> None:
    scene = as_scene(walker, cutoff=4.0)
    unheld = as_scene(walker, low_passed(walker.motion, 4.0)).characters[0]
    after, told = cleaned(scene, solve)
    for held in told["/Walker/Edit"].held:
        if held.joint.endswith("ToeBase"):
            assert held.slide_after < held.slide_before + 1e-4
    # Without being held they would not.
    for rests in find_rests(scene.characters[0]):
        if rests.joint.endswith("ToeBase"):
            assert rests.slide(places_of(unheld, rests.joint)) > 0.02
    root = after.characters[0].motion.translations[:, 0]
    assert np.array_equal(root, unheld.motion.translations[:, 0])


def test_spikes_go_before_they_are_smeared(walker, as_scene, solve, apart) -> None:
    rotations = np.array(walker.motion.rotations)
    joint = walker.joint("LeftForeArm")
    rotations[100:103, joint] = multiply(
        rotations[100:103, joint], from_vector(np.array([1.5, 0.0, 0.0]))
    )
    broken = replace(walker.motion, rotations=rotations)
    after, told = cleaned(as_scene(walker, broken), solve)
    assert apart(after.characters[0].motion, walker.motion)[:, joint].max() < 1.0
    cleaning = told["/Walker/Edit"]
    (replaced,) = cleaning.replaced
    assert replaced.joint.endswith("LeftForeArm") and replaced.samples == cleaning.samples == 3
    assert cleaning.moved < 0.01
    assert "3 samples are outliers and replaced (LeftForeArm 3)" in cleaning.sentence("/E")


def test_a_solver_that_holds_nothing_is_not_believed(walker, as_scene) -> None:
    def lazy(problem: Problem) -> Solution:
        nothing = np.zeros(problem.cast.frame_count, dtype=np.int64)
        return Solution(problem.cast.translations, problem.cast.rotations, nothing, nothing)

    told = cleaned(as_scene(walker, cutoff=4.0), lazy)[1]["/Walker/Edit"]
    assert any(each.slide_after > each.slide_before + 0.01 for each in told.held)


def test_the_answer_does_not_depend_on_where_the_scene_is(
    walker, as_scene, noisy, solve, apart
) -> None:
    scene = as_scene(walker, noisy(walker.motion, 0.3))
    turn = from_vector(np.array([0.3, 1.0, -0.4]))
    there = moved(scene, np.array([50.0, -3.0, 20.0]), turn)
    here, away = (cleaned(each, solve)[0].characters[0].motion for each in (scene, there))
    assert apart(here, away).max() < 0.05
