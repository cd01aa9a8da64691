"""Laws of quaternions, in NumPy and in the kernels, with SciPy beside them."""

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation, Slerp

from usdmotion.kernels import (
    chordal_mean,
    compose,
    conjugate,
    from_vector,
    multiply,
    quaternions,
    rotate,
    slerp,
    to_vector,
)
from usdmotion.kernels.rotations import normalize

# What only kernels call has no door to Python: these are its doors.
product = numba.njit(lambda a, b: quaternions.product(a, b))
inverse = numba.njit(lambda a: quaternions.inverse(a))
turned = numba.njit(lambda a, v: quaternions.turned(a, v))
unit = numba.njit(lambda a: quaternions.unit(a))
rotation_vector = numba.njit(lambda a: quaternions.rotation_vector(a))
quaternion = numba.njit(lambda v: quaternions.quaternion(v))
interpolated = numba.njit(lambda a, b, s: quaternions.interpolated(a, b, s))

vectors = st.tuples(*[st.floats(-10.0, 10.0)] * 3).map(np.array)
turns = st.tuples(*[st.floats(-1.7, 1.7)] * 3).map(np.array)
shares = st.floats(0.0, 1.0)


def assert_same(a: object, b: object) -> None:
    """Assert that two quaternions are the same rotation."""
    a, b = np.asarray(a), np.asarray(b)
    # The cosine between them would hide an angle of a milliradian.
    assert min(np.abs(a - b).max(), np.abs(a + b).max()) < 1e-9


@given(turns, turns)
def test_products_are_scipys(a: np.ndarray, b: np.ndarray) -> None:
    qa, qb = from_vector(a), from_vector(b)
    wanted = (Rotation.from_rotvec(a) * Rotation.from_rotvec(b)).as_quat()
    assert_same(multiply(qa, qb), wanted)
    assert_same(product(qa, qb), wanted)


@given(turns, vectors)
def test_turned_vectors_are_scipys(a: np.ndarray, v: np.ndarray) -> None:
    wanted = Rotation.from_rotvec(a).apply(v)
    np.testing.assert_allclose(rotate(from_vector(a), v), wanted, atol=1e-12)
    np.testing.assert_allclose(turned(from_vector(a), v), wanted, atol=1e-12)


@given(turns)
def test_rotation_vectors_come_back(a: np.ndarray) -> None:
    np.testing.assert_allclose(to_vector(from_vector(a)), a, atol=1e-12)
    back = rotation_vector(quaternion(a))
    np.testing.assert_allclose(back, a, atol=1e-12)


@pytest.mark.parametrize("size", [0.0, 1e-300, 1e-12, 1e-9, 9.9e-5, 1.1e-4, 3.14159])
def test_small_and_nearly_half_turns_keep_their_digits(size: float) -> None:
    vector = size * np.array([0.6, -0.8, 0.0])
    q = from_vector(vector)
    np.testing.assert_allclose(to_vector(q), vector, rtol=1e-9)
    np.testing.assert_allclose(quaternion(vector), q, rtol=1e-12, atol=1e-300)
    np.testing.assert_allclose(rotation_vector(q), vector, rtol=1e-9)


@given(turns)
def test_the_sign_of_a_quaternion_does_not_matter(a: np.ndarray) -> None:
    q = from_vector(a)
    np.testing.assert_allclose(to_vector(-q), to_vector(q), atol=1e-12)
    np.testing.assert_allclose(rotation_vector(-q), rotation_vector(q), atol=1e-12)


@given(turns)
def test_a_rotation_and_its_inverse_are_nothing(a: np.ndarray) -> None:
    q = from_vector(a)
    assert_same(multiply(q, conjugate(q)), (0.0, 0.0, 0.0, 1.0))
    assert_same(product(q, np.array(inverse(q))), (0.0, 0.0, 0.0, 1.0))


@given(turns, turns, shares)
def test_slerp_is_scipys(a: np.ndarray, b: np.ndarray, share: float) -> None:
    ends = Rotation.from_rotvec([a, b])
    way = (ends[1] * ends[0].inv()).magnitude()
    if way > 3.1:  # the shorter way is nearly not defined
        return
    wanted = Slerp([0.0, 1.0], ends)(share).as_quat()
    assert_same(slerp(from_vector(a), from_vector(b), np.array(share)), wanted)
    assert_same(interpolated(from_vector(a), from_vector(b), share), wanted)


@given(turns, turns)
def test_slerp_begins_and_ends_at_its_ends(a: np.ndarray, b: np.ndarray) -> None:
    start, end = from_vector(a), from_vector(b)
    assert_same(slerp(start, end, np.array(0.0)), start)
    assert_same(slerp(start, end, np.array(1.0)), end)


@given(st.lists(st.tuples(turns, st.floats(0.1, 5.0)), min_size=1, max_size=5))
def test_the_chordal_mean_is_scipys(each: list[tuple[np.ndarray, float]]) -> None:
    rotations = Rotation.from_rotvec([0.5 * turn for turn, _ in each])
    weights = np.array([weight for _, weight in each])
    assert_same(chordal_mean(rotations.as_quat(), weights), rotations.mean(weights).as_quat())


@given(vectors, turns, vectors, turns, vectors)
def test_composed_frames_place_points_as_one_after_the_other(
    t: np.ndarray, a: np.ndarray, u: np.ndarray, b: np.ndarray, point: np.ndarray
) -> None:
    qa, qb = from_vector(a), from_vector(b)
    translation, rotation = compose(t, qa, u, qb)
    wanted = t + rotate(qa, u + rotate(qb, point))
    np.testing.assert_allclose(translation + rotate(rotation, point), wanted, atol=1e-10)


def test_units_have_length_one_and_nothing_becomes_the_identity() -> None:
    np.testing.assert_allclose(normalize(np.array([[0.0, 3.0, 0.0, 4.0]])), [[0, 0.6, 0, 0.8]])
    assert unit(np.array([0.0, 3.0, 0.0, 4.0])) == pytest.approx((0, 0.6, 0, 0.8))
    assert unit(np.zeros(4)) == (0.0, 0.0, 0.0, 1.0)


def test_functions_work_over_any_leading_axes() -> None:
    q = from_vector(np.random.default_rng(1).normal(size=(2, 3, 3)))
    assert multiply(q, q).shape == (2, 3, 4)
    assert rotate(q, np.ones((2, 3, 3))).shape == (2, 3, 3)
    assert slerp(q, q, np.zeros((2, 3))).shape == (2, 3, 4)
    assert chordal_mean(q, np.ones((2, 3))).shape == (2, 4)
