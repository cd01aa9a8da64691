"""What is drawn over a pose: trajectories, goals, balance, and what is missed."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.drawing.strips import Curve, Mark, Patch, Spot
from usdmotion.drawing.style import BEFORE, COURSE, GOAL, INK, MISSED, SUPPORT
from usdmotion.guides.supports import support_guide
from usdmotion.quality import along_ground
from usdmotion.showing.shown import BalanceMark, Course, GoalMark, Miss, ShownEdit, ShownScene

AROUND = 2.0
"""Trajectories are drawn from so long before to so long after: who walks to and fro is seen [s]."""
_STILL = 0.022
"""An effector that stays within this has no trajectory to be seen, in lengths of a leg."""
_CHANGED = 0.011
"""A trajectory that is changed by less is drawn as one that is kept, in lengths of a leg."""
_ALONG = 0.45
"""Of two trajectories that are never farther apart, as of a heel and a toe, one is drawn, in
lengths of a leg."""
_PALE = 0.35
"""How strong a trajectory is where the effector is not yet, and what it was."""
_FAINT = 0.2
"""Of a goal that is hardly on."""
_MARGIN = 0.022
"""How far the area of support goes around its points, in lengths of a leg."""
_AT = 1e-3
"""A goal nearer to what is missed than this is that, in lengths of a leg."""


def marks(shown: ShownScene, frame: int, *, after: bool) -> tuple[Mark, ...]:
    """Return what is to be drawn over the poses of one frame.

    Args:
        shown: What there is to see of a scene.
        frame: Number of the frame.
        after: Whether the results are drawn; else the inputs.
    """
    up, times = shown.scene.up, shown.scene.times
    ends = np.searchsorted(times, times[frame] + np.array((-AROUND, AROUND)))
    span = slice(int(ends[0]), int(ends[1]))
    legs = {each.character.path: each.character.leg_length for each in shown.actors}
    return tuple(
        mark
        for edit in shown.edits
        for mark in _Marking(edit, legs[edit.skeleton], up, span, frame, after).marks()
    )


@dataclass(frozen=True, eq=False)
class _Marking:
    """One edit, drawn at one frame."""

    edit: ShownEdit
    leg: float
    """How long a leg of its body is [m]: how large it is."""
    up: Floats
    span: slice
    """Frames of which trajectories are drawn."""
    frame: int
    after: bool

    def marks(self) -> Iterator[Mark]:
        """Yield what is to be drawn, what is missed last."""
        edit, frame = self.edit, self.frame
        for course in self._apart():
            yield from self._course(course)
        if edit.balance is not None:
            yield from self._balance(edit.balance)
        for link in edit.links:
            ends = (link.after if self.after and link.after is not None else link.before)[frame]
            if link.activity[frame] > 0.0:
                yield Curve(ends, GOAL, 1.6, float(link.activity[frame]), beyond=False)
                yield from (Spot(end, "held", GOAL) for end in ends)
        missed = [each for each in edit.misses if self.after and each.missed[frame]]
        for goal in edit.goals:
            if goal.activity[frame] > 0.0 and not self._is_missed(goal, missed):
                opacity = _FAINT + (1.0 - _FAINT) * float(goal.activity[frame])
                yield Spot(goal.translations[frame], "goal", GOAL, opacity)
        for miss in missed:
            yield from _miss(miss, frame)

    def _apart(self) -> list[Course]:
        """Return trajectories without those along one of a higher rank, as a heel and a toe."""
        found: list[Course] = []
        for course in self.edit.courses:
            ways = [np.linalg.norm(_latest(course) - _latest(each), axis=1) for each in found]
            if all(away.max() > _ALONG * self.leg for away in ways):
                found.append(course)
        return found

    def _course(self, course: Course) -> Iterator[Mark]:
        """Yield a trajectory: strong where the effector was, pale where it will be.

        One that was changed is drawn beside what it was. One that was kept is thin.
        """
        span, frame = self.span, self.frame
        result = course.after if self.after and course.after is not None else None
        points = course.before if result is None else result
        shift = 0.0 if course.after is None else _farthest(course.after - course.before)
        changed = course.after is None or shift > _CHANGED * self.leg
        if result is not None and changed:
            yield Curve(course.before[span], BEFORE, 0.8, _PALE)
        if _farthest(points[span] - points[frame]) > _STILL * self.leg:
            color = BEFORE if result is None else COURSE
            width = 1.3 if changed else 0.7
            yield Curve(points[frame : span.stop], color, width, _PALE)
            yield Curve(points[span.start : frame + 1], color, width)

    def _balance(self, mark: BalanceMark) -> Iterator[Mark]:
        """Yield the centre of mass, plumb over the hull of what it is supported by."""
        frame, up = self.frame, self.up
        result = mark.after if self.after and mark.after is not None else None
        center = (mark.before if result is None else result)[frame]
        supports = mark.supports_before if result is None else mark.supports
        bearing = supports[frame][mark.bearing[frame]]
        if len(bearing):
            foot = along_ground(center, up) + float(np.mean(bearing @ up)) * up
            one, margin = slice(frame, frame + 1), _MARGIN * self.leg
            area = support_guide(supports[one], mark.bearing[one], up, margin).corners[0]
            yield Patch(area, SUPPORT)
            yield Curve(np.stack([center, foot]), INK, 0.7, 0.7, dashed=True)
            yield Spot(foot, "held", INK)
        yield Spot(center, "mass", INK)

    def _is_missed(self, goal: GoalMark, missed: Sequence[Miss]) -> bool:
        """Tell whether a goal is where something is missed, and is drawn as that."""
        frame = self.frame
        there = [each.wanted[frame] for each in missed if each.wanted is not None]
        away = [float(np.linalg.norm(goal.translations[frame] - each)) for each in there]
        return min(away, default=np.inf) < _AT * self.leg


def _latest(course: Course) -> Floats:
    return course.before if course.after is None else course.after


def _miss(miss: Miss, frame: int) -> Iterator[Mark]:
    """Yield what is missed: from the effector to where it is wanted, by its name."""
    place, name = miss.places[frame], miss.name
    if miss.wanted is None:
        yield Spot(place, "missed", MISSED, text=name)
        return
    yield Curve(np.stack([place, miss.wanted[frame]]), MISSED, 1.6, beyond=False)
    yield Spot(place, "held", MISSED)
    yield Spot(miss.wanted[frame], "missed", MISSED, text=name)


def _farthest(shifts: Floats) -> float:
    return float(np.linalg.norm(shifts, axis=1).max(initial=0.0))
