"""What became of a scene: its motions as a stage shows them, and where they come from."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from usdmotion.motion import Motion
from usdmotion.scene import Scene
from usdmotion.solving import Problem, Solution


@dataclass(frozen=True, eq=False)
class Record:
    """What the result of one edit says of itself, and what the stage says of it now."""

    edit: str
    """Path of the MotionEdit."""
    solver: str
    version: str
    """Version of usdmotion that made it."""
    options: Mapping[str, object]
    """The options that the solver ran with."""
    input_hash: str
    """Hash of everything that it was made from."""
    hash_now: str
    """The same hash of what the stage says now."""
    shown: bool
    """Whether the Skeleton is bound to it, or to what was made from it."""

    @property
    def stale(self) -> bool:
        """Whether what it was made from has changed since."""
        return self.input_hash != self.hash_now


@dataclass(frozen=True, eq=False)
class Outcome:
    """A scene with the results of its edits."""

    scene: Scene
    """What is asked, and the input motions, as the stage says them now."""
    motions: Mapping[str, Motion]
    """The result on each edited skeleton at the scene's times, by the skeleton's path."""
    records: tuple[Record, ...]
    """Parallel to the scene's edits."""
    notes: tuple[str, ...] = ()
    """What was said when it was solved."""
    told: bool = False
    """Whether its ground was told by a program, so that nothing on the stage says what it is."""

    @cached_property
    def problem(self) -> Problem:
        """The problem that the scene poses."""
        return Problem.of(self.scene)

    @cached_property
    def solution(self) -> Solution:
        """The results as the pose of every node on every frame."""
        cast = self.scene.cast
        translations, rotations = np.array(cast.translations), np.array(cast.rotations)
        for path, motion in self.motions.items():
            start = cast.index[path, ""] + 1
            joints = slice(start, start + motion.rotations.shape[1])
            translations[:, joints] = motion.translations
            rotations[:, joints] = motion.rotations
        nothing = np.zeros(cast.frame_count, dtype=np.int64)
        return Solution(translations, rotations, nothing, nothing)
