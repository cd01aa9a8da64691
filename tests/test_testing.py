"""The public checks: they pass what keeps its promises and name what does not."""

import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
import pytest

from usdmotion import (
    Problem,
    Solution,
    option,
)
from usdmotion.kernels import forward, from_vector, multiply
from usdmotion.plugins import host
from usdmotion.testing import (
    ARM,
    HUMANOID,
    SOLVER_CHECKS,
    arm_scene,
    check_solver,
    humanoid_scene,
    moved,
    posed,
)

CHECKS = {check.__name__: check for check in SOLVER_CHECKS}


@pytest.mark.parametrize("name", CHECKS)
def test_our_solver_keeps_the_contract(name: str) -> None:
    """A check asserts itself; that each can fail is what the spoiled solvers below are for."""
    CHECKS[name](host().solver("prioritized_ik")())


@dataclass(frozen=True)
class Spoiled:
    """Our solver, whose answer is spoiled afterwards, or whose problem is before."""

    name: ClassVar[str] = "spoiled"
    after: Callable[[Problem, Solution], Solution] = lambda problem, solution: solution
    before: Callable[[Problem], Problem] = lambda problem: problem

    def solve(self, problem: Problem) -> Solution:
        solver = host().solver("prioritized_ik")()
        return self.after(problem, solver.solve(self.before(problem)))


def input_of(problem: Problem) -> Solution:
    cast = problem.cast
    nothing = np.zeros(cast.frame_count, dtype=np.int64)
    return Solution(cast.translations, cast.rotations, nothing, nothing)


def turned(vector: tuple[float, float, float], nodes: slice) -> Callable[..., Solution]:
    def spoil(problem: Problem, solution: Solution) -> Solution:
        rotations = np.array(solution.rotations)
        rotations[:, nodes] = multiply(rotations[:, nodes], from_vector(np.array([vector])))
        return replace(solution, rotations=rotations)

    return spoil


def level_less(problem: Problem) -> Problem:
    table = problem.table
    return replace(problem, table=table._replace(level=np.zeros_like(table.level)))


def scribbling(problem: Problem) -> Problem:
    problem.table.weight[:] = 2.0
    return problem


def noisy(problem: Problem, solution: Solution) -> Solution:
    noise = np.random.default_rng().normal(scale=1e-5, size=3)
    return turned(tuple(noise), slice(2, 3))(problem, solution)


def worldly(problem: Problem, solution: Solution) -> Solution:
    lean = 0.01 * problem.cast.positions[:, 2, 0].mean()
    return turned((lean, 0.0, 0.0), slice(2, 3))(problem, solution)


def first_first(problem: Problem, solution: Solution) -> Solution:
    lean = 0.01 * problem.table.weight[0, 0]
    return turned((lean, 0.0, 0.0), slice(2, 3))(problem, solution)


SPOILED = {
    "check_poses": (
        Spoiled(lambda p, s: replace(s, rotations=2.0 * s.rotations)),
        "rotations must be unit quaternions",
    ),
    "check_unrecruited": (
        Spoiled(turned((1e-12, 0.0, 0.0), slice(1, 2))),
        "joints that nobody recruits must equal the input exactly",
    ),
    "check_nothing_asked": (
        Spoiled(turned((0.01, 0.0, 0.0), slice(2, 3))),
        "where nothing is asked the input must come back",
    ),
    "check_reach": (
        Spoiled(lambda p, s: input_of(p)),
        "a point within reach must be met within 1 mm",
    ),
    "check_out_of_reach": (
        Spoiled(turned((0.0, 0.0, 2.0), slice(2, 3))),
        "must not be left farther away",
    ),
    "check_ranks": (
        Spoiled(before=level_less),
        "must not disturb it",
    ),
    "check_repeatable": (Spoiled(noisy), "the same inputs must give the same bytes"),
    "check_world": (Spoiled(worldly), "a scene that is moved as a whole must have the same"),
    "check_order_of_constraints": (
        Spoiled(first_first),
        "constraints of one rank must give the same answer in any order",
    ),
}


@pytest.mark.parametrize("name", SPOILED)
def test_each_check_names_the_promise_that_is_broken(name: str) -> None:
    solver, sentence = SPOILED[name]
    with pytest.raises(AssertionError, match=sentence):
        CHECKS[name](solver)


def test_a_solver_that_writes_into_its_input_is_found_out() -> None:
    with pytest.raises(AssertionError, match="must not change the arrays that it is given"):
        CHECKS["check_repeatable"](Spoiled(before=scribbling))


def test_a_solver_that_resumes_and_forgets_what_was_known_is_found_out() -> None:
    @dataclass(frozen=True)
    class Forgetful(Spoiled):
        resumes: ClassVar[bool] = True

    forgetful = Forgetful(before=lambda problem: replace(problem, known=None))
    with pytest.raises(AssertionError, match="from frames that are known a solver that resumes"):
        CHECKS["check_resuming"](forgetful)
    CHECKS["check_resuming"](Spoiled())


def test_a_solver_whose_options_say_nothing_is_found_out() -> None:
    @dataclass(frozen=True)
    class Silent(Spoiled):
        much: int = option(1, "")

    with pytest.raises(AssertionError, match="does not say what the option 'much' is"):
        check_solver(Silent())


def test_the_contract_runs_without_usd() -> None:
    script = (
        "import sys; sys.modules['pxr'] = None\n"
        "from usdmotion.plugins import host\n"
        "from usdmotion.testing import check_solver\n"
        "check_solver(host().solver('prioritized_ik')())\n"
        "print('kept')"
    )
    said = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert said.stdout == "kept\n", said.stderr


def test_a_scene_of_each_kind_has_what_it_says() -> None:
    arm, humanoid = arm_scene(frame_count=3), humanoid_scene()
    assert [token for _, token in arm.cast.joints][1:3] == ["base", "base/shoulder"]
    assert arm.cast.frame_count == 3
    assert arm.characters[0].path == ARM
    assert len(humanoid.character(HUMANOID).skeleton.joints) == 16
    assert humanoid.cast.masses.sum() > 50.0


def test_a_moved_scene_stands_elsewhere_with_the_same_motion() -> None:
    scene = arm_scene()
    shift, turn = np.array([1.0, 2.0, 3.0]), from_vector(np.array([0.0, np.pi / 2, 0.0]))
    there = moved(scene, shift, turn)
    x, y, z = scene.cast.positions[0, -1]
    np.testing.assert_allclose(there.cast.positions[0, -1], np.add(shift, (z, y, -x)), atol=1e-12)
    assert np.array_equal(there.cast.rotations[:, 1:], scene.cast.rotations[:, 1:])


def test_a_posed_scene_turns_only_the_named_joints() -> None:
    scene = arm_scene()
    positions, orientations = posed(scene, {"base/shoulder": (0.0, 0.5, 0.0)})
    cast = scene.cast
    np.testing.assert_allclose(positions[:, :2], cast.positions[:, 1:3], atol=1e-12)
    assert not np.allclose(orientations[:, -1], cast.orientations[:, -1])
    np.testing.assert_allclose(
        forward(cast.parents, cast.translations, cast.rotations)[0], cast.positions
    )
