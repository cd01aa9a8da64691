"""A prepared call does what a call does, whatever becomes of what it was made with."""

import gc
import tracemalloc
from typing import NamedTuple

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.kernels import Prepared, Reference, apart


class Pair(NamedTuple):
    values: Floats
    sums: Floats


Both = tuple[Pair, float]


def add(both: Reference[Both], first: int, last: int) -> None:
    """Add some of the values, times a number, to the sums."""
    pair, factor = both[0]
    for index in range(first, last):
        pair.sums[index] += factor * pair.values[index]


def made() -> tuple[Prepared, Pair]:
    pair = Pair(np.arange(4.0), np.zeros(4))
    both = (pair, 2.0)
    return Prepared(apart(add, both=both), both), pair


def test_it_works_on_what_it_was_made_with_as_it_is_now() -> None:
    prepared, pair = made()
    prepared(1, 3)
    assert pair.sums.tolist() == [0.0, 2.0, 4.0, 0.0]
    pair.values[:] = 1.0
    prepared(0, 4)
    assert pair.sums.tolist() == [2.0, 4.0, 6.0, 2.0]


def test_it_keeps_what_it_works_on_alive() -> None:
    prepared, pair = made()
    sums = pair.sums
    del pair
    gc.collect()
    filler = [np.full(4, 7.0) for _ in range(1000)]
    prepared(0, 4)
    assert sums.tolist() == [0.0, 2.0, 4.0, 6.0]
    assert all(each[0] == 7.0 for each in filler)


def test_a_call_allocates_nothing() -> None:
    prepared, _ = made()
    prepared(0, 4)
    tracemalloc.start()
    before = tracemalloc.get_traced_memory()[0]
    for _ in range(100):
        prepared(0, 4)
    kept = tracemalloc.get_traced_memory()[0] - before
    tracemalloc.stop()
    assert kept < 100
