"""What a solver promises that can go on from where a solve was left."""

from dataclasses import fields, replace

import numpy as np

from usdmotion.constraints import Constraint, Goal, PositionConstraint
from usdmotion.scene import Scene
from usdmotion.solving import Problem, Solution, Solver, resumes
from usdmotion.testing.scenes import HUMANOID, humanoid_scene

_WRIST = "pelvis/spine/chest/left_shoulder/left_elbow/left_wrist"
_ANKLES = [f"pelvis/{side}_hip/{side}_knee/{side}_ankle" for side in ("left", "right")]


def check_resuming(solver: Solver) -> None:
    """If it says that it resumes, it goes on from known frames as if it had found them itself."""
    if not resumes(solver):
        return
    for scene in (*map(humanoid_scene, map(_reaching, (0.1, 2.0))), _growing()):
        problem = Problem.of(scene)
        whole, count = solver.solve(problem), problem.cast.frame_count
        for known in (1, count // 3, count // 2, count - 1):
            rest = problem.during(slice(known - 1, count), whole.during(slice(known - 1, known)))
            _same(solver.solve(rest), whole.during(slice(known - 1, count)))


def _growing() -> Scene:
    """Return one whose joints come to lie elsewhere on the way, each along its own axis."""
    scene = humanoid_scene(_reaching(0.1))
    (character,) = scene.characters
    motion = character.motion
    own = np.eye(3)[np.arange(motion.translations.shape[1]) % 3]
    moved = motion.translations + 0.06 * np.sin(3.0 * motion.times)[:, None, None] * own
    motion = replace(motion, translations=moved)
    return replace(scene, characters=(replace(character, motion=motion),))


def _reaching(far: float) -> list[Constraint]:
    """Return feet that stay, a wrist that comes and goes, and a head that ranks below it."""
    goal = Goal(mode="offset", translation=np.array([far, 0.1, far]), times=(0.2, 0.4, 0.5, 0.8))
    feet = [_hold(f"foot{index}", token, 1) for index, token in enumerate(_ANKLES)]
    return [*feet, _hold("hand", _WRIST, 2, goal), _hold("head", "pelvis/spine/chest/head", 3)]


def _hold(name: str, token: str, priority: int, *goals: Goal) -> Constraint:
    return PositionConstraint(
        path=f"{HUMANOID}/Edit/{name}",
        skeleton=HUMANOID,
        joint=token,
        priority=priority,
        goals=goals,
    )


def _same(found: Solution, wanted: Solution) -> None:
    for field in fields(Solution):
        one, other = getattr(found, field.name), getattr(wanted, field.name)
        assert (one is None) == (other is None) and np.array_equal(one, other), (
            f"from frames that are known a solver that resumes must find the same {field.name}, "
            "to the last bit, as it does in a solve of the whole clip"
        )
