"""Which MotionEdits there are to solve, what each solves, and from which motion."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from pxr import Usd

from usdmotion.arrays import Floats
from usdmotion.errors import SceneError
from usdmotion.usd.clips import own_times
from usdmotion.usd.concerns import concerns
from usdmotion.usd.constraints import constraint_prims
from usdmotion.usd.grounds import ground_prims
from usdmotion.usd.origins import depends_on, source_of
from usdmotion.usd.relations import (
    bound_animation,
    floats,
    is_a,
    skeleton_of,
    value,
)
from usdmotion.usd.shot import Facts
from usdmotion.usd.stages import refuse
from usdmotion.usd.times import solved_times

DEFAULT_SOLVER = "prioritized_ik"
"""What solves an edit that names no solver."""
_OPTION = "usdmotion:option:"


@dataclass(frozen=True, eq=False)
class Request:
    """One edit that is to be solved, as prims."""

    edit: Usd.Prim
    skeleton: Usd.Prim
    source: Usd.Prim
    time_codes: Floats
    """When, were it solved alone."""
    cleaning: float = 0.0
    """Cutoff of the filter that cleans its input first [Hz]; 0 is none."""
    ground: tuple[Usd.Prim, ...] = ()
    """What its input is put on after that; none leaves it where it is."""

    @property
    def path(self) -> str:
        """Path of the edit."""
        return str(self.edit.GetPath())


def find_edits(stage: Usd.Stage, wanted: Sequence[str]) -> list[Usd.Prim]:
    """Return the MotionEdits of a stage in its order, or those that are wanted.

    Raises:
        SceneError: There is none, or a wanted one is not there.
    """
    prims = Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies())
    edits = {str(prim.GetPath()): prim for prim in prims if is_a(prim, "UsdMotionEdit")}
    if not edits:
        raise SceneError("there is no MotionEdit to solve; put one under the Skeleton")
    for path in wanted:
        if path not in edits:
            raise SceneError(f"<{path}> is no MotionEdit; there are: {', '.join(edits)}")
    chosen = [prim for path, prim in edits.items() if not wanted or path in wanted]
    for prim in chosen:
        if prim.IsInstanceProxy():
            raise SceneError(
                f"<{prim.GetPath()}> is inside an instance, where no result can be written; move "
                "it out and name its skeleton in usdmotion:skeleton"
            )
    return chosen


def unsolved_edits(stage: Usd.Stage, solved: Collection[str]) -> list[list[str]]:
    """Return the paths of the edits that ask for something and are not among those solved.

    They are in groups that can be read together, because no two in one are of the same Skeleton.
    An edit that instances share is named once, in the first of them.
    """
    groups: list[dict[str, str]] = []
    shared: set[Usd.Prim] = set()
    for prim in Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies()):
        path = str(prim.GetPath())
        if not is_a(prim, "UsdMotionEdit") or path in solved or not any(constraint_prims(prim)):
            continue
        if prim.IsInstanceProxy():
            if prim.GetPrimInPrototype() in shared:
                continue
            shared.add(prim.GetPrimInPrototype())
        found = skeleton_of(prim)
        skeleton = path if found is None else str(found.GetPath())
        group = next((each for each in groups if skeleton not in each), None)
        if group is None:
            groups.append(group := {})
        group[skeleton] = path
    return [list(group.values()) for group in groups]


def request(
    edit: Usd.Prim,
    frames: tuple[float, float] | None,
    facts: Facts,
    *,
    cleaning: float | None = None,
    ground: Sequence[str] | None = None,
) -> Request:
    """Return what an edit asks to be solved.

    Args:
        edit: The MotionEdit.
        frames: First and last time code, over what the edit says.
        facts: Rates and range of the stage.
        cleaning: Cutoff of the filter of its input [Hz], over what the edit says.
        ground: Paths of the prims that it stands on, over what the edit says.

    Raises:
        SceneError: It cannot be solved as it is.
    """
    refuse(concerns(edit))
    skeleton = skeleton_of(edit)
    refuse(concerns(skeleton))
    source = source_of(edit, skeleton)
    span = floats(value(edit, "usdmotion:range", ()))
    times = solved_times(
        own_times(source),
        frames or ((span[0], span[1]) if span else None),
        float(value(edit, "usdmotion:sampleRate", 0.0)),
        facts,
        f"<{edit.GetPath()}>",
    )
    return Request(
        edit, skeleton, source, times, _cleaning(edit, cleaning), ground_prims(edit, ground)
    )


def refuse_rivals(requests: Sequence[Request]) -> None:
    """Raise if two edits are to solve one skeleton, because only one result can be bound to it.

    Raises:
        SceneError: Two do.
    """
    seen: dict[str, str] = {}
    for each in requests:
        skeleton = str(each.skeleton.GetPath())
        if skeleton in seen:
            raise SceneError(
                f"<{seen[skeleton]}> and <{each.path}> both solve <{skeleton}>; solve one after "
                "the other, each named with --edit, or deactivate one"
            )
        seen[skeleton] = each.path


def options_of(edit: Usd.Prim) -> dict[str, object]:
    """Return the solver options that an edit carries."""
    attributes = edit.GetAuthoredPropertiesInNamespace(_OPTION.rstrip(":"))
    return {
        attribute.GetName().removeprefix(_OPTION): attribute.Get(Usd.TimeCode.EarliestTime())
        for attribute in attributes
        if isinstance(attribute, Usd.Attribute) and attribute.HasAuthoredValue()
    }


def result_path(edit: Usd.Prim) -> str:
    """Return where the result of an edit is written: beside it.

    Raises:
        SceneError: Something else is there.
    """
    path = f"{edit.GetPath()}_result"
    there = edit.GetStage().GetPrimAtPath(path)
    if there and not depends_on(there, edit):
        raise SceneError(
            f"<{path}> is where the result of <{edit.GetPath()}> is written, and it is something "
            "else; rename one of them"
        )
    return path


def animation_to_bind(edit: Usd.Prim, skeleton: Usd.Prim) -> str:
    """Return the path of what is to be bound: the result, or what another edit stacked on it."""
    bound = bound_animation(skeleton)
    if bound is not None and depends_on(bound, edit):
        return str(bound.GetPath())
    return result_path(edit)


def _cleaning(edit: Usd.Prim, given: float | None) -> float:
    """Return the cutoff of the filter of an edit's input [Hz], 0 for none."""
    name = "usdmotion:cleaning"
    cutoff = float(value(edit, name, 0.0)) if given is None else given
    if not 0.0 <= cutoff < float("inf"):
        raise SceneError(
            f"<{edit.GetPath()}> is to be cleaned at {cutoff:g} Hz; set {name} to a cutoff in "
            "hertz, such as 10, or to 0 for no cleaning"
        )
    return cutoff
