"""Everything that a report tells of an outcome, measured from its motions; nothing is drawn."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from usdmotion.arrays import Bools, Floats
from usdmotion.cast import Character
from usdmotion.constraints import Constraint
from usdmotion.kernels import conjugate, forward, multiply, to_vector
from usdmotion.measuring import measure, tolerance
from usdmotion.motion import WorldPose
from usdmotion.outcome import Outcome, Record
from usdmotion.quality import jerk
from usdmotion.report.balance import Balance, balance_of
from usdmotion.report.feet import Footing, footings
from usdmotion.report.verdict import ConstraintReport, judged
from usdmotion.scene import Edit, Scene


@dataclass(frozen=True, eq=False)
class Trace:
    """One constraint over time."""

    constraint: Constraint
    name: str
    """Its path without its edit's."""
    verdict: ConstraintReport
    tolerance: float
    """What counts as met, in the unit of the verdict."""
    errors: Floats
    """In that unit, shape (frame_count,)."""
    activity: Floats
    """0..1, its own and that of its goals together, shape (frame_count,)."""
    on: Bools
    """Where it asks for anything at all, be it its original trajectory, shape (frame_count,)."""
    plateau: Bools
    """Where it is judged, shape (frame_count,)."""

    @property
    def missed(self) -> Bools:
        """The frames on which it is judged and not met."""
        return np.asarray(self.plateau & (self.errors > self.tolerance))


@dataclass(frozen=True, eq=False)
class Smoothness:
    """How hard joints are jerked in the input and in the result."""

    time_codes: Floats
    """Between the frames, shape (sample_count,)."""
    before: Floats
    """Input [m/s³], shape (sample_count, joint_count)."""
    after: Floats
    """Result [m/s³]."""
    root: int
    """The joint that also translates."""
    joints: tuple[str, ...]

    @cached_property
    def rms(self) -> tuple[Floats, Floats]:
        """Root mean square over time of input and result, each of shape (joint_count,)."""
        return _rms(self.before), _rms(self.after)


@dataclass(frozen=True, eq=False)
class EditFindings:
    """What became of one edit."""

    edit: Edit
    character: Character
    record: Record
    traces: tuple[Trace, ...]
    """In rank order."""
    turned: Floats
    """How far each joint is turned from the input [degrees], shape (frame_count, joint_count)."""
    moved: Floats
    """How far each joint is from where it was [m], shape (frame_count, joint_count)."""
    smoothness: Smoothness | None
    """None of fewer than four frames."""
    footings: tuple[Footing, ...]
    balance: Balance | None
    """None where there is nothing that it could be over."""

    @property
    def levels(self) -> list[tuple[int, list[Trace]]]:
        """The priorities, the first enforced first, with what is asked at each."""
        ranks = sorted({trace.verdict.priority for trace in self.traces})
        return [(rank, [t for t in self.traces if t.verdict.priority == rank]) for rank in ranks]


@dataclass(frozen=True, eq=False)
class Findings:
    """What became of one scene."""

    scene: Scene
    before: WorldPose
    """The input."""
    after: WorldPose
    """The result."""
    edits: tuple[EditFindings, ...]
    notes: tuple[str, ...]

    def joints(self, skeleton: str) -> slice:
        """Return which nodes of the poses are the joints of a skeleton."""
        return self.scene.nodes(skeleton)


def findings_of(outcome: Outcome) -> Findings:
    """Return what there is to tell of an outcome."""
    scene, cast = outcome.scene, outcome.scene.cast
    solution = outcome.solution
    after = forward(cast.parents, solution.translations, solution.rotations)
    errors = measure(outcome.problem, solution, scene.constraints)
    traces = {
        id(constraint): _trace(scene, constraint, index, errors[:, index])
        for index, constraint in enumerate(scene.constraints)
    }
    edits = []
    for edit, record in zip(scene.edits, outcome.records, strict=True):
        own = sorted((traces[id(each)] for each in edit.constraints), key=_rank)
        edits.append(_edit(outcome, edit, record, own, after))
    before = (cast.positions, cast.orientations)
    return Findings(scene, before, after, tuple(edits), outcome.notes)


def _rank(trace: Trace) -> int:
    return trace.verdict.priority


def _trace(scene: Scene, constraint: Constraint, index: int, errors: Floats) -> Trace:
    demand = scene.demands[index]
    edit = next(each for each in scene.edits if constraint in each.constraints)
    on = demand.plateau
    return Trace(
        constraint=constraint,
        name=constraint.path.removeprefix(f"{edit.path}/"),
        verdict=judged(constraint, errors[on], scene.time_codes[on]),
        tolerance=tolerance(constraint),
        errors=errors,
        activity=demand.activity * _goal_activity(scene, constraint),
        on=demand.activity > 0.0,
        plateau=on,
    )


def _goal_activity(scene: Scene, constraint: Constraint) -> Floats:
    """Return how far the goals of a constraint are on; 1 where it has none, or never all."""
    times = scene.cast.times
    if not constraint.goals:
        return np.ones(len(times))
    return np.asarray(np.max([goal.share(times) for goal in constraint.goals], axis=0))


def _edit(
    outcome: Outcome, edit: Edit, record: Record, traces: Sequence[Trace], after: WorldPose
) -> EditFindings:
    scene, cast, solution = outcome.scene, outcome.scene.cast, outcome.solution
    character = scene.character(edit.skeleton)
    joints = scene.nodes(edit.skeleton)
    turns = multiply(conjugate(cast.rotations[:, joints]), solution.rotations[:, joints])
    shifts = after[0][:, joints] - cast.positions[:, joints]
    feet = footings(scene, edit, after)
    return EditFindings(
        edit=edit,
        character=character,
        record=record,
        traces=tuple(traces),
        turned=np.degrees(np.linalg.norm(to_vector(turns), axis=-1)),
        moved=np.linalg.norm(shifts, axis=-1),
        smoothness=_smoothness(scene, character, after[0][:, joints], joints),
        footings=feet,
        balance=balance_of(scene, edit, feet, after),
    )


def _smoothness(
    scene: Scene, character: Character, after: Floats, joints: slice
) -> Smoothness | None:
    cast = scene.cast
    if cast.frame_count < 4:
        return None
    when, before = jerk(cast.times, cast.positions[:, joints])
    codes = np.interp(when, cast.times, scene.time_codes)
    tokens = character.skeleton.joints
    return Smoothness(codes, before, jerk(cast.times, after)[1], character.root, tokens)


def _rms(values: Floats) -> Floats:
    return np.asarray(np.sqrt(np.mean(values**2, axis=0)))
