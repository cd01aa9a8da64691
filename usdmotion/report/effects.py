"""What a solve did beside what was asked: a few numbers, in the input and in the result."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.report.findings import EditFindings


@dataclass(frozen=True)
class Effect:
    """One number that an edit should not make worse."""

    name: str
    unit: str
    before: float
    """In the input."""
    after: float
    """In the result."""


def effects(edit: EditFindings, up: Floats) -> tuple[Effect, ...]:
    """Return the numbers of an edit, those left out that cannot be told.

    Args:
        edit: What was found.
        up: The direction away from the ground, shape (3,).
    """
    return tuple(_effects(edit, up))


def _effects(edit: EditFindings, up: Floats) -> Iterator[Effect]:
    if edit.footings:
        slid = [(each.slid_before.max(), each.slid_after.max()) for each in edit.footings]
        before, after = np.max(slid, axis=0)
        yield Effect("Largest slide of a standing foot", "m", float(before), float(after))
    if edit.balance is not None:
        away = edit.balance.away(up)
        yield Effect(
            "Centre of mass from the middle of its supports, at most",
            "m",
            *(float(each.max()) for each in away),
        )
    found = edit.smoothness
    if found is not None:
        both = found.before, found.after
        yield Effect(
            "Jerk of the root, at most", "m/s³", *(float(x[:, found.root].max()) for x in both)
        )
        yield Effect(
            "Jerk of the root, rms", "m/s³", *(float(rms[found.root]) for rms in found.rms)
        )
        yield Effect(
            "Jerk of all joints, rms", "m/s³", *(float(np.sqrt(np.mean(x**2))) for x in both)
        )
