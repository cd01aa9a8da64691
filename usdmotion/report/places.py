"""Where constraints have their effectors on every frame, and where they want them."""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.constraints import CenterOfMassConstraint, Constraint
from usdmotion.kernels import rotate, world_points
from usdmotion.motion import WorldPose
from usdmotion.report.balance import mass_center
from usdmotion.scene import Scene
from usdmotion.tasks import AimTask, DistanceTask, PointTask


def effector_places(scene: Scene, constraint: Constraint, pose: WorldPose) -> Floats:
    """Return where the effector of a constraint is in a pose of all nodes.

    Args:
        scene: The scene.
        constraint: One of its constraints.
        pose: World positions and orientations of all nodes on every frame.

    Returns:
        World [m], shape (frame_count, 3): the centre of mass of what is about that; the first joint
        of what has none.
    """
    if isinstance(constraint, CenterOfMassConstraint):
        return mass_center(scene, constraint.skeleton, pose)
    positions, orientations = pose
    if not constraint.joint:
        return np.asarray(positions[:, scene.nodes(constraint.skeleton).start])
    node = constraint.node(scene.cast)
    return world_points(positions[:, node], orientations[:, node], constraint.point)


def missing(scene: Scene, constraint: Constraint, pose: WorldPose) -> Floats | None:
    """Return the ways from where the effector of a constraint is to where it is wanted.

    Args:
        scene: The scene.
        constraint: One of its constraints.
        pose: World positions and orientations of all nodes on every frame.

    Returns:
        World [m], shape (frame_count, 3); None where it wants no place.
    """
    index = next(i for i, each in enumerate(scene.constraints) if each is constraint)
    tasks = scene.demands[index].tasks
    point = next((each for each in tasks if isinstance(each, PointTask)), None)
    return None if point is None else left_of(point, pose)


def left_of(task: PointTask | DistanceTask | AimTask, pose: WorldPose) -> Floats:
    """Return the ways from the sum of a task's terms to its target, along the axes that it holds.

    Args:
        task: The task.
        pose: World positions and orientations of all nodes on every frame.

    Returns:
        World [m], shape (frame_count, 3).
    """
    positions, orientations = pose
    left = np.array(np.broadcast_to(task.target, (len(positions), 3)))
    for term in task.terms:
        points = world_points(positions[:, term.node], orientations[:, term.node], term.point)
        left -= np.reshape(term.coefficient, (-1, 1)) * points
    return _held(task, left, orientations) if isinstance(task, PointTask) else left


def _held(task: PointTask, left: Floats, orientations: Floats) -> Floats:
    """Return the part of vectors that is along the axes which a task holds."""
    if all(task.axes.held):
        return left
    turns = np.broadcast_to(task.axes.rotation, (len(left), 4))
    total = np.zeros_like(left)
    for axis in np.eye(3)[list(task.axes.held)]:
        held = rotate(turns, np.broadcast_to(axis, left.shape))
        if task.axes.node >= 0:
            held = rotate(orientations[:, task.axes.node], held)
        total += (held * left).sum(axis=1, keepdims=True) * held
    return total
