"""A layer in other time codes: what it says at one time it says at another."""

from collections.abc import Mapping
from typing import Any

from pxr import Gf, Sdf, Ts, Usd

from usdmotion.usd.attribute_authoring import time_code_array

_TIME_CODE = getattr(Gf, "TimeCode", Sdf.TimeCode)  # Sdf's until 26
_TIME_CODES = type(time_code_array(()))


def retime(layer: Sdf.Layer, offset: Sdf.LayerOffset) -> None:
    """Take everything that a layer says of time to other time codes.

    These are time samples, splines, and values that are time codes, in custom data too.

    Args:
        layer: The layer; no layer under it is looked at.
        offset: What takes its time codes to the others.
    """
    if offset.IsIdentity():
        return
    paths: list[Sdf.Path] = []
    layer.Traverse(Sdf.Path.absoluteRootPath, paths.append)
    for path in paths:
        if attribute := layer.GetAttributeAtPath(path):
            _retime_attribute(attribute, offset)
        elif (prim := layer.GetPrimAtPath(path)) and prim.HasInfo("customData"):
            prim.SetInfo("customData", _retimed(prim.GetInfo("customData"), offset))


def _retime_attribute(attribute: Sdf.AttributeSpec, offset: Sdf.LayerOffset) -> None:
    if attribute.HasInfo("default"):
        attribute.default = _retimed(attribute.default, offset)
    if attribute.HasInfo("spline"):
        _set_spline(attribute, _retimed_spline(attribute.GetInfo("spline"), offset))
    if not attribute.HasInfo("timeSamples"):
        return
    layer, path = attribute.layer, attribute.path
    codes = layer.ListTimeSamplesForPath(path)
    samples = [(offset * code, layer.QueryTimeSample(path, code)) for code in codes]
    attribute.ClearInfo("timeSamples")
    for code, value in samples:
        layer.SetTimeSample(path, code, _retimed(value, offset))


def _retimed(value: Any, offset: Sdf.LayerOffset) -> Any:
    if isinstance(value, Mapping):
        return {key: _retimed(held, offset) for key, held in value.items()}
    if isinstance(value, _TIME_CODE):
        return _TIME_CODE(offset * float(value))
    if isinstance(value, _TIME_CODES):
        return time_code_array(offset * float(code) for code in value)
    return value


def _set_spline(attribute: Sdf.AttributeSpec, spline: Ts.Spline) -> None:
    # Before 26 Python sets splines on stages only.
    layer, path = attribute.layer, attribute.path
    aside = Usd.Stage.CreateInMemory()
    Sdf.CreatePrimInLayer(aside.GetRootLayer(), path.GetPrimPath())
    Sdf.CopySpec(layer, path, aside.GetRootLayer(), path)
    aside.GetAttributeAtPath(path).SetSpline(spline)
    Sdf.CopySpec(aside.GetRootLayer(), path, layer, path)


def _retimed_spline(spline: Ts.Spline, offset: Sdf.LayerOffset) -> Ts.Spline:
    """Return a spline of values that are no times in other time codes."""
    found = Ts.Spline(spline.GetValueTypeName())
    found.SetCurveType(spline.GetCurveType())
    found.SetPreExtrapolation(_slowed(spline.GetPreExtrapolation(), offset.scale))
    found.SetPostExtrapolation(_slowed(spline.GetPostExtrapolation(), offset.scale))
    # USD warns of whoever asks for inner loops, so only where there can be some.
    loops_outside = spline.HasExtrapolatingLoops()
    if spline.HasLoops() and (not loops_outside or spline.HasInnerLoops()):
        loops = spline.GetInnerLoopParams()
        loops.protoStart, loops.protoEnd = offset * loops.protoStart, offset * loops.protoEnd
        found.SetInnerLoopParams(loops)
    for knot in spline.GetKnots().values():
        moved = Ts.Knot(knot)
        moved.SetTime(offset * knot.GetTime())
        moved.SetPreTanWidth(knot.GetPreTanWidth() * offset.scale)
        moved.SetPostTanWidth(knot.GetPostTanWidth() * offset.scale)
        moved.SetPreTanSlope(knot.GetPreTanSlope() / offset.scale)
        moved.SetPostTanSlope(knot.GetPostTanSlope() / offset.scale)
        found.SetKnot(moved)
    return found


def _slowed(extrapolation: Ts.Extrapolation, scale: float) -> Ts.Extrapolation:
    found = Ts.Extrapolation(extrapolation.mode)
    if extrapolation.mode == Ts.ExtrapSloped:
        found.slope = extrapolation.slope / scale
    return found
