"""The contract of a solver, one promise a function."""

from collections.abc import Callable
from dataclasses import fields, replace
from functools import partial

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.constraints import Constraint, Goal, PositionConstraint
from usdmotion.contract import check_solver_kind
from usdmotion.kernels import conjugate, forward, from_vector, multiply, residuals, to_vector
from usdmotion.scene import Scene
from usdmotion.solving import STOPS, Problem, Solution, Solver
from usdmotion.testing.live import check_live
from usdmotion.testing.resuming import check_resuming
from usdmotion.testing.scenes import ARM, HUMANOID, arm_scene, humanoid_scene, moved, posed
from usdmotion.testing.settings import check_limits

_WRIST = "base/shoulder/elbow/wrist"
_ELBOW = "base/shoulder/elbow"
_SHOULDER = "base/shoulder"
_MILLIMETRE = 1e-3


def check_solver(solver: Solver) -> None:
    """Run every check of `SOLVER_CHECKS` on a solver.

    Raises:
        AssertionError: A promise is not kept; the sentence says which.
    """
    for check in SOLVER_CHECKS:
        check(solver)


def check_options(solver: Solver) -> None:
    """Its options say what they are and hold to their limits."""
    check_limits(type(solver), check_solver_kind)


def check_poses(solver: Solver) -> None:
    """It gives back a finite pose of unit quaternions for every node and frame."""
    problem, solution = _solved(solver, _reaching())
    cast = problem.cast
    _same_shape("translations", solution.translations, cast.translations)
    _same_shape("rotations", solution.rotations, cast.rotations)
    finite = np.isfinite(solution.translations).all() and np.isfinite(solution.rotations).all()
    assert finite, "a pose must be finite"
    lengths = np.linalg.norm(solution.rotations, axis=-1)
    assert np.abs(lengths - 1.0).max() < 1e-6, "rotations must be unit quaternions"
    assert (solution.iterations >= 0).all(), "a number of iterations must not be negative"
    known = (0 <= solution.stops) & (solution.stops < len(STOPS))
    assert known.all(), "why a frame was left must be an index into STOPS"


def check_unrecruited(solver: Solver) -> None:
    """It does not touch what nobody recruits."""
    problem, solution = _solved(solver, _reaching())
    others = ~problem.recruited
    for name in ("translations", "rotations"):
        kept = np.array_equal(
            getattr(solution, name)[:, others], getattr(problem.cast, name)[:, others]
        )
        assert kept, f"the {name} of joints that nobody recruits must equal the input exactly"
    still = ~problem.cast.translates
    kept = np.array_equal(solution.translations[:, still], problem.cast.translations[:, still])
    assert kept, "only the root of a skeleton may be translated"


def check_nothing_asked(solver: Solver) -> None:
    """It gives the input back where nothing is asked, or nothing that is not so already."""
    preserving = [_hold("wrist", _WRIST, 1), _hold("elbow", _ELBOW, 2)]
    off = replace(_reach(_goal()), activity=0.0)
    for asked, constraints in (
        ("nothing is asked", []),
        ("the input obeys already", preserving),
        ("no activity is above 0", [off]),
    ):
        problem, solution = _solved(solver, arm_scene(constraints))
        input_motion = _motion_of(problem)
        distance, angle = _apart(problem, solution, input_motion)
        assert distance <= 1e-4 and angle <= 0.05, (
            f"where {asked} the input must come back, not one {distance * 1e3:.3f} mm "
            f"and {angle:.3f}° away from it"
        )


def check_reach(solver: Solver) -> None:
    """It brings a joint to a point within reach, within a millimetre."""
    errors = _errors(*_solved(solver, _reaching()))
    assert errors.max() <= _MILLIMETRE, (
        f"a point within reach must be met within 1 mm, not missed by {errors.max() * 1e3:.3f} mm"
    )


def check_out_of_reach(solver: Solver) -> None:
    """It stretches towards a point out of reach, and raises nothing."""
    scene = arm_scene([_reach(np.array([3.0, 1.4, 0.0]))])
    problem, solution = _solved(solver, scene)
    assert np.isfinite(solution.rotations).all(), "a point out of reach must not spoil the numbers"
    before = _errors(problem, _motion_of(problem))
    after = _errors(problem, solution)
    assert (after <= before + 1e-9).all(), "a point out of reach must not be left farther away"


def check_ranks(solver: Solver) -> None:
    """It lets nothing of a lower rank disturb a higher one."""
    wrist = _reach(_goal())
    elbow = replace(_reach(np.array([0.5, 2.5, 0.5])), path=f"{ARM}/Edit/elbow", joint=_ELBOW)
    foot = _hold("foot", "pelvis/left_hip/left_knee/left_ankle", 1, HUMANOID)
    hand = "pelvis/spine/chest/left_shoulder/left_elbow/left_wrist"
    far = replace(
        _hold("hand", hand, 2, HUMANOID), goals=(Goal(translation=np.array([0.5, 2.5, 1.5])),)
    )
    for build, high, low in (
        (arm_scene, wrist, replace(elbow, priority=2)),
        (humanoid_scene, foot, far),
    ):
        alone = _errors(*_solved(solver, build([high])))[:, 0].max()
        below = _errors(*_solved(solver, build([low, high])))[:, 0].max()
        assert below <= alone + _MILLIMETRE, (
            f"<{low.path}> ranks below <{high.path}> and must not disturb it "
            f"by {(below - alone) * 1e3:.3f} mm"
        )


