"""Samples over time that say as much as all of them, where what is between is interpolated."""

import numpy as np

from usdmotion.arrays import Floats, Ints


def thinned(times: Floats, values: Floats, tolerance: float) -> Ints:
    """Return which samples are kept so that lines between them are near all of them.

    Of every number its smallest and its largest are among them, where they differ at all.

    Args:
        times: Ascending, shape (frame_count,).
        values: Places, numbers: shape (frame_count, …, size), nearness is Euclidean in the last.
        tolerance: How far what is shown may be from a value that is left out.

    Returns:
        Ascending indices, the ends among them; the first alone where all are within the tolerance
        of it.
    """
    flat = values.reshape(len(times), -1, values.shape[-1])
    if not (_lengths(flat - flat[0]) > tolerance).any():
        return np.zeros(1, dtype=np.int64)
    kept = np.zeros(len(times), dtype=np.bool_)
    kept[[0, -1]] = True
    kept[_extremes(flat, tolerance)] = True
    ends = np.flatnonzero(kept)
    waiting = list(zip(ends[:-1].tolist(), ends[1:].tolist(), strict=True))
    while waiting:
        first, last = waiting.pop()
        middle = _farthest(times, flat, first, last, tolerance)
        if middle:
            kept[middle] = True
            waiting += [(first, middle), (middle, last)]
    return np.flatnonzero(kept)


def _farthest(times: Floats, values: Floats, first: int, last: int, tolerance: float) -> int:
    """Return the sample between two that is farthest from the line, 0 where all are near."""
    if last - first < 2:
        return 0
    between = slice(first + 1, last)
    shares = (times[between] - times[first]) / (times[last] - times[first])
    line = values[first] + shares[:, None, None] * (values[last] - values[first])
    off = _lengths(values[between] - line)
    farthest = int(off.argmax())
    return first + 1 + farthest if off[farthest] > tolerance else 0


def _extremes(values: Floats, tolerance: float) -> Ints:
    """(F, N, C) to the frames on which a number that changes is smallest or largest."""
    numbers = values.reshape(len(values), -1)
    changing = numbers[:, np.ptp(numbers, axis=0) > tolerance]
    return np.concatenate([changing.argmin(axis=0), changing.argmax(axis=0)])


def _lengths(vectors: Floats) -> Floats:
    """(F, N, C) to (F,): the longest of each frame."""
    return np.asarray(np.linalg.norm(vectors, axis=2).max(axis=1, initial=0.0))
