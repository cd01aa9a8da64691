"""The thresholds of height and speed with which that rule agrees best with labels."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from usdmotion import Bools, Floats, Search
from usdmotion_contacts.height_and_speed import HeightAndSpeed, heights_and_speeds

_CANDIDATES = 1024
"""How many values of each threshold are tried at most."""


@dataclass(frozen=True)
class Thresholds:
    """What the rule can do at best on frames that somebody has labelled."""

    height: float
    """Of the lowest point above the ground [m]."""
    speed: float
    """Of the slowest point [m/s]."""
    f1: float
    """Harmonic mean of precision and recall over the judged frames of all searches together."""

    @property
    def detector(self) -> HeightAndSpeed:
        """The rule with them."""
        return HeightAndSpeed(height=self.height, speed=self.speed)


def best_thresholds(
    searches: Sequence[Search], labels: Sequence[Bools], judged: Sequence[Bools] | None = None
) -> Thresholds:
    """Return the pair of thresholds whose answer has the largest F1, frame by frame.

    One pair serves all searches. It is looked for among what heights and speeds the labelled frames
    have, up to 1,024 quantiles of each: with fewer such frames no pair is better. Of equally good
    ones it is that of the lowest height, and then of the lowest speed.

    Args:
        searches: Objects, at least one.
        labels: Whether each is held, frame by frame, each of shape (frame_count,).
        judged: On which frames that is the truth, likewise; None is on all.

    Raises:
        ValueError: No judged frame is held, so that there is nothing to agree with.
    """
    given = [heights_and_speeds(each) for each in searches]
    held = np.concatenate([np.asarray(each, dtype=np.bool_) for each in labels])
    counts = np.ones_like(held) if judged is None else np.concatenate(list(judged)).astype(bool)
    heights, speeds = (np.concatenate([each[axis] for each in given])[counts] for axis in range(2))
    held = held[counts]
    if not held.any():
        raise ValueError("no judged frame is held: there is nothing that thresholds could fit")
    rows, columns = _candidates(heights[held]), _candidates(speeds[held])
    hits = _under(heights[held], speeds[held], rows, columns)
    said = hits + _under(heights[~held], speeds[~held], rows, columns)
    f1 = 2.0 * hits / (said + held.sum())
    row, column = np.unravel_index(np.argmax(f1), f1.shape)
    return Thresholds(float(rows[row]), float(columns[column]), float(f1[row, column]))


def _candidates(values: Floats) -> Floats:
    """Return thresholds to try, ascending: between two labelled values none is better."""
    distinct = np.unique(values)
    if len(distinct) <= _CANDIDATES:
        return distinct
    kept = np.linspace(0, len(distinct) - 1, _CANDIDATES).round().astype(np.int64)
    return np.asarray(distinct[kept])


def _under(heights: Floats, speeds: Floats, rows: Floats, columns: Floats) -> Floats:
    """Return how many frames are under each pair of thresholds, (row_count, column_count)."""
    counts = np.zeros((len(rows) + 1, len(columns) + 1))
    np.add.at(counts, (np.searchsorted(rows, heights), np.searchsorted(columns, speeds)), 1.0)
    return np.asarray(counts.cumsum(axis=0).cumsum(axis=1)[:-1, :-1])
