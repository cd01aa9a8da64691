"""Characters, authored from plain values: SkelRoot, Skeleton, SkelAnimation, something to see."""

from collections.abc import Sequence

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, UsdSkel, Vt

from usdmotion.arrays import Floats, Ints
from usdmotion.errors import SceneError
from usdmotion.guides import GIRTH, SegmentGuide, segment_guide
from usdmotion.kernels import forward, world_points
from usdmotion.motion import Body, Motion, Skeleton
from usdmotion.usd.layers import write_animation
from usdmotion.usd.shot import Samples
from usdmotion.usd.transforms import matrices_of

_COLOR = (0.36, 0.52, 0.70)
_NO_JOINTS = np.zeros(0, dtype=np.int64)
_NO_POINTS = np.zeros((0, 3))


def author_character(
    stage: Usd.Stage,
    path: str,
    skeleton: Skeleton,
    body: Body,
    motion: Motion,
    parts: Sequence[str] = (),
    *,
    time_codes: Floats,
    names: Sequence[str] = (),
    tip_joints: Ints = _NO_JOINTS,
    tip_points: Floats = _NO_POINTS,
    color: tuple[float, float, float] = _COLOR,
) -> str:
    """Author a character that stands in the world as its motion says, bound and visible.

    Args:
        stage: Where, in its edit target; its units are the stage's.
        path: Path of the SkelRoot; the rest of the character is put under it.
        skeleton: Its joints; the rest pose is its bind pose.
        body: What it weighs and how far it turns.
        motion: How it moves.
        parts: H-Anim name of each joint, "" for none; empty says nothing.
        time_codes: Time code of each sample of the motion.
        names: What the joints were called where they come from; empty says nothing.
        tip_joints: Joints at which a segment ends freely, shape (tip_count,).
        tip_points: Where it ends in the joint's frame [m], shape (tip_count, 3).
        color: What it looks like, linear RGB.

    Returns:
        Path of the Skeleton.

    Raises:
        SceneError: There is not one time code for each sample, or one part for each joint.
    """
    _check(skeleton, motion, parts, time_codes, path)
    unit = UsdGeom.GetStageMetersPerUnit(stage)
    root = UsdSkel.Root.Define(stage, path)
    prim = UsdSkel.Skeleton.Define(stage, f"{path}/Skeleton").GetPrim()
    animation = stage.DefinePrim(f"{path}/Animation", "SkelAnimation")
    positions, orientations = forward(
        skeleton.parents, skeleton.rest_translations[None], skeleton.rest_rotations[None]
    )
    _author_skeleton(prim, skeleton, matrices_of(positions[0] / unit, orientations[0]), unit)
    _author_names(prim, names)
    author_body(stage, f"{path}/Skeleton", body, parts)
    binding = UsdSkel.BindingAPI.Apply(prim)
    binding.CreateAnimationSourceRel().SetTargets([animation.GetPath()])
    spec = stage.GetEditTarget().GetPrimSpecForScenePath(animation.GetPath())
    with Sdf.ChangeBlock():
        write_animation(spec, skeleton.joints, _samples(motion, time_codes, unit), ("scales",))
    tips = world_points(positions[0, tip_joints], orientations[0, tip_joints], tip_points)
    guide = segment_guide(skeleton.parents, positions[0], tip_joints, tips)
    if len(guide.faces):
        _author_guide(stage, f"{path}/Guide", prim, guide, unit, color)
    root.CreateExtentAttr(_extent(skeleton, motion, tip_joints, tip_points, unit))
    return f"{path}/Skeleton"


def _check(
    skeleton: Skeleton, motion: Motion, parts: Sequence[str], time_codes: Floats, path: str
) -> None:
    counts = (
        (len(time_codes), motion.frame_count, "time codes for", "samples"),
        (motion.rotations.shape[1], len(skeleton.joints), "joints in the motion of", "joints"),
        (len(parts) or len(skeleton.joints), len(skeleton.joints), "parts for", "joints"),
    )
    for have, want, what, whose in counts:
        if have != want:
            raise SceneError(f"<{path}> is given {have} {what} {want} {whose}; give one for each")


def _author_skeleton(prim: Usd.Prim, skeleton: Skeleton, bind: Floats, unit: float) -> None:
    rest = matrices_of(skeleton.rest_translations / unit, skeleton.rest_rotations)
    schema = UsdSkel.Skeleton(prim)
    schema.CreateJointsAttr(Vt.TokenArray(list(skeleton.joints)))
    schema.CreateBindTransformsAttr(Vt.Matrix4dArray.FromNumpy(bind))
    schema.CreateRestTransformsAttr(Vt.Matrix4dArray.FromNumpy(rest))


