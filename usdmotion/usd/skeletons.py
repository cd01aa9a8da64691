"""A Skeleton prim as plain values: joints, rest pose, body."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdSkel

from usdmotion.arrays import Floats, Ints
from usdmotion.errors import SceneError
from usdmotion.motion import Body
from usdmotion.usd.relations import joints_of, value
from usdmotion.usd.shot import Rest
from usdmotion.usd.transforms import rigid


@dataclass(frozen=True, eq=False)
class Joints:
    """The joints of a Skeleton prim."""

    path: str
    """Path of the Skeleton."""
    tokens: tuple[str, ...]
    parents: Ints
    rest: Rest | None
    """In the skeleton's units; None where the prim has none that can be used."""
    rest_fault: str
    """What would give it a rest pose; "" where it has one."""


def read_joints(prim: Usd.Prim) -> Joints:
    """Return the joints of a Skeleton."""
    tokens = joints_of(prim)
    parents = np.array(UsdSkel.Topology(list(tokens)).GetParentIndices(), dtype=np.int64)
    matrices = np.asarray(value(prim, "restTransforms", ()), dtype=np.float64).reshape(-1, 4, 4)
    rest, fault = None, f"<{prim.GetPath()}> has no restTransforms; author them"
    if len(matrices) == len(tokens):
        try:
            rest, fault = Rest(*rigid(matrices, "")), ""
        except SceneError:
            fault = _rest_fault(prim, tokens, matrices)
    return Joints(str(prim.GetPath()), tokens, parents, rest, fault)


def _rest_fault(prim: Usd.Prim, tokens: tuple[str, ...], matrices: Floats) -> str:
    for token, matrix in zip(tokens, matrices, strict=True):
        try:
            rigid(matrix[None], f"<{prim.GetPath()}>: the rest of the joint '{token}'")
        except SceneError as error:
            return str(error)
    raise AssertionError("one of the joints has a rest pose that is not rigid")


def read_body(prim: Usd.Prim, joints: Joints, units: Floats) -> Body:
    """Return what a Skeleton says of its body.

    Args:
        prim: The Skeleton.
        joints: Its joints.
        units: Metres per unit in the frame of each joint, shape (joint_count, 3).

    Raises:
        SceneError: It has limits but no rest pose to measure them from.
    """
    unknown = Body.unknown(len(joints.tokens))
    limits = [_authored(prim, name) for name in ("limitsMin", "limitsMax")]
    if joints.rest is None and any(limit is not None for limit in limits):
        raise SceneError(f"{joints.rest_fault}, because joint limits are measured from them")

    def either(name: str, default: NDArray[Any]) -> NDArray[Any]:
        found = _authored(prim, name)
        return default if found is None else found

    return Body(
        masses=either("masses", unknown.masses),
        mass_centers=either("massCenters", unknown.mass_centers) * units,
        limits_min=either("limitsMin", unknown.limits_min),
        limits_max=either("limitsMax", unknown.limits_max),
        stiffness=either("stiffness", unknown.stiffness),
        priorities=either("priorities", unknown.priorities).astype(np.int64),
    )


def _authored(prim: Usd.Prim, name: str) -> Floats | None:
    found: Any = value(prim, f"usdmotion:{name}", ())
    return np.asarray(found, dtype=np.float64) if len(found) else None
