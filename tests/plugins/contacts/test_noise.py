"""Least median of squares: exactly the paper's, and robust where the maximum is not."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from usdmotion_contacts.noise import EQUAL, FAR, largest_noise, without_outliers
from usdmotion_contacts.pattern import constant

from usdmotion import Search, Template

FLOOR = 1e-6


def by_the_book(values: np.ndarray) -> np.ndarray:
    """Return which values stay, by every residual of every one of them (2006, section 6.1)."""
    squares = (values[:, None] - values) ** 2
    medians = np.median(squares, axis=1)
    deviation = 1.4826 * (1.0 + 5.0 / (len(values) - 1)) * np.sqrt(medians.min())
    ties = np.flatnonzero(np.isclose(medians, medians.min(), rtol=1e-12, atol=0.0))
    best = ties[np.argmin(values[ties])]
    return squares[best] <= (2.5 * max(deviation, FLOOR)) ** 2


@pytest.mark.parametrize("count", [3, 4, 5, 10, 31, 200])
def test_it_is_the_papers_over_every_candidate(count: int) -> None:
    for seed in range(20):
        random = np.random.default_rng(seed)
        values = np.abs(random.normal(size=count))
        values[random.uniform(size=count) < 0.2] *= 10.0
        assert np.array_equal(without_outliers(values, FLOOR), by_the_book(values))


def test_the_order_of_the_values_does_not_matter() -> None:
    values = np.abs(np.random.default_rng(0).normal(size=50))
    kept = without_outliers(values, FLOOR)
    turned = np.random.default_rng(1).permutation(50)
    assert np.array_equal(without_outliers(values[turned], FLOOR), kept[turned])


def test_less_than_half_of_outliers_are_out() -> None:
    noise = np.abs(np.random.default_rng(0).normal(1e-3, 2e-4, size=60))
    values = np.concatenate([noise, np.linspace(0.02, 0.2, 40)])
    assert largest_noise(values, FLOOR) <= (1.0 + EQUAL) * noise.max()


def test_of_fewer_than_three_nobody_knows_which_is_out() -> None:
    for values in ([0.001, 5.0], [5.0]):
        assert largest_noise(np.array(values), FLOOR) == pytest.approx(5.0, rel=2.0 * EQUAL)


def test_equal_values_are_not_emptied_and_numerical_noise_is_left() -> None:
    values = np.array([0.0] * 10 + [1e-7, 0.3])
    assert without_outliers(values, FLOOR)[:-1].all()
    assert not without_outliers(values, FLOOR)[-1]
    assert largest_noise(values, FLOOR) == pytest.approx(FAR * FLOOR, rel=2.0 * EQUAL)


def test_what_sets_a_limit_meets_it_whatever_its_last_bits_are() -> None:
    values = np.abs(np.random.default_rng(2).normal(1e-3, 2e-4, size=40))
    limit = largest_noise(values, FLOOR)
    kept = values[without_outliers(values, FLOOR)]
    assert (kept * (1.0 + 1e-9) <= limit).all() and limit <= 1.00001 * kept.max()


def test_least_medians_keep_two_footplants_where_the_maximum_makes_one(detect) -> None:
    """2006, figures 4 and 5: the first frames of the template belong to the other footplant."""
    times = np.arange(241) / 60.0
    share = np.clip((times - 1.0) / 0.35, 0.0, 1.0)
    random = np.random.default_rng(0)
    way = np.stack([0.5 * share, 0.1 * np.sin(np.pi * share), 0.0 * share], axis=1)
    way += random.normal(scale=3e-4, size=way.shape)
    turns = Rotation.from_rotvec(random.normal(scale=2e-3, size=way.shape))
    search = Search(
        name="foot", times=times, translations=way, rotations=turns.as_quat(),
        templates=(Template("space", 0.9, 3.0),), merge_distance=1.0,
    )  # fmt: skip
    first, second = detect(search).contacts
    assert first.end == pytest.approx(1.0, abs=0.05)
    assert second.start == pytest.approx(1.35, abs=0.05)
    naive = Search(
        name="foot", times=times, translations=way, rotations=turns.as_quat(),
        pattern=constant(0.5, 0.1), merge_distance=1.0,
    )  # fmt: skip
    assert len(detect(naive).contacts) == 1
