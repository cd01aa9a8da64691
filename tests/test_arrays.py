"""Sealing: one check of shapes, and arrays that stay as they are."""

import numpy as np
import pytest

from usdmotion.arrays import ShapeError, seal
from usdmotion.errors import UsdMotionError


def test_sealing_copies_what_could_still_be_changed() -> None:
    values = np.zeros((2, 3))
    sealed = seal(values, 2, 3)
    values[0, 0] = 1.0
    assert sealed[0, 0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        sealed[0, 0] = 2.0


def test_what_is_sealed_is_not_copied_again() -> None:
    sealed = seal([1.0, 2.0], 2)
    assert seal(sealed, 2) is sealed


def test_a_view_of_another_layout_becomes_contiguous() -> None:
    transposed = seal(np.arange(6.0).reshape(2, 3), 2, 3).T
    sealed = seal(transposed, 3, 2)
    assert sealed.flags.c_contiguous
    np.testing.assert_array_equal(sealed, transposed)


def test_any_length_may_be_left_open() -> None:
    assert seal(np.zeros((5, 3)), None, 3).shape == (5, 3)


@pytest.mark.parametrize("shape", [(3, 2), (2,), (2, 3, 1), (None, 4)])
def test_another_shape_is_refused_by_name(shape: tuple[int | None, ...]) -> None:
    with pytest.raises(ShapeError, match=r"turns has shape \(2, 3\), not \(.*\)"):
        seal(np.zeros((2, 3)), *shape, name="turns")


def test_a_wrong_shape_is_one_of_our_errors_and_a_value_error() -> None:
    assert issubclass(ShapeError, UsdMotionError)
    assert issubclass(ShapeError, ValueError)


def test_the_type_of_the_elements_is_the_one_asked_for() -> None:
    assert seal([1, 2], 2).dtype == np.float64
    assert seal([1.0, 2.0], 2, dtype=np.int64).dtype == np.int64
