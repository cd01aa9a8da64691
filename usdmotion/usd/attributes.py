"""The fields of a constraint or goal from the attributes of its prim, whatever its kind."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from pxr import Gf, Usd

from usdmotion.arrays import Floats
from usdmotion.constraints import Attribute, attributes
from usdmotion.usd.relations import floats
from usdmotion.usd.shot import Facts


def read_fields(prim: Usd.Prim, kind: type, time_codes: Floats, facts: Facts) -> dict[str, Any]:
    """Return the fields of a kind that its prim has an attribute for.

    Lengths become metres, time codes seconds from the first of `time_codes`, quaternions xyzw. What
    is animated has a value for each frame, or one value if it does not change.
    """
    fields = {}
    for each in attributes(kind):
        attribute = prim.GetAttribute(each.name)
        if attribute and attribute.HasValue():
            fields[each.field] = _read(attribute, each, time_codes, facts)
    return fields


def collapse(values: Floats) -> Floats:
    """Return the one value of an array over frames that does not change, else the array."""
    still = len(values) > 0 and bool((values == values[:1]).all())
    return values[0] if still else values


def _read(attribute: Usd.Attribute, each: Attribute, time_codes: Floats, facts: Facts) -> Any:
    if each.animated and attribute.ValueMightBeTimeVarying():
        values = [attribute.Get(Usd.TimeCode(code)) for code in time_codes]
        frames = collapse(np.array([_plain(value, each.default) for value in values]))
        return _in_our_units(frames if frames.ndim else float(frames), each, time_codes, facts)
    value = _plain(attribute.Get(Usd.TimeCode.EarliestTime()), each.default)
    return _in_our_units(value, each, time_codes, facts)


def _plain(value: Any, default: Any) -> Any:
    """Return a value of USD as one of the type of a field's default, which stands for a block."""
    if value is None:
        return default
    if isinstance(default, np.ndarray):
        if isinstance(value, (Gf.Quatf, Gf.Quatd, Gf.Quath)):
            return np.array([*value.GetImaginary(), value.GetReal()], dtype=np.float64)
        return np.array(value, dtype=np.float64)
    if isinstance(default, tuple):
        return tuple(each if isinstance(each, str) else float(each) for each in value)
    return type(default)(value)


def _in_our_units(value: Any, each: Attribute, time_codes: Floats, facts: Facts) -> Any:
    if each.unit == "length":
        return value * facts.meters_per_unit
    if each.unit == "time":
        return seconds(floats(value), time_codes, facts)
    return value


def seconds(codes: Sequence[float], time_codes: Floats, facts: Facts) -> tuple[float, ...]:
    """Return time codes as seconds from the first frame."""
    return tuple(float(code - time_codes[0]) / facts.time_codes_per_second for code in codes)
