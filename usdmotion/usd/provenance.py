"""Where a result comes from: the version that made it, and a hash of what was read."""

import dataclasses
import hashlib
import struct
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np
from pxr import Sdf, Vt

from usdmotion.arrays import Floats
from usdmotion.usd.clips import SLACK
from usdmotion.usd.shot import Result, Samples, Shot, Take

KEY = "usdmotion"
"""Key of a layer's own data under which it says how it was made."""
_EARLIER = "earlier"
"""Key under which a layer keeps what it says of results that were made before the last ones."""
_RECORD = ("version", "solver", "options", "hashes", "frames", "cleaning", "ground", "notes")
"""What a layer says of results that were made together."""
_NOT_READ = ("holder", "bound", "folder")
"""Fields of a take that only say where the result goes, or where the files lie."""
_FACTS = ("meters_per_unit", "up_axis", "time_codes_per_second", "frames_per_second")
"""What a stage says of itself that a result depends on."""
_SECONDS = "times"
"""Name of fields with seconds from the first frame, beside those that declare their unit."""
_CODE_DIGITS, _SECOND_DIGITS = 6, 9
"""Decimals of times that are told apart: offsets of layers round them."""


@cache
def own_version() -> str:
    """Return the version of usdmotion."""
    try:
        return version("usdmotion")
    except PackageNotFoundError:  # run from a folder that nobody installed
        return "unknown"


def input_hash(shot: Shot, take: Take, first: float | None = None) -> str:
    """Return a hash of everything that an edit's result depends on, but for its solver.

    Time codes count from where the result starts, so that it stays the same where all of it is
    shown later or earlier.

    Args:
        shot: What was read.
        take: How the motion of the edit is stored.
        first: Time code of the first sample of the result; None is where it would be written.
    """
    if first is None:
        first = _first(take)
    scene = shot.scene(take.edit)
    scene = dataclasses.replace(scene, time_codes=_since(first, scene.time_codes))
    counted: dict[str, object] = {
        "own": _samples_since(first, take.own),
        "solved": _samples_since(first, take.solved),
        "extras": _extras_since(first, take.extras),
    }
    read = [field.name for field in dataclasses.fields(take) if field.name not in _NOT_READ]
    facts = [getattr(shot.facts, name) for name in _FACTS]
    return hash_of(facts, scene, [counted.get(name, getattr(take, name)) for name in read])


def hash_of(*values: object) -> str:
    """Return a hash of some plain values, arrays among them."""
    digest = hashlib.sha256()
    for value in values:
        _feed(digest, value)
    return digest.hexdigest()


def provenance(
    shot: Shot, results: Sequence[Result], hashes: Mapping[str, str], notes: Sequence[str]
) -> dict[str, object]:
    """Return what the layer says of itself.

    It is version, solver, options and hashes of what was read; the frames, the cleaning of
    the input and its ground, where others were asked for than the edits say; and the notes, where
    there are any.
    """
    told: dict[str, object] = {
        "version": own_version(),
        "solver": ", ".join(sorted({result.solver for result in results})),
        "options": {result.edit: dict(result.options) for result in results},
        "hashes": dict(hashes),
    }
    if shot.frames is not None:
        told["frames"] = Vt.DoubleArray(shot.frames)
    if shot.cleaning is not None:
        told["cleaning"] = shot.cleaning
    if shot.ground is not None:
        told["ground"] = Vt.StringArray(list(shot.ground))
    if notes:
        told["notes"] = Vt.StringArray(list(notes))
    return told


def recorded(layer: Sdf.Layer) -> Mapping[str, Any]:
    """Return what a layer says of itself, as `provenance` has it; nothing where it does not."""
    said = layer.customLayerData.get(KEY, {})
    return said if isinstance(said, Mapping) else {}


def records(said: Mapping[str, Any]) -> tuple[Mapping[str, Any], ...]:
    """Return what a layer says of all its results: those that were made together are in one."""
    return (said, *said.get(_EARLIER, {}).values())