def _author_names(prim: Usd.Prim, names: Sequence[str]) -> None:
    if names:
        UsdSkel.Skeleton(prim).CreateJointNamesAttr(Vt.TokenArray(list(names)))
        prim.SetCustomDataByKey("usdmotion:originalNames", Vt.StringArray(list(names)))


def author_body(stage: Usd.Stage, path: str, body: Body, parts: Sequence[str] = ()) -> None:
    """Author what is known of a body; what is not says nothing, and leaves what is there.

    Args:
        stage: Where, in its edit target; its units are the stage's.
        path: Path of the Skeleton.
        body: What it weighs, how far it turns, and who moves first.
        parts: H-Anim name of each joint, "" for none; empty says nothing.
    """
    prim, unit = stage.GetPrimAtPath(path), UsdGeom.GetStageMetersPerUnit(stage)
    known = {
        "parts": Vt.TokenArray(list(parts)) if any(parts) else None,
        "masses": _floats(body.masses) if body.masses.any() else None,
        "massCenters": _vectors(body.mass_centers / unit) if body.mass_centers.any() else None,
        "limitsMin": _vectors(body.limits_min) if np.isfinite(body.limits_min).any() else None,
        "limitsMax": _vectors(body.limits_max) if np.isfinite(body.limits_max).any() else None,
        "stiffness": _floats(body.stiffness) if body.stiffness.any() else None,
        "priorities": Vt.IntArray(body.priorities.tolist()) if body.priorities.any() else None,
    }
    for name, value in known.items():
        if value is not None:
            prim.AddAppliedSchema("MotionSkeletonAPI")
            prim.GetAttribute(f"usdmotion:{name}").Set(value)


def _floats(values: Floats) -> Vt.FloatArray:
    return Vt.FloatArray.FromNumpy(values.astype(np.float32))


def _vectors(values: Floats) -> Vt.Vec3fArray:
    return Vt.Vec3fArray.FromNumpy(values.astype(np.float32))


def _samples(motion: Motion, time_codes: Floats, unit: float) -> Samples:
    return Samples(
        time_codes=np.asarray(time_codes, dtype=np.float64),
        translations=(motion.translations / unit).astype(np.float32),
        rotations=motion.rotations.astype(np.float32),
        scales=np.ones(motion.translations.shape, np.float16),
    )


def _author_guide(
    stage: Usd.Stage,
    path: str,
    skeleton: Usd.Prim,
    guide: SegmentGuide,
    unit: float,
    color: tuple[float, float, float],
) -> None:
    mesh = UsdGeom.Mesh.Define(stage, path)
    points = _vectors(guide.points / unit)
    mesh.CreatePointsAttr(points)
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray([3] * len(guide.faces)))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray(guide.faces.ravel().tolist()))
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    mesh.CreateExtentAttr(UsdGeom.PointBased.ComputeExtent(points))
    mesh.CreateDisplayColorAttr([color])
    binding = UsdSkel.BindingAPI.Apply(mesh.GetPrim())
    binding.CreateSkeletonRel().SetTargets([skeleton.GetPath()])
    joints = Vt.IntArray(guide.joints.tolist())
    binding.CreateJointIndicesPrimvar(False, 1).Set(joints)
    binding.CreateJointWeightsPrimvar(False, 1).Set(Vt.FloatArray([1.0] * len(joints)))
    binding.CreateGeomBindTransformAttr(Gf.Matrix4d(1.0))


def _extent(
    skeleton: Skeleton, motion: Motion, tip_joints: Ints, tip_points: Floats, unit: float
) -> Vt.Vec3fArray:
    """Return a box around everything that the character reaches."""
    positions, orientations = forward(skeleton.parents, motion.translations, motion.rotations)
    tips = world_points(positions[:, tip_joints], orientations[:, tip_joints], tip_points)
    every = np.concatenate([positions, tips], axis=1).reshape(-1, 3)
    segments = np.linalg.norm(skeleton.rest_translations[skeleton.parents >= 0], axis=1)
    girth = GIRTH * max(
        segments.max(initial=0.0), np.linalg.norm(tip_points, axis=1).max(initial=0.0)
    )
    return _vectors(np.array([every.min(axis=0) - girth, every.max(axis=0) + girth]) / unit)
