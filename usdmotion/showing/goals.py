"""Where goals are on every frame."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.constraints import Constraint
from usdmotion.kernels import multiply
from usdmotion.motion import WorldPose
from usdmotion.report.places import effector_places, left_of
from usdmotion.scene import Edit, Scene
from usdmotion.showing.effectors import named
from usdmotion.showing.shown import GoalMark
from usdmotion.tasks import RotationTask


def goal_marks(scene: Scene, edit: Edit, pose: WorldPose) -> Iterator[GoalMark]:
    """Yield where each goal of an edit wants its effector.

    Args:
        scene: The scene.
        edit: The edit.
        pose: The pose of all nodes in which joints are that carry goals.
    """
    for constraint, demand in zip(scene.constraints, scene.demands, strict=True):
        if not any(constraint is each for each in edit.constraints):
            continue
        for number, goal in enumerate(constraint.goals):
            translations, rotations = _wanted(scene, constraint, number, pose)
            yield GoalMark(
                path=goal.path,
                name=named(edit, goal.path),
                translations=translations,
                rotations=rotations,
                activity=np.clip(goal.share(scene.times), 0.0, 1.0) * demand.activity,
            )


def _wanted(
    scene: Scene, constraint: Constraint, number: int, pose: WorldPose
) -> tuple[Floats, Floats | None]:
    """Return the place and the orientation that one goal asks for, as if it were the only one on.

    What wants no place is where the effector is.
    """
    goals = [
        replace(goal, activity=float(each == number), times=())
        for each, goal in enumerate(constraint.goals)
    ]
    places, rotations = effector_places(scene, constraint, pose), None
    for task in replace(constraint, goals=tuple(goals)).tasks(scene.cast):
        if isinstance(task, RotationTask):
            rotations = _turned(task, number, pose)
        else:
            return places + left_of(task, pose), rotations
    return places, rotations


def _turned(task: RotationTask, number: int, pose: WorldPose) -> Floats:
    """Return the world orientation that a goal asks for, shape (frame_count, 4)."""
    if not task.goals:  # Nothing moves its goals, which are what it keeps.
        return task.original
    goal = task.goals[number]
    turns = np.broadcast_to(goal.rotation, task.original.shape)
    return turns if goal.node < 0 else multiply(pose[1][:, goal.node], turns)
