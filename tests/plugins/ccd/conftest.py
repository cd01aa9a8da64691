"""A humanoid that is asked for something, and what the solver by groups makes of it."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from usdmotion_ccd import CyclicDescent

from usdmotion.arrays import Floats
from usdmotion.constraints import (
    CenterOfMassConstraint,
    Constraint,
    Goal,
    OrientationConstraint,
    PositionConstraint,
)
from usdmotion.kernels import conjugate, forward, multiply, to_vector
from usdmotion.measuring import measure
from usdmotion.scene import Scene
from usdmotion.solving import Problem, Solution
from usdmotion.testing import HUMANOID, humanoid_scene, posed

CHEST = "pelvis/spine/chest"
HEAD = f"{CHEST}/head"
FRAMES = 6


def arm(side: str) -> tuple[str, str, str]:
    """Return shoulder, elbow and wrist."""
    shoulder = f"{CHEST}/{side}_shoulder"
    return shoulder, f"{shoulder}/{side}_elbow", f"{shoulder}/{side}_elbow/{side}_wrist"


def leg(side: str) -> tuple[str, str, str]:
    """Return hip, knee and ankle."""
    hip = f"pelvis/{side}_hip"
    return hip, f"{hip}/{side}_knee", f"{hip}/{side}_knee/{side}_ankle"


def position(joint: str, priority: int = 1, way=(0.0, 0.0, 0.0), **fields) -> PositionConstraint:
    """Return a joint that is to be so far from where it is [m]."""
    goal = Goal(mode="offset", translation=np.array(way))
    return PositionConstraint(
        path=f"{HUMANOID}/Edit/{joint.rpartition('/')[2]}",
        skeleton=HUMANOID,
        joint=joint,
        priority=priority,
        goals=(goal,),
        **fields,
    )


def at(joint: str, places: Floats, priority: int = 1, **fields) -> PositionConstraint:
    """Return a joint that is to be at places in the world, shape (3,) or (frame_count, 3) [m]."""
    return replace(position(joint, priority, **fields), goals=(Goal(translation=places),))


def within_reach(side: str) -> Floats:
    """Return places of a wrist that its arm comes to alone, shape (frame_count, 3) [m]."""
    sign = 1.0 if side == "left" else -1.0
    shoulder, elbow, wrist = arm(side)
    scene = humanoid_scene(frame_count=FRAMES)
    turns = {shoulder: (0.3, 0.3 * sign, 0.2), elbow: (0.0, -0.7 * sign, 0.0)}
    places, _ = posed(scene, turns)
    return places[:, scene.characters[0].skeleton.joints.index(wrist)]


def orientation(joint: str, priority: int = 1, turn=None, **fields) -> OrientationConstraint:
    """Return a joint that is to be turned (xyzw), or to stay as it is turned."""
    goals = () if turn is None else (Goal(mode="offset", rotation=turn),)
    return OrientationConstraint(
        path=f"{HUMANOID}/Edit/{joint.rpartition('/')[2]}Turn",
        skeleton=HUMANOID,
        joint=joint,
        priority=priority,
        goals=goals,
        **fields,
    )


def balance(priority: int = 1, way=(0.0, 0.0, 0.0), **fields) -> CenterOfMassConstraint:
    """Return the centre of mass, that is to be so far from where it is [m]."""
    return CenterOfMassConstraint(
        path=f"{HUMANOID}/Edit/Balance",
        skeleton=HUMANOID,
        priority=priority,
        displacement=np.array(way),
        **fields,
    )


def feet(priority: int = 1) -> list[PositionConstraint]:
    """Return the ankles where they are."""
    return [position(leg(side)[2], priority) for side in ("left", "right")]


@dataclass(frozen=True, eq=False)
class Solved:
    """A problem with its solution."""

    problem: Problem
    solution: Solution
    errors: Floats
    """What is left of each constraint, shape (frame_count, constraint_count) [m or degrees]."""

    def node(self, joint: str) -> int:
        """Return the node of a joint."""
        return self.problem.cast.index[HUMANOID, joint]

    def turned(self, joint: str) -> Floats:
        """Return how far a joint is turned from the input, shape (frame_count,) [degrees]."""
        node = self.node(joint)
        before, after = self.problem.cast.rotations[:, node], self.solution.rotations[:, node]
        return np.degrees(np.linalg.norm(to_vector(multiply(conjugate(before), after)), axis=-1))

    def moved(self, *joints: str) -> bool:
        """Tell whether any of some joints is not exactly as in the input."""
        nodes = [self.node(joint) for joint in joints]
        cast, found = self.problem.cast, self.solution
        return not (
            np.array_equal(found.rotations[:, nodes], cast.rotations[:, nodes])
            and np.array_equal(found.translations[:, nodes], cast.translations[:, nodes])
        )

    def places(self, joint: str) -> Floats:
        """Return where a joint is in the world, shape (frame_count, 3) [m]."""
        cast, found = self.problem.cast, self.solution
        return forward(cast.parents, found.translations, found.rotations)[0][:, self.node(joint)]


def with_body(scene: Scene, **columns) -> Scene:
    """Return a scene whose character has other stiffness, priorities or limits at some joints."""
    (character,) = scene.characters
    changed = {}
    for name, values in columns.items():
        column = np.array(getattr(character.body, name))
        for joint, value in values.items():
            column[character.skeleton.joints.index(joint)] = value
        changed[name] = column
    return replace(scene, characters=(replace(character, body=replace(character.body, **changed)),))


def solve(*constraints: Constraint, options=None, **columns) -> Solved:
    """Return what the solver makes of some constraints."""
    scene = with_body(humanoid_scene(constraints, frame_count=FRAMES), **columns)
    problem = Problem.of(scene)
    solution = CyclicDescent(**(options or {})).solve(problem)
    return Solved(problem, solution, measure(problem, solution, scene.constraints))


@pytest.fixture(name="solve")
def solver():
    """Return what solves a humanoid's constraints."""
    return solve
