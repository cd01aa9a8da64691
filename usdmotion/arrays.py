"""The array types of the project, and the only check of shapes."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from usdmotion.errors import UsdMotionError

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]


class ShapeError(UsdMotionError, ValueError):
    """An array does not have the shape that its docstring promises."""


def seal(
    values: ArrayLike, *shape: int | None, dtype: DTypeLike = np.float64, name: str = "array"
) -> NDArray[Any]:
    """Return values as a contiguous read-only array of the given shape.

    Args:
        values: What to seal. It is copied, unless it is sealed already.
        shape: Length of each axis; None allows any.
        dtype: Type of the elements.
        name: What to call the array in the error.

    Raises:
        ShapeError: The shape is another one.
    """
    array = np.asarray(values, dtype=dtype)
    # The first comparison says the same of most arrays, in a tenth of the time.
    fits = array.shape == shape or (
        array.ndim == len(shape)
        and all(want is None or want == have for want, have in zip(shape, array.shape, strict=True))
    )
    if not fits:
        wanted = ", ".join("any" if length is None else str(length) for length in shape)
        raise ShapeError(f"{name} has shape {array.shape}, not ({wanted})")
    if array.flags.writeable or not array.flags.c_contiguous:
        array = np.array(array, order="C")
        array.flags.writeable = False
    return array
