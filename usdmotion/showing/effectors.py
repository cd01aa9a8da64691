"""The trajectories of effectors, and what is missed of what is asked of them."""

from collections.abc import Iterator, Sequence

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.constraints import CenterOfMassConstraint, Constraint, DistanceConstraint
from usdmotion.motion import WorldPose
from usdmotion.report.findings import Trace
from usdmotion.report.places import effector_places, left_of, missing
from usdmotion.scene import Edit, Scene
from usdmotion.showing.shown import Course, Link, Miss


def courses(scene: Scene, edit: Edit, after: WorldPose | None) -> Iterator[Course]:
    """Yield the trajectory of each effector of an edit, in the order of their ranks.

    A point of a joint is one effector, however often something is asked of it. The centre of mass
    is none.

    Args:
        scene: The scene, with the input.
        edit: The edit.
        after: The result as the pose of all nodes; None where nothing is solved yet.
    """
    cast = scene.cast
    asked = {
        id(each): demand for each, demand in zip(scene.constraints, scene.demands, strict=True)
    }
    effectors: dict[tuple[str, bytes], list[Constraint]] = {}
    for each in sorted(edit.constraints, key=lambda each: each.priority):
        if each.joint and not isinstance(each, CenterOfMassConstraint):
            point = np.broadcast_to(each.point, (cast.frame_count, 3))
            effectors.setdefault((each.joint, point.tobytes()), []).append(each)
    for asking in effectors.values():
        first = asking[0]
        yield Course(
            path=first.path,
            name=named(edit, first.path),
            before=effector_places(scene, first, (cast.positions, cast.orientations)),
            after=None if after is None else effector_places(scene, first, after),
            on=np.any([asked[id(each)].activity > 0.0 for each in asking], axis=0),
        )


def links(scene: Scene, edit: Edit, after: WorldPose | None) -> Iterator[Link]:
    """Yield the points that distances are between, where these are points of joints.

    Args:
        scene: The scene, with the input.
        edit: The edit.
        after: The result as the pose of all nodes; None where nothing is solved yet.
    """
    cast = scene.cast
    for constraint, demand in zip(scene.constraints, scene.demands, strict=True):
        if constraint not in edit.constraints or not isinstance(constraint, DistanceConstraint):
            continue
        if constraint.other_joint:
            yield Link(
                path=constraint.path,
                before=_ends(scene, constraint, (cast.positions, cast.orientations)),
                after=None if after is None else _ends(scene, constraint, after),
                activity=demand.activity,
            )


def _ends(scene: Scene, constraint: DistanceConstraint, pose: WorldPose) -> Floats:
    """Return the two points of a distance in a pose of all nodes [m], (frame_count, 2, 3)."""
    own = effector_places(scene, constraint, pose)
    between = next(constraint.tasks(scene.cast))
    return np.stack([own, own + left_of(between, pose)], axis=1)


def misses(scene: Scene, traces: Sequence[Trace], after: WorldPose) -> Iterator[Miss]:
    """Yield what is missed of some constraints.

    Args:
        scene: The scene.
        traces: The constraints over time.
        after: The result as the pose of all nodes.
    """
    for trace in traces:
        missed = trace.missed
        if not missed.any():
            continue
        constraint = trace.constraint
        places = effector_places(scene, constraint, after)
        left = missing(scene, constraint, after)
        wanted = None if left is None else places + left
        yield Miss(constraint.path, trace.name, places, wanted, missed, trace.errors)


def named(edit: Edit, path: str) -> str:
    """Return a path without that of the edit it is below."""
    return path.removeprefix(f"{edit.path}/")
