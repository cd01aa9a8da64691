"""Shapes of a stage as regions: Plane, Cube, Sphere, Cylinder, Capsule."""

from collections.abc import Callable

import numpy as np
from pxr import Usd

from usdmotion.arrays import Floats
from usdmotion.constraints import Region
from usdmotion.errors import SceneError
from usdmotion.kernels import Shape, multiply
from usdmotion.usd.attributes import collapse
from usdmotion.usd.relations import is_a, value
from usdmotion.usd.shot import Facts
from usdmotion.usd.transforms import even, rigid, world_matrices

_HALF = np.sqrt(0.5)
_TO_AXIS = {
    "X": (0.0, _HALF, 0.0, _HALF),
    "Y": (-_HALF, 0.0, 0.0, _HALF),
    "Z": (0.0, 0.0, 0.0, 1.0),
}
"""What turns the z axis to each of the axes."""
_FRONT = {"X": [2, 1, 0], "Y": [0, 2, 1], "Z": [0, 1, 2]}
"""Where the axes of a frame with that turn are in the prim's frame, whichever way they point."""

_Size = tuple[Shape, Floats, Floats]
"""A shape along z, its extent (frame_count, 3) and margin (frame_count,), or one for all frames."""


def read_region(prim: Usd.Prim, time_codes: Floats, facts: Facts) -> Region:
    """Return the region that a shape of the stage is.

    Args:
        prim: A Plane, Cube, Sphere, Cylinder or Capsule.
        time_codes: The frames.
        facts: Units of the stage.

    Raises:
        SceneError: It is something else, or scaled to what is none of these any more.
    """
    name = f"<{prim.GetPath()}>"
    axis = str(value(prim, "axis", "Z"))
    size = next((size for kind, size in _SIZES.items() if is_a(prim, kind)), None)
    if size is None:
        raise SceneError(
            f"{name} is a {prim.GetTypeName()}, which is no region; use a Plane, Cube, Sphere, "
            "Cylinder or Capsule"
        )
    translations, rotations, scales = rigid(world_matrices(prim, time_codes), name)
    scales = scales[:, _FRONT[axis]] * facts.meters_per_unit
    shape, extent, margin = size(prim, scales, time_codes)
    return Region(
        path=str(prim.GetPath()),
        shape=shape,
        extent=collapse(extent),
        margin=collapse(margin),
        translation=collapse(translations * facts.meters_per_unit),
        rotation=collapse(multiply(rotations, np.array(_TO_AXIS[axis]))),
    )


def _plane(prim: Usd.Prim, scales: Floats, time_codes: Floats) -> _Size:
    return Shape.HALF_SPACE, np.zeros((1, 3)), np.zeros(1)


def _cube(prim: Usd.Prim, scales: Floats, time_codes: Floats) -> _Size:
    half = 0.5 * _number(prim, "size", time_codes)
    return Shape.BOX, half[:, None] * scales, np.zeros(1)


def _sphere(prim: Usd.Prim, scales: Floats, time_codes: Floats) -> _Size:
    radius = _number(prim, "radius", time_codes) * _evenly(prim, scales)
    return Shape.BOX, np.zeros((1, 3)), radius


def _capsule(prim: Usd.Prim, scales: Floats, time_codes: Floats) -> _Size:
    scale = _evenly(prim, scales)
    half = 0.5 * _number(prim, "height", time_codes) * scale
    extent = half[:, None] * (0.0, 0.0, 1.0)
    return Shape.BOX, extent, _number(prim, "radius", time_codes) * scale


def _cylinder(prim: Usd.Prim, scales: Floats, time_codes: Floats) -> _Size:
    if not even(scales[:, :2]):
        raise SceneError(f"<{prim.GetPath()}> is scaled unevenly across; make that scale even")
    radius = _number(prim, "radius", time_codes) * scales[:, 0]
    half = 0.5 * _number(prim, "height", time_codes) * scales[:, 2]
    return Shape.CYLINDER, np.stack(np.broadcast_arrays(radius, radius, half), axis=1), np.zeros(1)


_SIZES: dict[str, Callable[[Usd.Prim, Floats, Floats], _Size]] = {
    "UsdGeomPlane": _plane,
    "UsdGeomCube": _cube,
    "UsdGeomSphere": _sphere,
    "UsdGeomCylinder": _cylinder,
    "UsdGeomCapsule": _capsule,
}


def _number(prim: Usd.Prim, name: str, time_codes: Floats) -> Floats:
    """Return a size over the frames, or once where it does not change; it is never negative."""
    attribute = prim.GetAttribute(name)
    codes = time_codes if attribute.ValueMightBeTimeVarying() else time_codes[:1]
    values = [attribute.Get(Usd.TimeCode(code)) for code in codes]
    sizes = np.array([0.0 if each is None else each for each in values], dtype=np.float64)
    if not (np.isfinite(sizes) & (sizes >= 0.0)).all():
        raise SceneError(f"<{prim.GetPath()}> has a {name} below 0; make it a length")
    return sizes


def _evenly(prim: Usd.Prim, scales: Floats) -> Floats:
    if not even(scales):
        raise SceneError(
            f"<{prim.GetPath()}> is scaled unevenly and is no {prim.GetTypeName()} any more; make "
            "that scale even"
        )
    return np.asarray(scales[:, 0])
