"""A solved scene that is changed is as good as one that is solved as it is now."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np
import pytest

from usdmotion import (
    Constraint,
    Edit,
    Goal,
    OrientationConstraint,
    PluginError,
    PositionConstraint,
    Problem,
    Scene,
    SceneError,
    Solution,
)
from usdmotion.kernels import conjugate, forward, multiply, to_vector
from usdmotion.plugins import host
from usdmotion.solved import SolvedScene
from usdmotion.testing import HUMANOID, humanoid_scene

COUNT = 120
SOLVER = host().solver("prioritized_ik")()
SPINE = "pelvis/spine/chest"
LEFT, RIGHT = (f"{SPINE}/{side}_shoulder/{side}_elbow/{side}_wrist" for side in ("left", "right"))
FEET = [f"pelvis/{side}_hip/{side}_knee/{side}_ankle" for side in ("left", "right")]
NAMES = ("translations", "rotations", "iterations", "stops")


def hold(name: str, token: str, priority: int, **fields: Any) -> Constraint:
    kind = fields.pop("kind", PositionConstraint)
    path = f"{HUMANOID}/Edit/{name}"
    return kind(path=path, skeleton=HUMANOID, joint=token, priority=priority, **fields)


def offset(x: float, *times: float) -> Goal:
    return Goal(mode="offset", translation=np.array([x, 0.1, 0.1]), times=times)


def reaching() -> Scene:
    """Return feet that stay, wrists that go one after the other, and a head."""
    return humanoid_scene(
        [
            *(hold(f"foot{index}", token, 1) for index, token in enumerate(FEET)),
            hold("left", LEFT, 2, goals=(offset(0.1, 0.8, 1.2, 1.5, 2.0),)),
            hold("right", RIGHT, 3, goals=(offset(-0.1, 2.5, 3.0, 3.2, 3.5),)),
            hold("head", f"{SPINE}/head", 4, kind=OrientationConstraint),
        ],
        frame_count=COUNT,
    )


def changed(scene: Scene, name: str, **fields: Any) -> Scene:
    """Return a scene in which a constraint has other values; the fields of its goal are its own."""
    (edit,) = scene.edits
    constraints = [
        replace(each, **fields) if each.path.endswith(f"/{name}") else each
        for each in edit.constraints
    ]
    return replace(scene, edits=(replace(edit, constraints=tuple(constraints)),))


def dragged(scene: Scene, name: str, x: float) -> Scene:
    (constraint,) = (each for each in scene.constraints if each.path.endswith(f"/{name}"))
    (goal,) = constraint.goals
    return changed(scene, name, goals=(replace(goal, translation=np.array([x, 0.1, 0.1])),))


def added(scene: Scene, constraint: Constraint) -> Scene:
    (edit,) = scene.edits
    return replace(scene, edits=(replace(edit, constraints=(*edit.constraints, constraint)),))


def removed(scene: Scene, name: str) -> Scene:
    (edit,) = scene.edits
    kept = tuple(each for each in edit.constraints if not each.path.endswith(f"/{name}"))
    return replace(scene, edits=(replace(edit, constraints=kept),))


def smooth(scene: Scene) -> Scene:
    return replace(scene, edits=tuple(replace(e, smoothing=3.0, passes=2) for e in scene.edits))


def apart(scene: Scene, one: Solution, other: Solution) -> tuple[float, float]:
    """Return how far poses are apart in the world at most [mm], and by what angle [degrees]."""
    parents = scene.cast.parents
    places, turns = forward(parents, one.translations, one.rotations)
    other_places, other_turns = forward(parents, other.translations, other.rotations)
    turned = to_vector(multiply(turns, conjugate(other_turns)))
    moved = np.linalg.norm(places - other_places, axis=-1)
    return 1e3 * float(moved.max()), float(np.degrees(np.linalg.norm(turned, axis=-1).max()))


def same(one: Solution, other: Solution, frames: slice) -> bool:
    pairs = ((getattr(one, name)[frames], getattr(other, name)[frames]) for name in NAMES)
    return all(np.array_equal(first, second) for first, second in pairs)


EDITS: dict[str, Callable[[Scene], Scene]] = {
    "a goal": lambda scene: dragged(scene, "left", 0.2),
    "a goal out of reach": lambda scene: dragged(scene, "left", 2.0),
    "a rank": lambda scene: changed(scene, "right", priority=1),
    "a rank nobody has": lambda scene: changed(scene, "left", priority=7),
    "a weight": lambda scene: changed(scene, "foot0", weight=3.0),
    "times": lambda scene: changed(scene, "left", times=(0.9, 1.0, 1.4, 1.5)),
    "recruits": lambda scene: changed(scene, "right", recruits=(RIGHT.rsplit("/", 1)[0],)),
    "activity": lambda scene: changed(scene, "head", activity=np.linspace(1.0, 0.0, COUNT)),
    "one more": lambda scene: added(
        scene, hold("hips", "pelvis", 6, goals=(offset(0.05, 3.0, 3.4, 3.5, 4.0),))
    ),
    "one less": lambda scene: removed(scene, "left"),
}


@pytest.mark.parametrize("smoothing", [False, True], ids=["one pass", "smoothed"])
@pytest.mark.parametrize("name", EDITS)
def test_every_change_ends_where_a_solve_from_scratch_does(name: str, smoothing: bool) -> None:
    scene = smooth(reaching()) if smoothing else reaching()
    solved = SolvedScene(scene, SOLVER)
    first, after = solved.solution, EDITS[name](scene)
    frames = solved.become(after)
    again, whole = solved.solution, SolvedScene(after, SOLVER).solution
    millimetres, degrees = apart(scene, again, whole)
    assert millimetres < 1e-3 and degrees < 1e-3
    assert same(again, first, slice(0, frames.start))
    assert same(again, first, slice(frames.stop, None))
    if not smoothing:
        assert same(again, whole, slice(0, frames.stop))


def test_with_a_filter_over_uneven_frames_every_frame_is_solved_again() -> None:
    def uneven(scene: Scene) -> Scene:
        (character,) = scene.characters
        times = character.motion.times + 0.002 * np.sin(character.motion.times)
        return replace(
            scene, characters=(replace(character, motion=replace(character.motion, times=times)),)
        )

    scene = uneven(smooth(reaching()))
    solved, after = SolvedScene(scene, SOLVER), dragged(scene, "left", 0.2)
    frames = solved.become(after)
    assert (frames.start, frames.stop) == (0, COUNT)
    assert max(apart(scene, solved.solution, SolvedScene(after, SOLVER).solution)) < 1e-3


def test_a_goal_reaches_few_frames_behind_it() -> None:
    scene = reaching()
    frames = SolvedScene(scene, SOLVER).become(dragged(scene, "left", 0.2))
    assert frames.start == 20
    assert 48 <= frames.stop < 70


def test_a_change_of_nothing_solves_nothing() -> None:
    scene = reaching()
    solved = SolvedScene(scene, SOLVER)
    first, seconds = solved.solution, solved.seconds
    for nothing in (scene, dragged(scene, "left", 0.1), changed(scene, "head", priority=99)):
        frames = solved.become(nothing)
        assert frames.start == frames.stop
    assert solved.seconds == seconds
    assert same(solved.solution, first, slice(None))


def test_a_change_that_is_undone_leaves_nothing_behind() -> None:
    scene = reaching()
    solved = SolvedScene(scene, SOLVER)
    first = solved.solution
    for x in np.linspace(0.1, 2.0, 9):
        there = solved.become(dragged(scene, "left", float(x)))
    back = solved.become(scene)
    assert same(solved.solution, first, slice(0, 48))
    assert same(solved.solution, first, slice(max(there.stop, back.stop), None))
    millimetres, degrees = apart(scene, solved.solution, first)
    assert millimetres < 1e-4 and degrees < 1e-4


def test_any_number_of_random_changes_ends_where_a_solve_from_scratch_does() -> None:
    random = np.random.default_rng(3)
    scene = reaching()
    solved = SolvedScene(scene, SOLVER)
    for _ in range(40):
        name = str(random.choice(["left", "right"]))
        if random.random() < 0.3:
            scene = changed(scene, name, priority=int(random.integers(1, 5)))
        elif random.random() < 0.3:
            start = float(random.uniform(0.2, 3.0))
            keys = (start, start + 0.4, start + 0.6, start + 1.0)
            scene = changed(scene, name, goals=(offset(0.1, *keys),))
        else:
            scene = dragged(scene, name, float(random.normal(scale=0.5)))
        solved.become(scene)
    millimetres, degrees = apart(scene, solved.solution, SolvedScene(scene, SOLVER).solution)
    assert millimetres < 1e-3 and degrees < 1e-3


def test_recruiting_stays_mended() -> None:
    scene = changed(reaching(), "foot0", recruits=FEET[:1])
    solved = SolvedScene(scene, SOLVER, mend_recruiting=True)
    after = dragged(scene, "left", 0.2)
    frames = solved.become(after)
    assert frames.start == 20 and frames.stop < 70
    whole = SolvedScene(after, SOLVER, mend_recruiting=True).solution
    assert max(apart(scene, solved.solution, whole)) < 1e-3
    assert len(solved.posed.constraints[0].recruits) > len(solved.scene.constraints[0].recruits)


@dataclass(frozen=True)
class Forgetful:
    """Our solver without the gift of going on."""

    name: ClassVar[str] = "forgetful"

    def solve(self, problem: Problem) -> Solution:
        return replace(SOLVER.solve(problem), carried=None)


def test_a_solver_that_does_not_resume_solves_everything_again() -> None:
    scene, solver = reaching(), Forgetful()
    solved = SolvedScene(scene, solver)
    frames = solved.become(dragged(scene, "left", 0.2))
    assert frames.start == 20
    whole = SolvedScene(dragged(scene, "left", 0.2), SOLVER).solution
    assert same(solved.solution, whole, slice(None))


def test_a_refused_change_leaves_everything_as_it_was() -> None:
    scene = smooth(reaching())
    solved = SolvedScene(scene, SOLVER)
    first = solved.solution
    for refused in (
        added(scene, hold("tail", "pelvis/tail", 1)),
        changed(dragged(scene, "left", 0.3), "right", axes="w"),
    ):
        with pytest.raises(SceneError):
            solved.become(refused)
        assert solved.scene is scene
        assert same(solved.solution, first, slice(None))
    solved.become(dragged(scene, "left", 0.2))
    whole = SolvedScene(dragged(scene, "left", 0.2), SOLVER).solution
    assert max(apart(scene, solved.solution, whole)) < 1e-3


@dataclass
class Failing:
    """Our solver, until it has answered often enough."""

    name: ClassVar[str] = "failing"
    resumes: ClassVar[bool] = True
    patience: int

    def solve(self, problem: Problem) -> Solution:
        self.patience -= 1
        solution = SOLVER.solve(problem)
        spoiled = self.patience < 0
        return replace(solution, rotations=solution.rotations * np.nan) if spoiled else solution


def test_a_solver_that_fails_midway_leaves_everything_as_it_was() -> None:
    scene = smooth(reaching())
    after = dragged(scene, "left", 0.4)
    patient = Failing(1000)
    SolvedScene(scene, patient).become(after)
    calls = 1000 - patient.patience
    assert calls > 5, "both passes have to be solved in parts"
    for patience in range(2, calls, 2):
        solved = SolvedScene(scene, Failing(patience))
        first = solved.solution
        with pytest.raises(PluginError, match="the solver 'failing' gives back numbers that are"):
            solved.become(after)
        assert same(solved.solution, first, slice(None))
        assert solved.scene is scene


def test_a_motion_is_that_of_the_skeleton_on_the_frames() -> None:
    solved = SolvedScene(reaching(), SOLVER)
    motion = solved.motion(HUMANOID, slice(10, 12))
    assert np.array_equal(motion.rotations, solved.solution.rotations[10:12, 1:])
    assert np.array_equal(motion.times, solved.scene.times[10:12])


def test_a_report_is_of_the_scene_as_it_is_now() -> None:
    scene = reaching()
    solved = SolvedScene(scene, SOLVER)
    assert solved.report().met
    solved.become(dragged(scene, "left", 3.0))
    met = {row.path.rsplit("/", 1)[-1]: row.met for row in solved.report().edits[0].constraints}
    assert met["foot0"] and met["foot1"] and not met["left"]


def test_edits_that_are_solved_together_have_the_same_passes() -> None:
    scene = reaching()
    other = Edit("/Other", HUMANOID, (), smoothing=2.0)
    with pytest.raises(SceneError, match="ask for different usdmotion:smoothing"):
        SolvedScene(replace(scene, edits=(*scene.edits, other)), SOLVER)