def check_rank_order(solver: Solver) -> None:
    """It reads only the order of the priorities, not their numbers."""
    wrist, elbow = _reach(_goal()), _hold("elbow", _ELBOW, 2)
    _, near = _solved(solver, arm_scene([wrist, elbow]))
    _, far = _solved(solver, arm_scene([replace(wrist, priority=7), replace(elbow, priority=900)]))
    assert _same_bytes(near, far), "priorities 1, 2 and 7, 900 must give the same bytes"


def check_repeatable(solver: Solver) -> None:
    """It gives the same bytes for the same inputs, and leaves them as they are."""
    problem = Problem.of(_reaching())
    before = _inputs(problem)
    first = solver.solve(problem)
    same = all(np.array_equal(old, new) for old, new in zip(before, _inputs(problem), strict=True))
    assert same, "a solver must not change the arrays that it is given"
    for again in (solver.solve(problem), solver.solve(Problem.of(_reaching()))):
        assert _same_bytes(first, again), "the same inputs must give the same bytes"


def check_world(solver: Solver) -> None:
    """It does not care where in the world a scene stands, nor which way it faces."""
    scene = _reaching()
    turn = from_vector(np.array([0.4, -1.1, 0.7]))
    there = moved(scene, np.array([3.0, -2.0, 5.0]), turn)
    problem, here = _solved(solver, scene)
    _, elsewhere = _solved(solver, there)
    back = replace(
        elsewhere,
        translations=_with_spaces(elsewhere.translations, problem.cast.translations),
        rotations=_with_spaces(elsewhere.rotations, problem.cast.rotations),
    )
    distance, angle = _apart(problem, here, back)
    assert distance <= 1e-4 and angle <= 0.05, (
        f"a scene that is moved as a whole must have the same answer, not one "
        f"{distance * 1e3:.3f} mm and {angle:.3f}° away"
    )


def check_order_of_constraints(solver: Solver) -> None:
    """It does not care in which order the constraints of one rank stand."""
    constraints = [_reach(_goal()), replace(_hold("elbow", _ELBOW, 1), weight=0.5)]
    problem, one = _solved(solver, arm_scene(constraints))
    _, other = _solved(solver, arm_scene(constraints[::-1]))
    distance, angle = _apart(problem, one, other)
    assert distance <= 1e-4 and angle <= 0.05, (
        f"constraints of one rank must give the same answer in any order, not one "
        f"{distance * 1e3:.3f} mm and {angle:.3f}° away"
    )


SOLVER_CHECKS: tuple[Callable[[Solver], None], ...] = (
    check_options,
    check_poses,
    check_unrecruited,
    check_nothing_asked,
    check_reach,
    check_out_of_reach,
    check_ranks,
    check_rank_order,
    check_repeatable,
    check_world,
    check_order_of_constraints,
    check_resuming,
    check_live,
)
"""The contract, one promise each; to parametrize a test with."""


def _goal() -> Floats:
    """Return a course within the arm's reach, shape (frame_count, 3)."""
    positions, _ = posed(arm_scene(), {_SHOULDER: (0.3, 0.4, -0.3), _ELBOW: (0.0, 0.5, 0.0)})
    return positions[:, -1]


def _reach(target: Floats) -> Constraint:
    return replace(_hold("wrist", _WRIST, 1), goals=(Goal(translation=target),))


def _hold(name: str, joint: str, priority: int, skeleton: str = ARM) -> Constraint:
    recruits = (_SHOULDER, _ELBOW) if skeleton == ARM else ()
    return PositionConstraint(
        path=f"{skeleton}/Edit/{name}",
        skeleton=skeleton,
        joint=joint,
        priority=priority,
        recruits=recruits,
    )


def _reaching() -> Scene:
    return arm_scene([_reach(_goal())])


def _solved(solver: Solver, scene: Scene) -> tuple[Problem, Solution]:
    problem = Problem.of(scene)
    return problem, solver.solve(problem)


def _motion_of(problem: Problem) -> Solution:
    """Return the input as if it were a solution."""
    cast = problem.cast
    nothing = np.zeros(cast.frame_count, dtype=np.int64)
    return Solution(cast.translations, cast.rotations, nothing, nothing)


def _errors(problem: Problem, solution: Solution) -> Floats:
    poses = forward(problem.cast.parents, solution.translations, solution.rotations)
    return residuals(problem.table, *poses)


def _apart(problem: Problem, one: Solution, other: Solution) -> tuple[float, float]:
    """Return the largest distance [m] and angle [degrees] between two motions, in the world."""
    world = partial(forward, problem.cast.parents)
    positions_one, orientations_one = world(one.translations, one.rotations)
    positions_other, orientations_other = world(other.translations, other.rotations)
    turns = to_vector(multiply(orientations_one, conjugate(orientations_other)))
    distance = np.linalg.norm(positions_one - positions_other, axis=-1).max()
    return float(distance), float(np.degrees(np.linalg.norm(turns, axis=-1).max()))


def _with_spaces(values: Floats, spaces: Floats) -> Floats:
    """Return the transforms of joints with those of the first character's space replaced."""
    return np.concatenate([spaces[:, :1], values[:, 1:]], axis=1)


def _same_shape(name: str, array: Floats, wanted: Floats) -> None:
    assert array.shape == wanted.shape, (
        f"{name} must have the shape {wanted.shape} of the input, not {array.shape}"
    )


def _same_bytes(one: Solution, other: Solution) -> bool:
    pairs = ((getattr(one, field.name), getattr(other, field.name)) for field in fields(Solution))
    return all(first is second or first.tobytes() == second.tobytes() for first, second in pairs)


def _inputs(problem: Problem) -> list[Floats]:
    """Return copies of all arrays of a problem."""
    cast = (getattr(problem.cast, field.name) for field in fields(problem.cast))
    values = (*cast, *problem.table)
    return [np.array(value) for value in values if isinstance(value, np.ndarray)]
