"""A problem as files for solvers that know nothing of ours, and their answers measured by us."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from comparison.bodies import Point, mjcf
from usdmotion import Character, Problem
from usdmotion.arrays import Floats
from usdmotion.kernels import conjugate, forward, multiply, residuals

CENTER_OF_MASS = "com"
"""What runners know the target of the centre of mass by."""


@dataclass(frozen=True, eq=False)
class Answer:
    """A pose on every frame."""

    root: Floats
    """World position of the first joint [m], shape (F, 3)."""
    turns: Floats
    """Each joint's turn from its rest orientation, the first one's from the world's, (F, J, 4)."""

    @classmethod
    def load(cls, path: Path) -> "Answer":
        """Read what a runner wrote."""
        with np.load(path) as file:
            return cls(file["root"], file["turns"])


def export(problem: Problem, character: Character, names: Sequence[str], folder: Path) -> None:
    """Write model.xml and clip.npz: the body, its postures, and targets from our own table.

    Args:
        problem: Each of its tasks is a point of one joint, or the centre of mass at the end.
        character: The only one.
        names: What to call its tasks.
        folder: Where to write.
    """
    table = problem.table
    first, last = table.first_term[:-1], table.first_term[1:]
    points = {
        name: Point(int(table.term_node[first[task]]) - 1, table.term_point[0, first[task]])
        for task, name in enumerate(names)
        if last[task] == first[task] + 1
    }
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "model.xml").write_text(mjcf(character, points), encoding="utf-8")
    before = given(problem)
    np.savez(
        folder / "clip.npz",
        root=before.root,
        turns=before.turns,
        names=np.array([name if name in points else CENTER_OF_MASS for name in names]),
        targets=table.target,
        levels=table.level,
    )


def given(problem: Problem) -> Answer:
    """Return the input motion of the only character, whose space is the world."""
    return answered(problem, problem.cast.translations, problem.cast.rotations)


def answered(problem: Problem, translations: Floats, rotations: Floats) -> Answer:
    """Return poses of all nodes, (F, N, 3) and (F, N, 4), as runners give them."""
    turns = multiply(conjugate(_rest(problem)), rotations[:, 1:])
    return Answer(translations[:, 1], turns)


def errors(problem: Problem, answer: Answer) -> Floats:
    """Return what an answer leaves of each task [m], (F, T), by our own forward kinematics."""
    cast = problem.cast
    translations, rotations = np.array(cast.translations), np.array(cast.rotations)
    translations[:, 1] = answer.root
    rotations[:, 1:] = multiply(_rest(problem), answer.turns)
    return residuals(problem.table, *forward(cast.parents, translations, rotations))


def turned(problem: Problem, answer: Answer) -> Floats:
    """Return by how much each joint was turned away from the input [degrees], (F, J)."""
    between = multiply(conjugate(given(problem).turns), answer.turns)
    return np.degrees(
        2.0 * np.arctan2(np.linalg.norm(between[..., :3], axis=-1), np.abs(between[..., 3]))
    )


def _rest(problem: Problem) -> Floats:
    rest = np.array(problem.cast.rest_rotations[1:])
    rest[0] = (0.0, 0.0, 0.0, 1.0)
    return rest
