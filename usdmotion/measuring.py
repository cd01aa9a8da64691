"""What a motion leaves of each constraint, measured by the host and not by the solver."""

from collections.abc import Sequence

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.constraints import Constraint
from usdmotion.kernels import Kind, forward, residuals
from usdmotion.solving import Problem, Solution

_LEVER = 0.1
"""How far the point is away by which a turn is judged in metres [m]."""


def measure(problem: Problem, solution: Solution, constraints: Sequence[Constraint]) -> Floats:
    """Return the error of each constraint on every frame, shape (frame_count, constraint_count).

    Metres or degrees, as each constraint's `unit` says. Where a constraint in metres holds an
    orientation too, that counts as how far a point at 0.1 m is moved by what is left of the turn.
    Activities do not count: where a constraint is not fully on, this is how far it is from what it
    would ask for.
    """
    cast, table = problem.cast, problem.table
    positions, orientations = forward(cast.parents, solution.translations, solution.rotations)
    left = residuals(table, positions, orientations)
    turning = table.kind >= Kind.ROTATION
    errors = np.zeros((cast.frame_count, len(constraints)))
    for index, constraint in enumerate(constraints):
        in_degrees = constraint.unit == "deg"
        scales = np.where(turning, 180.0 / np.pi if in_degrees else _LEVER, not in_degrees)
        own = table.constraint == index
        errors[:, index] = np.linalg.norm((left * scales)[:, own], axis=1)
    return errors


def tolerance(constraint: Constraint) -> float:
    """Return what counts as met: its own tolerance, else 1 mm or 1 degree."""
    if constraint.tolerance > 0.0:
        return constraint.tolerance
    return 1.0 if constraint.unit == "deg" else 1e-3
