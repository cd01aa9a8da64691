"""A humanoid that is asked for something, before and after."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from usdmotion.arrays import Floats
from usdmotion.cast import Cast
from usdmotion.constraints import Constraint, Goal, OrientationConstraint, PositionConstraint
from usdmotion.kernels import from_vector, world_points
from usdmotion.measuring import measure
from usdmotion.plugins import host
from usdmotion.solving import Problem, Solution
from usdmotion.testing import humanoid_scene
from usdmotion.testing.scenes import HUMANOID


@dataclass(frozen=True, eq=False)
class Solved:
    """A cast before and after, and what is left of each constraint."""

    before: Cast
    after: Cast
    errors: Floats
    solution: Solution


class Humanoid:
    """The small humanoid of the testing scenes, by the last parts of its joints' names."""

    path = HUMANOID

    def __init__(self) -> None:
        self.cast = humanoid_scene().cast

    def token(self, name: str) -> str:
        return next(
            token for _, token in self.cast.joints if token and token.split("/")[-1] == name
        )

    def node(self, name: str) -> int:
        return self.cast.index[(HUMANOID, self.token(name))]

    def point(self, cast: Cast, name: str, point: Floats | None = None) -> Floats:
        """Return where a point of a joint is [m], shape (frame_count, 3)."""
        node = self.node(name)
        offset = np.zeros(3) if point is None else point
        return world_points(cast.positions[:, node], cast.orientations[:, node], offset)

    def chain(self, name: str) -> tuple[str, ...]:
        """Return the joint and those above it, up to the pelvis."""
        parts = self.token(name).split("/")
        return tuple("/".join(parts[:count]) for count in range(len(parts), 0, -1))

    def lift(self, name: str, height: float, **fields: object) -> Constraint:
        goal = Goal(mode="offset", translation=np.array([0.0, height, 0.0]))
        return PositionConstraint(
            path=f"/Lift{name}",
            skeleton=HUMANOID,
            joint=self.token(name),
            goals=(goal,),
            **fields,  # type: ignore[arg-type]
        )

    def turn(self, name: str, vector: tuple[float, float, float]) -> Constraint:
        goal = Goal(mode="offset", rotation=from_vector(np.array(vector)))
        return OrientationConstraint(
            path=f"/Turn{name}",
            skeleton=HUMANOID,
            joint=self.token(name),
            goals=(goal,),
            priority=5,
        )

    def solve(self, *constraints: Constraint) -> Solved:
        scene = humanoid_scene(constraints)
        problem = Problem.of(scene)
        solution = host().solver("prioritized_ik")().solve(problem)
        after = replace(
            problem.cast, translations=solution.translations, rotations=solution.rotations
        )
        return Solved(problem.cast, after, measure(problem, solution, scene.constraints), solution)


@pytest.fixture(scope="session")
def humanoid() -> Humanoid:
    return Humanoid()
