"""Normalized motions as prims: written sample by sample, read from however they compose."""

from dataclasses import replace
from typing import Any

import numpy as np
from pxr import Sdf, Usd, Vt

from usdmotion.arrays import Floats
from usdmotion.errors import SceneError
from usdmotion.kernels import conjugate, multiply, rotate
from usdmotion.s4d import NormalizedMotion
from usdmotion.usd.clips import merged
from usdmotion.usd.layers import over, relate, set_value, set_varying
from usdmotion.usd.normalized.axes import from_y_up, to_y_up
from usdmotion.usd.normalized.columns import COLUMNS, NAMES, Column
from usdmotion.usd.relations import value
from usdmotion.usd.shot import Facts
from usdmotion.usd.stages import read_facts

_UNIT = 1e-3
"""How far the length of a quaternion may be from one before it is no rotation any more."""


def author_normalized(
    stage: Usd.Stage, path: str, motion: NormalizedMotion, *, time_codes: Floats, source: str = ""
) -> None:
    """Author a normalized motion.

    Args:
        stage: Where, in its edit target; root and heading go along its up axis.
        path: Path of the prim.
        motion: What to author.
        time_codes: Time code of each frame.
        source: Path of the SkelAnimation that it is of; "" says nothing.

    Raises:
        SceneError: There is not one time code for each frame.
    """
    if len(time_codes) != len(motion.times):
        raise SceneError(
            f"<{path}> is given {len(time_codes)} time codes for {len(motion.times)} frames; give "
            "one for each"
        )
    turned = _turned(motion, from_y_up(read_facts(stage)))
    stage.DefinePrim(path, "MotionNormalized")
    layer = stage.GetEditTarget().GetLayer()
    with Sdf.ChangeBlock():
        prim = over(layer, path)
        if source:
            relate(prim, "usdmotion:source", source)
        for field, name in NAMES.items():
            tokens = Vt.TokenArray(list(getattr(turned, field)))
            set_value(prim, name, Sdf.ValueTypeNames.TokenArray, tokens)
        for column in COLUMNS:
            values = getattr(turned, column.field) * column.unit
            if values[:1].size:
                samples = zip(time_codes.tolist(), map(column.pack, values), strict=True)
                set_varying(prim, column.name, column.kind, dict(samples))


def read_normalized(
    prim: Usd.Prim, facts: Facts, time_codes: Floats | None = None
) -> tuple[NormalizedMotion, Floats]:
    """Return a normalized motion, and the time code of each frame.

    Args:
        prim: The MotionNormalized.
        facts: Axis and rates of its stage.
        time_codes: When; None is at its own samples.

    Raises:
        SceneError: An array has not one value for each thing that it is about.
    """
    queries = {each.field: Usd.AttributeQuery(prim.GetAttribute(each.name)) for each in COLUMNS}
    codes = _codes(prim, facts) if time_codes is None else time_codes
    names = {field: tuple(map(str, value(prim, name, ()))) for field, name in NAMES.items()}
    arrays = {
        each.field: _frames(prim, each, queries[each.field], codes, len(names.get(each.of, ())))
        for each in COLUMNS
    }
    times = (codes - codes[0]) / facts.time_codes_per_second
    fields: dict[str, Any] = {"times": times, **names, **arrays}
    motion = NormalizedMotion(**fields)
    return _turned(motion, to_y_up(facts)), codes


def _codes(prim: Usd.Prim, facts: Facts) -> Floats:
    attributes = [prim.GetAttribute(each.name) for each in COLUMNS]
    codes = merged([Usd.Attribute.GetUnionedTimeSamples(attributes)])
    return codes if len(codes) else np.array([facts.start or 0.0])


def _frames(
    prim: Usd.Prim, column: Column, query: Usd.AttributeQuery, codes: Floats, count: int
) -> Floats:
    """Return what an attribute holds on every frame, its things in the second axis."""
    values = [column.unpack(query.Get(code)) for code in codes.tolist() if query.HasValue()]
    if column.of == "*":
        count = len(values[0]) // column.width if values else 0
    size = (count if column.of else 1) * column.width
    if not values and not size:
        return np.zeros((len(codes), 0))
    wrong = next((each for each in values or [np.zeros(0)] if len(each) != size), None)
    if wrong is not None:
        raise SceneError(
            f"<{prim.GetPath()}> has {len(wrong) // column.width} values in {column.name} for "
            f"{count if column.of else 1} of them; normalize the motion again"
        )
    frames = np.array(values)
    if not np.isfinite(frames).all():
        raise SceneError(
            f"<{prim.GetPath()}> has something in {column.name} that is not a number; normalize "
            "the motion again"
        )
    shaped = frames.reshape(len(codes), -1, column.width) if column.of else frames
    if column.width == 4:
        return _rotations(prim, column, shaped)
    return shaped[..., 0] if column.width == 1 else shaped


def _rotations(prim: Usd.Prim, column: Column, values: Floats) -> Floats:
    lengths = np.linalg.norm(values, axis=-1, keepdims=True)
    if (np.abs(lengths - 1.0) > _UNIT).any():
        raise SceneError(
            f"<{prim.GetPath()}> has a quaternion in {column.name} that is not of length one; "
            "normalize it"
        )
    return np.asarray(values / lengths)


def _turned(motion: NormalizedMotion, turn: Floats) -> NormalizedMotion:
    """Return a motion whose world is turned; what is seen from its own body stays as it is."""
    heading = multiply(multiply(turn, motion.root_heading), conjugate(turn))
    return replace(motion, root_position=rotate(turn, motion.root_position), root_heading=heading)
