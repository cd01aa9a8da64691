"""The truth that detectors are judged by, and the noise that is put on it."""

import numpy as np
import pytest


def every(limbs):
    return [limb for group in limbs.values() for limb in group]


def test_the_truth_is_there_for_stances_and_for_swings(limbs):
    assert [len(group) for group in limbs.values()] == [16, 48, 48]
    for name, group in limbs.items():
        known = np.concatenate([limb.known for limb in group])
        held = np.concatenate([limb.held for limb in group])
        assert 0.2 < held[known].mean() < 0.8, name
        assert sum(len(limb.stances) for limb in group) > 15, name


def test_a_limb_has_a_frame_at_its_end_with_the_way_up_as_its_first_axis(limbs):
    for limb in every(limbs):
        rotations = limb.search.rotations
        assert np.linalg.norm(rotations, axis=1) == pytest.approx(1.0)
        middle = len(limb.times) // 2
        x, y, z, w = rotations[middle]
        first = np.array([1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)])
        way = limb.places[middle, 1] - limb.places[middle, 0]
        assert first @ way == pytest.approx(np.linalg.norm(way))


def test_a_stance_on_a_plate_is_one_during_which_the_toes_hardly_go_anywhere(limbs):
    for limb in limbs["force plates"]:
        for stance in limb.stances:
            middle = 0.5 * (stance.start + stance.end)
            flat = np.abs(limb.times - middle) < 0.1
            assert np.ptp(limb.places[flat, 0], axis=0).max() < 0.02, limb.name


def test_noise_is_as_large_as_asked_for_and_comes_again(limbs):
    for limb in every(limbs)[::9]:
        noisy = limb.noisy(0.01, seed=4)
        assert (noisy.places - limb.places).std() == pytest.approx(0.01, rel=0.15)
        assert np.array_equal(noisy.places, limb.noisy(0.01, seed=4).places)
        assert not np.array_equal(noisy.places, limb.noisy(0.01, seed=5).places)
        assert noisy.stances == limb.stances


def test_outliers_are_some_frames_far_away_with_all_their_points(limbs):
    away = []
    for limb in every(limbs):
        way = limb.noisy(0.0, 0.02).places - limb.places
        assert np.ptp(way, axis=1) == pytest.approx(0.0, abs=1e-6)
        away.append(np.linalg.norm(way[:, 0], axis=1))
    away = np.concatenate(away)
    assert (away > 0.01).mean() == pytest.approx(0.02, rel=0.3)
    assert away[away > 0.01] == pytest.approx(0.5)


def test_an_answer_is_judged_only_where_the_truth_is_known(limbs):
    for limb in every(limbs)[::9]:
        right = limb.judge(limb.held)
        assert (right.wrong, right.f1) == (0, 1.0)
        assert limb.judge(np.where(limb.known, limb.held, ~limb.held)) == right
        wrong = limb.judge(~limb.held)
        assert (wrong.wrong, wrong.share) == (wrong.judged, 1.0)
