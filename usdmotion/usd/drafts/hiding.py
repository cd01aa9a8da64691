"""Opinions that would hide what is to be written, because they are in stronger layers."""

from collections.abc import Iterator

from pxr import Sdf

from usdmotion.errors import SceneError
from usdmotion.usd.drafts.merging import VALUES
from usdmotion.usd.drafts.retiming import retime
from usdmotion.usd.drafts.targets import Target, called, offset_of
from usdmotion.usd.drawn import is_home_spec

_FIELDS = ("active", "typeName")
"""Fields of a prim that are what the strongest layer says."""
_SCHEMAS = "apiSchemas"


def refuse_hidden(draft: Sdf.Layer, target: Target) -> None:
    """Raise if something that is to be written would not be seen.

    Args:
        draft: What is to be written, in the time codes of the target.
        target: Where.

    Raises:
        SceneError: A stronger layer says something else.
    """
    for layer in target.stronger:
        for path in _hidden(draft, _in_times_of(target, layer)):
            raise _is_hidden(path, layer, target)


def refuse_hidden_guides(target: Target) -> None:
    """Raise if guides that were drawn would not be seen, because there are others above them.

    Args:
        target: Where they were drawn.

    Raises:
        SceneError: A stronger layer has guides in the same place.
    """
    drawn: list[Sdf.Path] = []
    target.layer.Traverse(Sdf.Path.absoluteRootPath, drawn.append)
    for path in drawn:
        if path.IsPrimPath() and is_home_spec(target.layer.GetPrimAtPath(path)):
            for layer in target.stronger:
                if is_home_spec(layer.GetPrimAtPath(path)):
                    raise _is_hidden(path, layer, target)


def _is_hidden(path: Sdf.Path, layer: Sdf.Layer, target: Target) -> SceneError:
    return SceneError(
        f"<{path}> is authored in {called(layer, target.stage)}, which is stronger than the edit "
        f"target {called(target.layer, target.stage)} and would hide what is written there; clear "
        "it, or make the stronger layer the edit target"
    )


def _in_times_of(target: Target, layer: Sdf.Layer) -> Sdf.Layer:
    """Return a layer, or what it says in the time codes of a target where those are others."""
    offset = target.offset.GetInverse() * offset_of(target.stage, layer)
    if offset.IsIdentity():
        return layer
    found = Sdf.Layer.CreateAnonymous()
    found.TransferContent(layer)
    retime(found, offset)
    return found


def _hidden(draft: Sdf.Layer, layer: Sdf.Layer) -> Iterator[Sdf.Path]:
    """Yield what a stronger layer hides of a draft."""
    paths: list[Sdf.Path] = []
    draft.Traverse(Sdf.Path.absoluteRootPath, paths.append)
    for path in sorted(paths):
        spec = draft.GetObjectAtPath(path)
        above = layer.GetObjectAtPath(path)
        if isinstance(spec, Sdf.PrimSpec) and isinstance(above, Sdf.PrimSpec):
            if not path.IsAbsoluteRootPath() and _hides_prim(above, spec):
                yield path
        elif isinstance(spec, Sdf.PropertySpec) and isinstance(above, Sdf.PropertySpec):
            if _hides_property(above, spec):
                yield path


def _hides_prim(above: Sdf.PrimSpec, spec: Sdf.PrimSpec) -> bool:
    # What is switched off above is switched off with whatever is written into it.
    off = above.HasInfo("active") and not above.active and not spec.HasInfo("active")
    return (
        off
        or any(
            above.HasInfo(key) and spec.HasInfo(key) and above.GetInfo(key) != spec.GetInfo(key)
            for key in _FIELDS
        )
        or _hides_schemas(above, spec)
    )


def _hides_schemas(above: Sdf.PrimSpec, spec: Sdf.PrimSpec) -> bool:
    if not (above.HasInfo(_SCHEMAS) and spec.HasInfo(_SCHEMAS)):
        return False
    applied = spec.GetInfo(_SCHEMAS).GetAddedOrExplicitItems()
    return not set(applied) <= set(above.GetInfo(_SCHEMAS).ApplyOperations(applied))


def _hides_property(above: Sdf.PropertySpec, spec: Sdf.PropertySpec) -> bool:
    for key in VALUES:
        if not above.HasInfo(key):
            continue
        value = above.GetInfo(key)
        if hasattr(value, "ApplyOperations"):
            value = value.ApplyOperations(spec.GetInfo(key))
        if not spec.HasInfo(key) or value != spec.GetInfo(key):
            return True
    return False
