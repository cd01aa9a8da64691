"""A stage as plain values: the scenes to be solved, and what the writer has to know of the rest."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from usdmotion.arrays import Floats, Ints
from usdmotion.motion import Motion
from usdmotion.scene import Scene

Singles = NDArray[np.float32]
Halves = NDArray[np.float16]


@dataclass(frozen=True, eq=False)
class Facts:
    """What a stage says of itself."""

    meters_per_unit: float
    up_axis: Literal["Y", "Z"]
    time_codes_per_second: float
    frames_per_second: float
    start: float | None
    """First time code, None where nobody says."""
    end: float | None
    """Last time code, None where nobody says."""
    default_prim: str
    """Name of the default prim, "" where there is none."""

    @property
    def up(self) -> Floats:
        """The direction away from the ground, shape (3,)."""
        return np.asarray(np.eye(3)["XYZ".index(self.up_axis)])


@dataclass(frozen=True, eq=False)
class Samples:
    """The arrays of a SkelAnimation as they are stored: stage units, single and half precision."""

    time_codes: Floats
    """Ascending, shape (sample_count,); none where the animation does not move."""
    translations: Singles
    """Shape (sample_count, joint_count, 3)."""
    rotations: Singles
    """xyzw, shape (sample_count, joint_count, 4)."""
    scales: Halves
    """Shape (sample_count, joint_count, 3)."""


@dataclass(frozen=True, eq=False)
class Rest:
    """The rest pose of a skeleton's joints in its own units, parallel to the joints."""

    translations: Floats
    rotations: Floats
    """xyzw."""
    scales: Floats


@dataclass(frozen=True, eq=False)
class Take:
    """How the motion that an edit starts from is stored, so that its result is stored alike."""

    edit: str
    """Path of the MotionEdit."""
    result: str
    """Path of the SkelAnimation to be written."""
    holder: str
    """Path of the prim that the animation is bound on."""
    bound: str
    """Path of the SkelAnimation to be bound: the result, or what is stacked on it."""
    source: str
    """Path of the SkelAnimation that was read."""
    joints: tuple[str, ...]
    """Joint tokens of the source, in its own order; none where it shows the rest pose."""
    columns: Ints
    """Which of those each joint of the skeleton is, -1 for none, shape (joint_count,)."""
    own: Samples
    """The source at its own times."""
    solved: Samples
    """The source at the times that are solved."""
    units: Floats
    """Metres per unit in each joint's parent's frame, shape (frame_count, joint_count)."""
    rest: Rest | None
    """The rest pose; None where the skeleton has none."""
    extras: str
    """Blend shapes and whatever else the source holds, as a layer with the prim </source>."""
    folder: str
    """Folder to which the paths of assets in the extras are relative."""


@dataclass(frozen=True, eq=False)
class Shot:
    """A stage that was read."""

    path: Path
    """The file that was opened."""
    facts: Facts
    layers: frozenset[str]
    """Real path of every file that the stage is made of."""
    scenes: tuple[Scene, ...]
    """Each is solvable on its own."""
    takes: tuple[Take, ...]
    """One for each edit of the scenes."""
    warnings: tuple[str, ...] = ()
    """One sentence about each thing that can be solved but is probably not meant."""
    frames: tuple[float, float] | None = None
    """First and last time code that were asked for, over what the edits say."""
    cleaning: float | None = None
    """Cutoff of the filter of the input that was asked for, over what the edits say [Hz]."""
    ground: tuple[str, ...] | None = None
    """Paths of the prims that the input is put on, over what the edits say."""

    def scene(self, edit: str) -> Scene:
        """Return the scene that an edit is in."""
        return next(scene for scene in self.scenes if any(e.path == edit for e in scene.edits))


@dataclass(frozen=True, eq=False)
class Result:
    """What was made of one edit."""

    edit: str
    """Path of the MotionEdit."""
    motion: Motion
    """Motion of the edit's skeleton at the solved times."""
    solver: str
    """Registered name of the solver."""
    options: Mapping[str, object]
    """The options that it ran with."""
