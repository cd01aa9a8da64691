"""The attributes of a prim from the fields of a constraint or goal, whatever its kind."""

from collections.abc import Iterable
from typing import Any

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom

from usdmotion.arrays import Floats
from usdmotion.constraints import Attribute, attributes
from usdmotion.errors import SceneError
from usdmotion.usd.shot import Facts


def define(stage: Usd.Stage, path: str, schema: str) -> Usd.Prim:
    """Return a prim of a schema class, made where it is not there, that nobody renders.

    Raises:
        SceneError: The path is not one that a prim can have.
    """
    fine = Sdf.Path.IsValidPathString(path)[0] and path.startswith("/")
    if not fine or not Sdf.Path(path).IsPrimPath():
        raise SceneError(f"'{path}' is no path of a prim; write one like /World/Edit/Wrist")
    prim = stage.DefinePrim(path, schema)
    UsdGeom.Imageable(prim).CreatePurposeAttr(UsdGeom.Tokens.guide)
    return prim


def author_fields(prim: Usd.Prim, held: object, time_codes: Floats, facts: Facts) -> None:
    """Give a prim the attributes of the fields that are not at their defaults.

    Args:
        prim: The prim, of the schema class of `held`.
        held: A constraint or a goal, in metres and seconds.
        time_codes: Time code of each frame; the first is where seconds start.
        facts: Units and rates of the stage.

    Raises:
        SceneError: A field has a value for each of some frames, and not of these.
    """
    for each in attributes(type(held)):
        value = getattr(held, each.field)
        if np.array_equal(value, each.default):
            continue
        attribute = prim.GetAttribute(each.name)
        if not attribute:
            raise SceneError(
                f"<{prim.GetPath()}> cannot have {each.name}, as USD does not know the schema "
                f"{prim.GetTypeName()}; register it before a stage is opened"
            )
        _author(attribute, each, value, time_codes, facts)


def time_code_array(codes: Iterable[float]) -> Any:
    """Return time codes as USD holds an array of them."""
    return Sdf.TimeCodeArray([Sdf.TimeCode(float(code)) for code in codes])


def set_frames(
    attribute: Usd.Attribute, values: np.ndarray, time_codes: Floats, convert: Any
) -> None:
    """Give an attribute one value for each frame.

    Raises:
        SceneError: There are not as many values as frames.
    """
    if len(values) != len(time_codes):
        raise SceneError(
            f"<{attribute.GetPath()}> is given {len(values)} values for {len(time_codes)} time "
            "codes; give the time code of each frame"
        )
    for code, value in zip(time_codes.tolist(), values, strict=True):
        attribute.Set(convert(value), Usd.TimeCode(code))


def _author(
    attribute: Usd.Attribute, each: Attribute, value: Any, time_codes: Floats, facts: Facts
) -> None:
    if each.unit == "length":
        value = np.asarray(value) / facts.meters_per_unit
    elif each.unit == "time":
        value = [time_codes[0] + time * facts.time_codes_per_second for time in value]
    convert = _converter(attribute.GetTypeName())
    if np.ndim(value) > np.ndim(each.default):
        set_frames(attribute, np.asarray(value), time_codes, convert)
    else:
        attribute.Set(convert(value))


def _converter(kind: Sdf.ValueTypeName) -> Any:
    """Return what makes a value of a type of USD."""
    if kind == Sdf.ValueTypeNames.TimeCodeArray:
        return time_code_array
    python = kind.type.pythonClass
    if python in (Gf.Quatf, Gf.Quatd, Gf.Quath):
        return lambda q: python(float(q[3]), *(float(each) for each in q[:3]))
    if kind.isArray:
        element = _converter(kind.scalarType)
        return lambda values: python([element(value) for value in values])
    if python is not None and python.__module__.startswith("pxr.Gf"):
        return lambda vector: python(*(float(each) for each in vector))
    plain = {"int": int, "bool": bool, "double": float, "float": float}
    return plain.get(str(kind), str)
