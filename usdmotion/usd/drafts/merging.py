"""What one layer says put into another, over what is there."""

from collections.abc import Collection, Iterator
from contextlib import contextmanager
from typing import Any

from pxr import Sdf

VALUES = ("default", "timeSamples", "spline", "targetPaths", "connectionPaths")
"""Fields of a property that say what it is: where one is said, it is said instead of all."""
_KINDS = ("custom", "typeName", "variability")


@contextmanager
def whole_or_not(layer: Sdf.Layer) -> Iterator[None]:
    """Change a layer, or, where that fails, leave it as it was."""
    before = Sdf.Layer.CreateAnonymous()
    before.TransferContent(layer)
    try:
        yield
    except BaseException:
        layer.TransferContent(before)
        raise


def merge(source: Sdf.Layer, layer: Sdf.Layer, whole: Collection[Sdf.Path]) -> None:
    """Put the prims of a layer into another.

    Fields of prims are as if the one layer were over the other; a property that it has takes the
    place of that which is there.

    Args:
        source: What is put.
        layer: Where.
        whole: Paths of prims that take the place of what is there, with all below them.
    """
    for prim in list(source.rootPrims):
        _merge_prim(prim, layer, whole)


def _merge_prim(prim: Sdf.PrimSpec, layer: Sdf.Layer, whole: Collection[Sdf.Path]) -> None:
    there = Sdf.CreatePrimInLayer(layer, prim.path)
    if prim.path in whole:
        Sdf.CopySpec(prim.layer, prim.path, layer, prim.path)
        return
    for key in prim.ListInfoKeys():
        if key != "specifier" or prim.specifier != Sdf.SpecifierOver:
            before = there.GetInfo(key) if there.HasInfo(key) else None
            there.SetInfo(key, _over(prim.GetInfo(key), before))
    for each in list(prim.properties):
        _put_property(each, layer)
    for variants in list(prim.variantSets.values()):
        for variant in list(variants.variants.values()):
            _merge_prim(variant.primSpec, layer, whole)
    for child in list(prim.nameChildren):
        _merge_prim(child, layer, whole)


def _over(value: Any, before: Any) -> Any:
    """Return a value over another one: dictionaries and lists of edits are both at once."""
    if isinstance(value, dict) and isinstance(before, dict):
        return before | {key: _over(held, before.get(key)) for key, held in value.items()}
    if hasattr(value, "ApplyOperations") and isinstance(before, type(value)):
        both = value.ApplyOperations(before)
        return value if both is None else both
    return value


def _put_property(each: Sdf.PropertySpec, layer: Sdf.Layer) -> None:
    there = layer.GetPropertyAtPath(each.path)
    said = {*VALUES, *_KINDS, *each.ListInfoKeys()}
    kept = {} if there is None else {k: there.GetInfo(k) for k in there.ListInfoKeys()}
    Sdf.CopySpec(each.layer, each.path, layer, each.path)
    for key, value in kept.items():
        if key not in said:
            layer.GetPropertyAtPath(each.path).SetInfo(key, value)
