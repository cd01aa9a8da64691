"""A prepared call does what a call does, whatever becomes of what it was made with."""

import gc
import os
import subprocess
import sys
import tracemalloc
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

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


GUEST = """
from typing import NamedTuple
import numpy as np
from usdmotion.arrays import Floats
from usdmotion.kernels import Prepared, Reference, apart

class Own{name}(NamedTuple):
    values: Floats

def add(own: Reference[Own{name}], by: int) -> None:
    own[0].values[0] += by

own = Own{name}(np.zeros(1))
Prepared(apart(add, own=own), own)(7)
print(own.values[0])
"""


@pytest.mark.slow
@pytest.mark.parametrize("shared", ["XDG_CACHE_HOME", "NUMBA_CACHE_DIR"])
def test_what_one_plugin_leaves_on_disk_is_no_burden_where_it_is_not_installed(
    tmp_path: Path, shared: str
) -> None:
    for name in ("First", "Second"):
        folder = tmp_path / name
        folder.mkdir()
        (folder / f"{name.lower()}.py").write_text(GUEST.format(name=name))
        done = subprocess.run(
            [sys.executable, "-c", f"import {name.lower()}"],
            env=os.environ | {shared: str(tmp_path / "cache")},
            cwd=folder,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.stdout == "7.0\n", done.stderr
