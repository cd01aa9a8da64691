"""What is put beside each other: a stage before and after, composed in memory."""

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from pxr import Sdf, Usd, UsdSkel

from usdmotion.errors import SceneError
from usdmotion.usd.bindings import holder_of
from usdmotion.usd.edit_layers import stacked
from usdmotion.usd.relations import bound_animation, is_a, target
from usdmotion.usd.shot import Facts
from usdmotion.usd.stages import open_stage, read_facts, require_composed, used_files

SideKind = Literal["alone", "before", "after"]
_EDIT = "usdmotion:result:edit"
_SOURCE = "usdmotion:result:source"


@dataclass(frozen=True, eq=False)
class Side:
    """One of the stages that are put beside each other."""

    kind: SideKind
    path: Path
    """What it is called after in an error."""
    stage: Usd.Stage
    facts: Facts
    skeletons: frozenset[str]
    """Paths of the Skeletons that have another motion on the other side, or could have."""
    files: frozenset[str]
    """Real path of every file that it is made of."""


def sides_of(files: Sequence[Path], compare: Path | None = None) -> tuple[Side, ...]:
    """Return a shot alone, or as it was before and is after.

    Args:
        files: The shot, and before it the layers that go over it, as `files_of` has them. Where
            they show results, these are put beside what they were made from.
        compare: A layer that goes over the shot, or a stage; what the shot is put beside.

    Raises:
        FileError: A file cannot be opened.
        SceneError: A stage does not compose.
    """
    shot = files[0]
    stage = _composing(stacked(files), shot)
    if compare is not None:
        return _compared(files, stage, compare)
    results = {
        str(prim.GetPath()): source
        for prim in Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies())
        if is_a(prim, "UsdSkelSkeleton") and (source := _source(prim)) is not None
    }
    if not results:
        return (_side("alone", shot, stage, ()),)
    before = Usd.Stage.Open(stage.GetRootLayer(), Sdf.Layer.CreateAnonymous(".usda"))
    before.SetEditTarget(before.GetSessionLayer())
    for skeleton, source in results.items():
        holder = before.GetPrimAtPath(holder_of(before.GetPrimAtPath(skeleton)))
        UsdSkel.BindingAPI.Apply(holder).CreateAnimationSourceRel().SetTargets([source])
    return _side("before", shot, before, results), _side("after", shot, stage, results)


def in_common(sides: Sequence[Side]) -> bool:
    """Tell whether some Skeleton or surface stands on all of some stages by the same path."""
    found = [
        {
            prim.GetPath()
            for prim in Usd.PrimRange.Stage(side.stage, Usd.TraverseInstanceProxies())
            if is_a(prim, "UsdSkelSkeleton") or is_a(prim, "UsdGeomGprim")
        }
        for side in sides
    ]
    return bool(set.intersection(*found))


def _compared(files: Sequence[Path], stage: Usd.Stage, compare: Path) -> tuple[Side, Side]:
    """Return a shot beside a stage, or beside itself below a layer."""
    shot = files[0]
    other = open_stage(compare)
    if os.path.realpath(shot) not in used_files(other) and _goes_over(other):
        other = stacked((compare, *files))
    _composing(other, compare)
    skeletons = [
        str(prim.GetPath())
        for prim in Usd.PrimRange.Stage(other, Usd.TraverseInstanceProxies())
        if is_a(prim, "UsdSkelSkeleton") and _differs(stage.GetPrimAtPath(prim.GetPath()), prim)
    ]
    after = _side("after", compare, other, skeletons)
    return _side("before", shot, stage, skeletons), after


def _side(kind: SideKind, path: Path, stage: Usd.Stage, skeletons: Iterable[str]) -> Side:
    facts = read_facts(stage)
    return Side(kind, path, stage, facts, frozenset(skeletons), used_files(stage))


def _composing(stage: Usd.Stage, path: Path) -> Usd.Stage:
    try:
        require_composed(stage)
    except SceneError as error:
        raise SceneError(f"{path}: {error}") from error
    return stage


def _goes_over(stage: Usd.Stage) -> bool:
    """Tell whether a layer says something only of prims that others define."""
    prims = stage.GetPseudoRoot().GetAllChildren()
    return bool(prims) and all(prim.GetSpecifier() == Sdf.SpecifierOver for prim in prims)


def _source(skeleton: Usd.Prim) -> Sdf.Path | None:
    """Return the path of the motion from which that of a skeleton was made; None if it was not."""
    bound = step = bound_animation(skeleton)
    seen = set()
    while step is not None and step.GetPath() not in seen and _is_result(step):
        seen.add(step.GetPath())
        step = target(step, _SOURCE)
    return None if step is None or step == bound else step.GetPath()


def _is_result(animation: Usd.Prim) -> bool:
    relationship = animation.GetRelationship(_EDIT)
    return bool(relationship) and bool(relationship.GetTargets())


def _differs(before: Usd.Prim, after: Usd.Prim) -> bool:
    """Tell whether a skeleton is moved by another animation, or by one that is not the same."""
    if not before:
        return True
    first, second = bound_animation(before), bound_animation(after)
    if first is None or second is None:
        return first is not second
    stacks = first.GetPrimStack(), second.GetPrimStack()
    return bool(first.GetPath() != second.GetPath() or stacks[0] != stacks[1])
