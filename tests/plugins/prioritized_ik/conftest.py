"""Random chains with random limits, and problems on them."""

from dataclasses import dataclass, replace

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.cast import Character
from usdmotion.constraints import Constraint, Goal, OrientationConstraint, PositionConstraint
from usdmotion.kernels import forward, from_vector, multiply, residuals
from usdmotion.motion import Body, Motion, Placement, Skeleton
from usdmotion.scene import Edit, Scene
from usdmotion.solving import Problem, Solution

CHAIN = "/Chain"
RATE = 24.0


@dataclass(frozen=True, eq=False)
class Chain:
    """A branching chain that sways, and may be limited."""

    skeleton: Skeleton
    body: Body
    motion: Motion

    @classmethod
    def random(cls, seed: int, joints: int = 7, frames: int = 4) -> "Chain":
        """Return one with boxes around rest: some sides free, some components locked."""
        random = np.random.default_rng(seed)
        parents = np.array(
            [-1, *(max(0, index - 1 - (index % 5 == 4)) for index in range(1, joints))]
        )
        places = random.normal(size=(joints, 3)) * 0.2 * (parents >= 0)[:, None]
        rest = from_vector(random.normal(size=(joints, 3)))
        skeleton = Skeleton(tuple(f"j{index}" for index in range(joints)), parents, places, rest)
        low, high = random.uniform(0, 70, size=(2, joints, 3))
        free = random.random((2, joints, 3)) > 0.7
        low, high = np.where(free[0], -np.inf, -low), np.where(free[1], np.inf, high)
        locked = random.random((joints, 3)) < 0.1
        low, high = np.where(locked, 10.0, low), np.where(locked, 10.0, high)
        body = replace(Body.unknown(joints), limits_min=low, limits_max=high)
        times = np.arange(frames) / RATE
        sway = np.sin(6.0 * times)[:, None, None] * random.normal(size=(joints, 3)) * 0.2
        turns = from_vector(random.normal(size=(joints, 3)) * 0.4 + sway)
        rotations = multiply(np.broadcast_to(rest, turns.shape), turns)
        translations = np.broadcast_to(places, (frames, joints, 3)).copy()
        return cls(skeleton, body, Motion(times, translations, rotations))

    @property
    def free(self) -> "Chain":
        """The same without limits."""
        return replace(self, body=Body.unknown(len(self.skeleton.joints)))

    def asked(self, seed: int, reach: float, count: int = 1) -> list[Constraint]:
        """Return random constraints, a level each, which are `reach` [m] away."""
        random = np.random.default_rng(seed + 1000)
        tokens = self.skeleton.joints
        constraints: list[Constraint] = []
        for priority in range(1, count + 1):
            shared = {
                "path": f"{CHAIN}/Edit/c{priority}",
                "skeleton": CHAIN,
                "joint": tokens[random.integers(2, len(tokens))],
                "recruits": tokens[1:],
                "priority": priority,
            }
            offset = random.normal(size=3) * reach
            if random.random() < 0.75:
                goal = Goal(mode="offset", translation=offset)
                constraints.append(PositionConstraint(**shared, goals=(goal,)))
            else:
                goal = Goal(mode="offset", rotation=from_vector(2.0 * offset))
                constraints.append(OrientationConstraint(**shared, goals=(goal,)))
        return constraints

    def problem(self, constraints: list[Constraint]) -> Problem:
        """Return the problem of solving them."""
        frames = self.motion.frame_count
        place = Placement.identity(frames)
        character = Character(CHAIN, self.skeleton, self.body, self.motion, place, 0)
        edit = Edit(f"{CHAIN}/Edit", CHAIN, tuple(constraints))
        up = np.array([0.0, 1.0, 0.0])
        return Problem.of(Scene((character,), (edit,), np.arange(frames), up))


def errors(problem: Problem, solution: Solution) -> Floats:
    """Return what is left of each task on each frame, (F, T)."""
    poses = forward(problem.cast.parents, solution.translations, solution.rotations)
    return residuals(problem.table, *poses)
