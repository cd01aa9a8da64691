"""Cameras of a stage, as eyes."""

import numpy as np
from pxr import Gf, Usd, UsdGeom

from usdmotion.arrays import Floats
from usdmotion.drawing.eyes import Camera, Eye, Perspective, Window
from usdmotion.errors import SceneError
from usdmotion.usd.relations import is_a
from usdmotion.usd.shot import Facts

_NEAREST = 1e-4
"""What is nearer to an eye than this is not seen, however near the camera clips [m]."""


def find_camera(stage: Usd.Stage, path: str) -> Usd.Prim:
    """Return the camera at a path.

    Raises:
        SceneError: There is nothing, or no camera; the sentence names those that there are.
    """
    prim = stage.GetPrimAtPath(path) if path.startswith("/") else None
    if is_a(prim, "UsdGeomCamera") if prim else False:
        return prim
    everything = Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies())
    known = [f"<{each.GetPath()}>" for each in everything if is_a(each, "UsdGeomCamera")]
    what = "is no Camera" if prim else "is not on the stage"
    there = f"there are {', '.join(known)}" if known else "there is none, so name a --view instead"
    raise SceneError(f"<{path}> {what}; {there}")


def see_through(camera: Usd.Prim, time_code: float, facts: Facts) -> Eye:
    """Return a camera as an eye that shows what it frames.

    Args:
        camera: A Camera prim.
        time_code: When.
        facts: Units of the stage.

    Raises:
        SceneError: No camera can be so.
    """
    found = UsdGeom.Camera(camera).GetCamera(Usd.TimeCode(time_code))
    _require_possible(camera, found, time_code)
    frustum, unit = found.frustum, facts.meters_per_unit
    place = np.array(frustum.GetPosition()) * unit
    axes = (Gf.Vec3d(1, 0, 0), Gf.Vec3d(0, 1, 0), Gf.Vec3d(0, 0, 1))
    right, up, towards = (np.array(frustum.GetRotation().TransformDir(each)) for each in axes)
    sides = np.array((*frustum.GetWindow().GetMin(), *frustum.GetWindow().GetMax()))
    nearest = max(float(frustum.GetNearFar().GetMin()) * unit, _NEAREST)
    if found.projection == Gf.Camera.Perspective:
        return Perspective(place, right, up, towards, 1.0, _window(sides), nearest)
    # What is seen without perspective is where it is in the world, and the frame goes along.
    middle = np.array((place @ right, place @ up))
    window = _window(sides * unit + np.tile(middle, 2))
    return Camera(right, up, towards, window, float(place @ towards) - nearest)


def _require_possible(prim: Usd.Prim, camera: Gf.Camera, time_code: float) -> None:
    """Raise if nothing could be seen through a camera, whatever there is."""
    lengths = {
        "horizontalAperture": camera.horizontalAperture,
        "verticalAperture": camera.verticalAperture,
    }
    if camera.projection == Gf.Camera.Perspective:
        lengths["focalLength"] = camera.focalLength
    for name, length in lengths.items():
        if not 0.0 < length < np.inf:
            raise SceneError(
                f"<{prim.GetPath()}>.{name} is {length:g} at {time_code:g}, and nothing is seen "
                "through such a camera; give it a length above 0"
            )
    if not abs(camera.transform.GetDeterminant()) > 0.0:
        raise SceneError(
            f"<{prim.GetPath()}> is scaled to nothing at {time_code:g}, or its transform is no "
            "number; mend its xformOps"
        )


def _window(sides: Floats) -> Window:
    left, bottom, right, top = (float(each) for each in sides)
    return left, bottom, right, top
