"""What is on a stage, as plain values that a table or JSON can show; nothing is solved."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from pxr import Usd, UsdSkel

from usdmotion.constraints import Constraint
from usdmotion.errors import SceneError
from usdmotion.usd.clips import own_times
from usdmotion.usd.constraints import constraint_prims, goal_prims
from usdmotion.usd.detections.contact_prims import contact_prims
from usdmotion.usd.detections.noise_patterns import has_pattern
from usdmotion.usd.detections.searches import DEFAULT_DETECTOR
from usdmotion.usd.drawn import without_guides
from usdmotion.usd.edits import DEFAULT_SOLVER, options_of
from usdmotion.usd.faults import find
from usdmotion.usd.faults.grounds import GROUND
from usdmotion.usd.inspected import (
    ClipFacts,
    ConstraintFacts,
    ContactFacts,
    DetectionFacts,
    EditFacts,
    Inspection,
    Note,
    SkeletonFacts,
)
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
from usdmotion.usd.stages import open_stage, read_facts


def inspect(path: Path, kinds: Sequence[type[Constraint]]) -> Inspection:
    """Return what is on a stage, and every fault found, whatever state it is in.

    Args:
        path: A file of USD.
        kinds: The constraint kinds that can be solved.

    Raises:
        FileError: The file cannot be opened.
    """
    return inspect_stage(open_stage(path), path, kinds)


def inspect_stage(stage: Usd.Stage, path: Path, kinds: Sequence[type[Constraint]]) -> Inspection:
    """Return what is on a stage that is open, as `inspect` does; `path` is how it is called."""
    facts = read_facts(stage)
    everything = Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies())
    prims = list(without_guides(everything))
    edits = [prim for prim in prims if is_a(prim, "UsdMotionEdit")]
    constraints = [prim for edit in edits for prim in constraint_prims(edit)]
    known = {kind.schema for kind in kinds}
    found = find(stage)
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
        detections=tuple(_detection(prim) for prim in prims if is_a(prim, "UsdMotionDetection")),
        contacts=tuple(
            _contact(prim) for prim in prims if is_a(prim, "UsdMotionContactConstraint")
        ),
        faults=tuple(each for each in found if each.severity != "note"),
        notes=tuple(Note(each.path, each.sentence) for each in found if each.severity == "note"),
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
        ground=_targets(prim, GROUND),
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


def _detection(prim: Usd.Prim) -> DetectionFacts:
    contacts = contact_prims(prim)
    on = [each for each in contacts if each.IsActive()]
    edit = edit_of(prim)
    return DetectionFacts(
        path=str(prim.GetPath()),
        object=str(value(prim, "usdmotion:joint", "")) or _target(prim, "usdmotion:object"),
        edit=str(edit.GetPath()) if edit else "",
        detector=str(value(prim, "usdmotion:detector", "")) or DEFAULT_DETECTOR,
        kinds=tuple(str(kind) for kind in value(prim, "usdmotion:kinds", ())),
        contacts=len(on),
        templates=sum(bool(value(each, "usdmotion:template", False)) for each in on),
        switched_off=len(contacts) - len(on),
        pattern=has_pattern(prim),
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
    return next(iter(_targets(prim, name)), "")


def _targets(prim: Usd.Prim, name: str) -> tuple[str, ...]:
    relationship = prim.GetRelationship(name)
    return tuple(map(str, relationship.GetTargets())) if relationship else ()
