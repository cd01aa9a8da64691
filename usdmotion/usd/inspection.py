"""What is on a stage, as plain values that a table or JSON can show; nothing is solved."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from pxr import Usd, UsdSkel

from usdmotion.constraints import Constraint
from usdmotion.errors import SceneError
from usdmotion.usd.balance import Note, falls
from usdmotion.usd.clips import own_times
from usdmotion.usd.constraints import constraint_prims, goal_prims
from usdmotion.usd.edits import DEFAULT_SOLVER, options_of
from usdmotion.usd.faults import Fault, find
from usdmotion.usd.origins import source_of
from usdmotion.usd.relations import (
    bound_animation,
    edit_of,
    floats,
    is_a,
    joints_of,
    skeleton_of,
    value,
)
from usdmotion.usd.roots import root_of
from usdmotion.usd.stages import composition_faults, open_stage, read_facts


@dataclass(frozen=True, slots=True)
class SkeletonFacts:
    """One Skeleton."""

    path: str
    joint_count: int
    root: str
    """The joint with six degrees of freedom in a solve."""
    animation: str
    """Path of the SkelAnimation that is bound, "" for none."""
    rest: bool
    """Whether it has rest transforms, one for each joint."""
    bind: bool
    """Whether it has bind transforms, one for each joint."""
    instance: bool
    """Whether it is inside an instance."""
    parts: int
    """How many joints are known to be which part of a body."""
    joints: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class ClipFacts:
    """One SkelAnimation."""

    path: str
    joint_count: int
    samples: int
    first: float | None
    """Time code of its first sample."""
    last: float | None
    rate: float | None
    """Samples per second, by the median of their distances."""
    edit: str
    """Path of the MotionEdit that it is a result of, "" for none."""
    source: str
    """Path of the SkelAnimation that it was made from, "" for none."""


@dataclass(frozen=True, slots=True)
class EditFacts:
    """One MotionEdit."""

    path: str
    skeleton: str
    source: str
    solver: str
    range: tuple[float, ...]
    """First and last time code; empty is all of the source."""
    sample_rate: float
    constraint_count: int
    options: tuple[str, ...]
    """Each as name=value."""


@dataclass(frozen=True, slots=True)
class ConstraintFacts:
    """One constraint of an edit."""

    path: str
    type: str
    edit: str
    priority: int
    joint: str
    recruits: tuple[str, ...]
    """Empty: from its joint up to the root."""
    times: tuple[float, ...]
    goals: tuple[str, ...]
    """Name and mode of each."""
    solvable: bool
    """Whether something installed can solve such constraints."""


@dataclass(frozen=True, slots=True)
class ContactFacts:
    """One contact, detected or authored."""

    path: str
    kind: str
    target: str
    """The joint, or the path of the prim, that is held."""
    times: tuple[float, ...]
    template: bool


@dataclass(frozen=True, slots=True)
class Inspection:
    """What is on a stage."""

    file: str
    meters_per_unit: float
    up_axis: str
    time_codes_per_second: float
    frames_per_second: float
    start: float | None
    end: float | None
    default_prim: str
    skeletons: tuple[SkeletonFacts, ...]
    clips: tuple[ClipFacts, ...]
    edits: tuple[EditFacts, ...]
    constraints: tuple[ConstraintFacts, ...]
    contacts: tuple[ContactFacts, ...]
    faults: tuple[Fault, ...]
    notes: tuple[Note, ...]


def inspect(path: Path, kinds: Sequence[type[Constraint]]) -> Inspection:
    """Return what is on a stage, and every fault found, whatever state it is in.

    Args:
        path: A file of USD.
        kinds: The constraint kinds that can be solved.

    Raises:
        FileError: The file cannot be opened.
    """
    stage = open_stage(path)
    facts = read_facts(stage)
    prims = list(Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies()))
    edits = [prim for prim in prims if is_a(prim, "UsdMotionEdit")]
    constraints = [prim for edit in edits for prim in constraint_prims(edit)]
    known = {kind.schema for kind in kinds}
    return Inspection(
        file=str(path),
        meters_per_unit=facts.meters_per_unit,
        up_axis=facts.up_axis,
        time_codes_per_second=facts.time_codes_per_second,
        frames_per_second=facts.frames_per_second,
        start=facts.start,
        end=facts.end,
        default_prim=facts.default_prim,
        skeletons=tuple(_skeleton(prim, edits) for prim in prims if is_a(prim, "UsdSkelSkeleton")),
        clips=tuple(
            _clip(prim, facts.time_codes_per_second)
            for prim in prims
            if is_a(prim, "UsdSkelAnimation")
        ),
        edits=tuple(_edit(prim) for prim in edits),
        constraints=tuple(_constraint(prim, known) for prim in constraints),
        contacts=tuple(
            _contact(prim) for prim in prims if is_a(prim, "UsdMotionContactConstraint")
        ),
        faults=(*composition_faults(stage), *find(stage)),
        notes=tuple(note for edit in edits for note in falls(edit)),
    )


def _skeleton(prim: Usd.Prim, edits: Sequence[Usd.Prim]) -> SkeletonFacts:
    tokens = joints_of(prim)
    animation = bound_animation(prim)
    skeleton = UsdSkel.Skeleton(prim)
    return SkeletonFacts(
        path=str(prim.GetPath()),
        joint_count=len(tokens),
        root=tokens[root_of(prim, _start(prim, edits))] if tokens else "",
        animation=str(animation.GetPath()) if animation else "",
        rest=len(skeleton.GetRestTransformsAttr().Get() or ()) == len(tokens) > 0,
        bind=len(skeleton.GetBindTransformsAttr().Get() or ()) == len(tokens) > 0,
        instance=prim.IsInstanceProxy(),
        parts=sum(bool(part) for part in value(prim, "usdmotion:parts", ())),
        joints=tokens,
    )


def _start(skeleton: Usd.Prim, edits: Sequence[Usd.Prim]) -> Usd.Prim | None:
    """Return the animation from which a solve of a skeleton starts."""
    for edit in edits:
        if skeleton_of(edit) == skeleton:
            try:
                return source_of(edit, skeleton)
            except SceneError:  # the faults say so
                pass
    return bound_animation(skeleton)


def _clip(prim: Usd.Prim, time_codes_per_second: float) -> ClipFacts:
    times = own_times(prim)
    step = float(np.median(np.diff(times))) if len(times) > 1 else 0.0
    return ClipFacts(
        path=str(prim.GetPath()),
        joint_count=len(joints_of(prim)),
        samples=len(times),
        first=float(times[0]) if len(times) else None,
        last=float(times[-1]) if len(times) else None,
        rate=time_codes_per_second / step if step else None,
        edit=_target(prim, "usdmotion:result:edit"),
        source=_target(prim, "usdmotion:result:source"),
    )


def _edit(prim: Usd.Prim) -> EditFacts:
    skeleton = skeleton_of(prim)
    source = ""
    if skeleton is not None:
        try:
            source = str(source_of(prim, skeleton).GetPath())
        except SceneError:  # the faults say so
            pass
    return EditFacts(
        path=str(prim.GetPath()),
        skeleton=str(skeleton.GetPath()) if skeleton else "",
        source=source,
        solver=str(value(prim, "usdmotion:solver", "")) or DEFAULT_SOLVER,
        range=tuple(floats(value(prim, "usdmotion:range", ()))),
        sample_rate=float(value(prim, "usdmotion:sampleRate", 0.0)),
        constraint_count=sum(1 for _ in constraint_prims(prim)),
        options=tuple(f"{name}={held}" for name, held in options_of(prim).items()),
    )


def _constraint(prim: Usd.Prim, known: set[str]) -> ConstraintFacts:
    edit = edit_of(prim)
    return ConstraintFacts(
        path=str(prim.GetPath()),
        type=str(prim.GetTypeName()),
        edit=str(edit.GetPath()) if edit else "",
        priority=int(value(prim, "usdmotion:priority", 1)),
        joint=str(value(prim, "usdmotion:joint", "")),
        recruits=tuple(str(token) for token in value(prim, "usdmotion:recruits", ())),
        times=tuple(floats(value(prim, "usdmotion:times", ()))),
        goals=tuple(
            f"{goal.GetName()} ({value(goal, 'usdmotion:mode', 'position')})"
            for goal in goal_prims(prim)
        ),
        solvable=str(prim.GetTypeName()) in known,
    )


def _contact(prim: Usd.Prim) -> ContactFacts:
    joint = str(value(prim, "usdmotion:joint", ""))
    return ContactFacts(
        path=str(prim.GetPath()),
        kind=str(value(prim, "usdmotion:kind", "space")),
        target=joint or _target(prim, "usdmotion:object"),
        times=tuple(floats(value(prim, "usdmotion:times", ()))),
        template=bool(value(prim, "usdmotion:template", False)),
    )


def _target(prim: Usd.Prim, name: str) -> str:
    relationship = prim.GetRelationship(name)
    targets = relationship.GetTargets() if relationship else ()
    return str(targets[0]) if targets else ""
