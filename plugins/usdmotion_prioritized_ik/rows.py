"""The arithmetic of rows: products and sums over the columns that a level moves."""

from usdmotion import Floats
from usdmotion.kernels import summing


@summing
def dot(a: Floats, b: Floats, count: int) -> float:
    """(C,), (C,) to the product of the first so many."""
    total = 0.0
    for index in range(count):
        total += a[index] * b[index]
    return total


@summing
def remove(vector: Floats, direction: Floats, count: int) -> float:
    """(C,), (C,): take from a vector what lies along a unit direction; return how much it was."""
    along = dot(vector, direction, count)
    for index in range(count):
        vector[index] -= along * direction[index]
    return along


@summing
def add(vector: Floats, other: Floats, factor: float, count: int) -> None:
    """(C,), (C,): add a multiple of a vector to another."""
    for index in range(count):
        vector[index] += factor * other[index]
