"""Displacements and σε-points: what the paper says, in closed form."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from usdmotion_contacts.displacements import displacements
from usdmotion_contacts.projection import axes, project

from usdmotion import Search


def wandering(count: int = 60, *, seed: int = 0, times=None, **fields: object) -> Search:
    random = np.random.default_rng(seed)
    return Search(**{
        "name": "anything", "times": np.arange(count) / 30.0 if times is None else times,
        "translations": random.normal(size=(count, 3)),
        "rotations": Rotation.random(count, random_state=seed).as_quat(), **fields,
    })  # fmt: skip


def matrices(search: Search) -> np.ndarray:
    """Return W of each frame, (F, 4, 4)."""
    w = np.tile(np.eye(4), (len(search.times), 1, 1))
    w[:, :3, :3] = Rotation.from_quat(search.rotations).as_matrix()
    w[:, :3, 3] = search.translations
    return w


def test_displacements_are_those_of_the_object_in_its_own_frame() -> None:
    search = wandering(step=1.0 / 30.0)
    moves, w = displacements(search), matrices(search)
    d = np.linalg.inv(w[moves.first]) @ w[moves.last]
    assert moves.count == len(search.times) - 1
    assert np.allclose(Rotation.from_quat(moves.rotations).as_matrix(), d[:, :3, :3])
    assert np.allclose(moves.translations, d[:, :3, 3])


def test_singular_values_and_residuals_are_those_of_the_decomposition() -> None:
    search = wandering()
    moves = displacements(search)
    points = project(moves)
    a = Rotation.from_quat(moves.rotations).as_matrix() - np.eye(3)
    u, sigma, v = np.linalg.svd(a)
    assert np.allclose(sigma[:, 0], points.sigma_3)
    assert np.allclose(sigma[:, 1], points.sigma_3)
    assert np.allclose(sigma[:, 2], 0.0)
    # Residual with σ1 alone zeroed, and the particular solution of least length.
    inverse = np.divide(1.0, sigma, out=np.zeros_like(sigma), where=sigma > 1e-9)
    t = moves.translations[..., None]
    particular = -(v.transpose(0, 2, 1) * inverse[:, None]) @ (u.transpose(0, 2, 1) @ t)
    residual = np.linalg.norm(a @ particular + t, axis=(1, 2))
    assert np.allclose(points.epsilon_1, residual)
    assert np.allclose(points.epsilon_3, np.linalg.norm(t, axis=(1, 2)))
    axis, point = axes(moves)
    assert np.allclose(point, particular[..., 0])
    assert np.allclose(np.abs(np.sum(axis * v[:, 2], axis=1)), 1.0)


def test_without_a_turn_the_whole_translation_is_residual() -> None:
    still = np.tile((0.0, 0.0, 0.0, 1.0), (60, 1))
    points = project(displacements(wandering(rotations=still)))
    assert np.array_equal(points.epsilon_1, points.epsilon_3)
    assert not points.sigma_3.any()


@pytest.mark.parametrize(("rate", "samples"), [(24.0, 1), (30.0, 1), (60.0, 2), (120.0, 3)])
def test_a_step_is_one_sample_and_two_hundredths_of_a_second_at_least(rate, samples) -> None:
    times = np.arange(60) / rate
    moves = displacements(wandering(times=times, translations=np.outer(times, (1.0, 0.0, 0.0))))
    assert set(moves.last - moves.first) == {samples}
    assert moves.count == 60 - samples


def test_a_step_that_is_asked_for_is_taken() -> None:
    moves = displacements(wandering(times=np.arange(60) / 120.0, step=0.05))
    assert set(moves.last - moves.first) == {6}
    moves = displacements(wandering(times=np.arange(60) / 24.0, step=0.001))
    assert set(moves.last - moves.first) == {1}


def test_over_uneven_samples_a_step_never_is_shorter_than_it_says() -> None:
    times = np.cumsum(np.random.default_rng(0).uniform(0.001, 0.02, size=60))
    moves = displacements(wandering(times=times, step=0.03))
    assert np.all(times[moves.last] - times[moves.first] >= 0.03 - 1e-6)
    assert np.all(times[moves.last - 1] - times[moves.first] < 0.03)


@pytest.mark.parametrize("count", [0, 1, 3])
def test_a_motion_that_is_shorter_than_a_step_has_none(count: int) -> None:
    points = project(displacements(wandering(count, step=1.0)))
    assert points.displacements.count == 0
