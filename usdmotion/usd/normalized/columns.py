"""How each field of a normalized motion is held by attributes of a prim, one row a field."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from pxr import Gf, Sdf, Vt

from usdmotion.arrays import Floats

_TYPES = Sdf.ValueTypeNames


@dataclass(frozen=True)
class Column:
    """A field that has a value on every frame."""

    field: str
    """Name of the field of `NormalizedMotion`."""
    name: str
    """Name of the attribute."""
    kind: Sdf.ValueTypeName
    width: int
    """Numbers for each of the things that `of` lists."""
    pack: Callable[[Floats], Any]
    """One frame's value as USD holds it."""
    of: str = ""
    """The field that lists what there is a value of; "" is one value, and "*" as many as are."""
    unit: float = 1.0
    """What one of the field's is in the attribute."""

    def unpack(self, value: Any) -> Floats:
        """Return one frame's value as a flat array."""
        if isinstance(value, Gf.Quatf):
            return np.array([*value.GetImaginary(), value.GetReal()], dtype=np.float64)
        return np.asarray(value, dtype=np.float64).ravel() / self.unit


NAMES = {
    "limbs": "usdmotion:limbs",
    "segments": "usdmotion:segments",
    "carriers": "usdmotion:carriers",
    "extra_joints": "usdmotion:extraJoints",
    "offset_joints": "usdmotion:offsetJoints",
}
"""The fields that list what there is a value of, and their attributes."""


def _quaternions(values: Floats) -> Any:
    return Vt.QuatfArray.FromNumpy(values.astype(np.float32).reshape(-1, 4))


def _vectors(values: Floats) -> Any:
    return Vt.Vec3fArray.FromNumpy(values.astype(np.float32).reshape(-1, 3))


def _numbers(values: Floats) -> Any:
    return Vt.DoubleArray.FromNumpy(np.array(values, dtype=np.float64).ravel())


def _vector(values: Floats) -> Any:
    return Gf.Vec3f(*(float(each) for each in values))


def _quaternion(values: Floats) -> Any:
    return Gf.Quatf(float(values[3]), *(float(each) for each in values[:3]))


def _column(field: str, kind: str, width: int, pack: Callable[..., Any], of: str = "") -> Column:
    first, *rest = field.split("_")
    name = "usdmotion:" + first + "".join(word.capitalize() for word in rest)
    unit = float(np.degrees(1.0)) if field == "limb_twists" else 1.0
    return Column(field, name, getattr(_TYPES, kind), width, pack, of, unit)


COLUMNS = (
    _column("limb_frames", "QuatfArray", 4, _quaternions, "limbs"),
    _column("limb_lengths", "DoubleArray", 1, _numbers, "limbs"),
    _column("limb_twists", "DoubleArray", 2, _numbers, "limbs"),
    _column("segment_rotations", "QuatfArray", 4, _quaternions, "segments"),
    _column("spine", "Point3fArray", 3, _vectors, "*"),
    _column("root_position", "Point3f", 3, _vector),
    _column("root_heading", "Quatf", 4, _quaternion),
    _column("root_orientation", "Quatf", 4, _quaternion),
    _column("carrier_shares", "DoubleArray", 1, _numbers, "carriers"),
    _column("extra_rotations", "QuatfArray", 4, _quaternions, "extra_joints"),
    _column("offsets", "Vector3fArray", 3, _vectors, "offset_joints"),
)
"""Every field that has a value on every frame."""
