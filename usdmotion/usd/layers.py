"""Layers in memory, and their way to disk: whole or not at all."""

import os
import uuid
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from pxr import Sdf, Tf, UsdUtils, Vt

from usdmotion.errors import FileError
from usdmotion.usd.shot import Facts, Samples
from usdmotion.usd.stages import reason

SUFFIXES = (".usda", ".usdc", ".usd")


def new_layer(facts: Facts) -> Sdf.Layer:
    """Return an empty layer that is read with the rates, units and axis of a stage."""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.timeCodesPerSecond = facts.time_codes_per_second
    layer.framesPerSecond = facts.frames_per_second
    if facts.start is not None and facts.end is not None:
        layer.startTimeCode = facts.start
        layer.endTimeCode = facts.end
    layer.pseudoRoot.SetInfo("metersPerUnit", facts.meters_per_unit)
    layer.pseudoRoot.SetInfo("upAxis", facts.up_axis)
    return layer


def require_writable(output: Path, inputs: frozenset[str]) -> None:
    """Raise if a layer cannot, or must not, be written to a path.

    Args:
        output: Where a layer is to be written.
        inputs: Real paths of the files that were read.

    Raises:
        FileError: It is an input, or no place for a layer.
    """
    if output.suffix not in SUFFIXES:
        raise FileError(f"{output}: name a file that ends in {', '.join(SUFFIXES)}")
    if os.path.realpath(output) in inputs:
        raise FileError(
            f"{output}: the stage is made of it, and no input is written to; name another"
        )
    if not output.parent.is_dir():
        raise FileError(f"{output}: there is no folder {output.parent}; make it first")


def save(layer: Sdf.Layer, output: Path) -> None:
    """Write a layer to a file: beside its place, then moved there.

    Raises:
        FileError: It cannot be written; nothing is left behind.
    """
    beside = output.with_name(f".{output.stem}.{uuid.uuid4().hex}{output.suffix}")
    try:
        with without_false_alarms():
            exported = layer.Export(str(beside))
        if not exported:
            raise FileError(f"{output}: USD cannot write it")
        os.replace(beside, output)
    except Tf.ErrorException as error:
        raise FileError(f"{output}: cannot be written: {reason(error)}") from error
    except OSError as error:
        raise FileError(f"{output}: cannot be written: {error.strerror}") from error
    finally:
        beside.unlink(missing_ok=True)


@contextmanager
def without_false_alarms() -> Iterator[None]:
    """Keep from people what USD warns of whenever it writes a spline, whatever is in it."""
    delegate = UsdUtils.CoalescingDiagnosticDelegate()
    try:
        yield
    finally:
        heard = delegate.TakeUncoalescedDiagnostics()
        del delegate
        for each in heard:
            if "inner looping is deprecated" not in each.commentary:
                Tf.Warn(each.commentary)


def relative(path: str | Path, folder: str | Path) -> str:
    """Return a path as it is written in a layer in a folder, so that both may move together."""
    parent, name = os.path.split(path)
    found = os.path.relpath(os.path.realpath(parent), os.path.realpath(folder))
    way = Path(found, name).as_posix()
    return way if way.startswith("../") else f"./{way}"


def over(layer: Sdf.Layer, path: str) -> Sdf.PrimSpec:
    """Return the spec of a prim, made as an over where it is not there yet."""
    return Sdf.CreatePrimInLayer(layer, path)


def relate(prim: Sdf.PrimSpec, name: str, *targets: str) -> None:
    """Make a relationship of a prim name some targets, and nothing else."""
    there = prim.relationships.get(name)
    relationship = there or Sdf.RelationshipSpec(prim, name, custom=False)
    relationship.targetPathList.ClearEditsAndMakeExplicit()
    relationship.targetPathList.explicitItems = [Sdf.Path(target) for target in targets]


def apply_schema(prim: Sdf.PrimSpec, name: str) -> None:
    """Apply an API schema to a prim, before those that it has."""
    names = prim.GetInfo("apiSchemas") if prim.HasInfo("apiSchemas") else Sdf.TokenListOp()
    added = [*names.prependedItems, name] if name not in names.prependedItems else None
    if added is not None:
        operation = Sdf.TokenListOp()
        operation.prependedItems = added
        prim.SetInfo("apiSchemas", operation)


def set_value(prim: Sdf.PrimSpec, name: str, kind: Sdf.ValueTypeName, value: object) -> None:
    """Give a prim a uniform attribute."""
    attribute = _attribute(prim, name, kind, Sdf.VariabilityUniform)
    attribute.default = value


def set_varying(
    prim: Sdf.PrimSpec,
    name: str,
    kind: Sdf.ValueTypeName,
    value: object,
    interpolation: str = "",
) -> None:
    """Give a prim an attribute that may vary, with one value or one at each of some times.

    Args:
        prim: The spec.
        name: Name of the attribute.
        kind: Its type.
        value: Its value; a dictionary has those at time codes.
        interpolation: Of a primvar, how it covers the prim.
    """
    attribute = _attribute(prim, name, kind, Sdf.VariabilityVarying)
    if interpolation:
        attribute.SetInfo("interpolation", interpolation)
    if not isinstance(value, dict):
        attribute.default = value
        return
    for code, sample in value.items():
        prim.layer.SetTimeSample(attribute.path, code, sample)


def write_animation(
    prim: Sdf.PrimSpec, joints: Sequence[str], samples: Samples, still: Sequence[str] = ()
) -> None:
    """Make a prim spec a SkelAnimation.

    Args:
        prim: The spec.
        joints: Its joint tokens.
        samples: Its arrays.
        still: Names of arrays of which the first sample is written as the value at all times.
    """
    prim.specifier = Sdf.SpecifierDef
    prim.typeName = "SkelAnimation"
    set_value(prim, "joints", Sdf.ValueTypeNames.TokenArray, Vt.TokenArray(list(joints)))
    arrays = (
        ("translations", Sdf.ValueTypeNames.Float3Array, Vt.Vec3fArray),
        ("rotations", Sdf.ValueTypeNames.QuatfArray, Vt.QuatfArray),
        ("scales", Sdf.ValueTypeNames.Half3Array, Vt.Vec3hArray),
    )
    codes = samples.time_codes.tolist()
    for name, kind, array in arrays:
        values, pack = getattr(samples, name), array.FromNumpy
        attribute = _attribute(prim, name, kind, Sdf.VariabilityVarying)
        if name in still:
            attribute.default = pack(values[0])
            continue
        path, set_sample = attribute.path, prim.layer.SetTimeSample
        for code, value in zip(codes, values, strict=True):
            set_sample(path, code, pack(value))


def _attribute(
    prim: Sdf.PrimSpec, name: str, kind: Sdf.ValueTypeName, variability: Sdf.Variability
) -> Sdf.AttributeSpec:
    return prim.attributes.get(name) or Sdf.AttributeSpec(prim, name, kind, variability)
