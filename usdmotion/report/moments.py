"""The frames at which it is worth looking: where most is missing, and where most was changed."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.report.findings import EditFindings, Findings, Trace
from usdmotion.report.places import effector_places, missing

MOST = 3
"""How many frames are shown because of what is missing there."""
_APART = 0.25
"""Frames are not shown again that are nearer than this to one that is [s]."""


@dataclass(frozen=True, eq=False)
class Moment:
    """One frame to be looked at."""

    frame: int
    edit: EditFindings
    """Whom to look at."""
    trace: Trace | None
    """What is missing most there; None where it is shown for its change."""


@dataclass(frozen=True, eq=False)
class Mark:
    """Where a constraint has its effector at one frame, and where it wants it."""

    trace: Trace
    place: Floats
    """World [m], shape (3,)."""
    wanted: Floats | None
    """World [m], shape (3,); None where it wants no place."""
    has_goal: bool
    """Whether a goal is on, so that it is not its original trajectory that it wants."""
    missed: bool
    """Whether it is judged here, and not met."""

    @property
    def stands_out(self) -> bool:
        """Whether it is to be named: it is missed, has a goal, or wants something else."""
        return self.missed or self.has_goal or self.wanted is None


def moments(findings: Findings, edit: EditFindings) -> list[Moment]:
    """Return the frames of an edit to be shown: what is missed first, then what is changed most."""
    times = findings.scene.cast.times
    peaks = [
        (float(trace.errors[frame] / trace.tolerance), frame, trace)
        for trace in edit.traces
        for frame in _peaks(trace, times)
    ]
    found: list[Moment] = []
    for _, frame, trace in sorted(peaks, key=lambda peak: -peak[0]):
        if len(found) < MOST and _is_far(times, frame, found):
            found.append(Moment(frame, edit, trace))
    changed = int(edit.moved.max(axis=1).argmax())
    if edit.moved[changed].max() > 0.0 and _is_far(times, changed, found):
        found.append(Moment(changed, edit, None))
    return found


def marks(findings: Findings, frame: int) -> list[Mark]:
    """Return where the effectors are at one frame, and where they are wanted."""
    found = []
    for edit in findings.edits:
        for trace in edit.traces:
            if trace.on[frame]:
                asked = (findings.scene, trace.constraint, findings.after)
                place, left = effector_places(*asked)[frame], missing(*asked)
                there = None if left is None else place + left[frame]
                has_goal = bool(trace.constraint.goals) and trace.activity[frame] > 0.0
                found.append(Mark(trace, place, there, has_goal, bool(trace.missed[frame])))
    return found


def _peaks(trace: Trace, times: Floats) -> list[int]:
    """Return the worst frames of a constraint, far from each other."""
    errors = np.where(trace.missed, trace.errors, 0.0)
    peaks: list[int] = []
    while len(peaks) < MOST and errors.max(initial=0.0) > 0.0:
        frame = int(errors.argmax())
        peaks.append(frame)
        errors[np.abs(times - times[frame]) <= _APART] = 0.0
    return peaks


def _is_far(times: Floats, frame: int, found: Sequence[Moment]) -> bool:
    return all(abs(times[frame] - times[each.frame]) > _APART for each in found)
