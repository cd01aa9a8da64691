"""When it is worth looking: where goals and contacts are on, where most is missing."""

from collections.abc import Iterator, Sequence

import numpy as np

from usdmotion.arrays import Bools
from usdmotion.guides import ContactMark
from usdmotion.quality import runs
from usdmotion.showing import ShownEdit, ShownScene

_ON = 0.999
"""Activity of a goal that is wholly on."""


def tiers_of(scenes: Sequence[ShownScene], contacts: Sequence[ContactMark]) -> list[list[float]]:
    """Return time codes of what there is to be seen, the most important first.

    They are the frames where most is missed, then the middles of what goals ask, then those of
    contacts, and of what else is asked without a goal.
    """
    holds = [0.5 * (each.start + each.end) for each in contacts if not each.always]
    edits = [(scene.scene.time_codes.tolist(), edit) for scene in scenes for edit in scene.edits]
    worst, wanted, asked = (
        [codes[frame] for codes, edit in edits for frame in frames(edit)]
        for frames in (_worst, _wanted, _asked)
    )
    return [worst, wanted, holds, asked]


def _worst(edit: ShownEdit) -> Iterator[int]:
    for miss in edit.misses:
        yield int(np.where(miss.missed, miss.errors, -1.0).argmax())


def _wanted(edit: ShownEdit) -> Iterator[int]:
    for goal in edit.goals:
        yield from _middles(goal.activity >= min(_ON, float(goal.activity.max(initial=0.0))))


def _asked(edit: ShownEdit) -> Iterator[int]:
    for course in edit.courses:
        yield from _middles(course.on)


def _middles(on: Bools) -> Iterator[int]:
    """Yield the middles of stretches that are not all of a clip: those say nothing of when."""
    for first, end in runs(on):
        if end - first < len(on):
            yield (first + end - 1) // 2