def joined(before: Mapping[str, Any], said: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a layer says of itself when something has been put beside what was there.

    Args:
        before: What it said.
        said: What is told of what was put: of results, as `provenance` has it, or else.
    """
    if "hashes" not in said:
        return {"version": own_version(), **before} | {
            key: _over(value, before.get(key)) for key, value in said.items()
        }
    made = {key: value for key, value in before.items() if key in _RECORD}
    new = {edit for each in records(said) for edit in each["hashes"]}
    kept = [_without(each, new) for each in (made, *records(before)[1:])]
    earlier = {next(iter(each["hashes"])): each for each in kept if each["hashes"]}
    others = {key: value for key, value in before.items() if key not in (*_RECORD, _EARLIER)}
    told = others | {key: _over(value, others.get(key)) for key, value in said.items()}
    earlier |= said.get(_EARLIER, {})
    return told | ({_EARLIER: earlier} if earlier else {})


def _over(value: Any, before: Any) -> Any:
    if isinstance(value, Mapping) and isinstance(before, Mapping):
        return {**before, **{key: _over(held, before.get(key)) for key, held in value.items()}}
    return value


def _without(record: Mapping[str, Any], edits: Iterable[str]) -> dict[str, Any]:
    """Return what is said of results without those of some edits."""
    left = dict(record)
    for key in ("hashes", "options"):
        left[key] = {edit: each for edit, each in record.get(key, {}).items() if edit not in edits}
    return left


def _first(take: Take) -> float:
    """Return the time code of the first sample of a result: the source's own, if it has one."""
    own, solved = take.own.time_codes, take.solved.time_codes
    return float(own[0] if len(own) and own[0] < solved[0] - SLACK else solved[0])


def _since(first: float, codes: Floats) -> Floats:
    # Adding nothing makes -0 the same as 0.
    return np.asarray(np.round(codes - first, _CODE_DIGITS) + 0.0)


def _samples_since(first: float, samples: Samples) -> Samples:
    return dataclasses.replace(samples, time_codes=_since(first, samples.time_codes))


def _extras_since(first: float, extras: str) -> str:
    """Return the text of a layer whose time samples count from a time code."""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(extras)
    paths: list[Sdf.Path] = []
    layer.Traverse(Sdf.Path.absoluteRootPath, paths.append)
    for path in paths:
        codes = layer.ListTimeSamplesForPath(path)
        values = [layer.QueryTimeSample(path, code) for code in codes]
        for code in codes:
            layer.EraseTimeSample(path, code)
        for code, value in zip(_since(first, np.array(codes)), values, strict=True):
            layer.SetTimeSample(path, float(code), value)
    return str(layer.ExportToString())


def _feed(digest: Any, value: Any) -> None:
    """Add a value to a digest so that values that differ never add the same bytes."""
    if isinstance(value, np.ndarray):
        digest.update(f"array {value.dtype.str} {value.shape};".encode())
        digest.update(np.ascontiguousarray(value).data)
    elif dataclasses.is_dataclass(value):
        digest.update(f"{type(value).__name__};".encode())
        _feed(digest, {each.name: _held(value, each) for each in dataclasses.fields(value)})
    elif isinstance(value, Mapping):
        digest.update(f"mapping {len(value)};".encode())
        for key in sorted(value, key=str):
            _feed(digest, str(key))
            _feed(digest, value[key])
    elif isinstance(value, (tuple, list)):
        digest.update(f"sequence {len(value)};".encode())
        for each in value:
            _feed(digest, each)
    elif isinstance(value, float):
        digest.update(b"float" + struct.pack("<d", value))
    else:
        text = f"{type(value).__name__} {value}".encode()
        digest.update(f"{len(text)};".encode() + text)


def _held(value: object, field: dataclasses.Field[Any]) -> object:
    """Return what a field of a value holds, seconds to the digits that count."""
    held = getattr(value, field.name)
    unit = field.metadata.get("attribute", {}).get("unit", "")
    if field.name == _SECONDS or unit == "time":
        return np.round(held, _SECOND_DIGITS) + 0.0
    return held
