"""What a reader makes of a file of motion, and the contract of a reader."""

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Literal, Protocol, runtime_checkable

from usdmotion.arrays import Floats, Ints, seal
from usdmotion.capture import Capture
from usdmotion.motion import Motion, Skeleton


@dataclass(frozen=True, eq=False)
class Recording:
    """One skeleton and its motion, as they were captured; metres and seconds."""

    name: str
    """What to call it: a valid prim name."""
    skeleton: Skeleton
    """Joints with valid, unique tokens; its rest pose is the file's."""
    motion: Motion
    """Sampled as the file is; the first sample is at 0 s."""
    frame_rate: float
    """Samples per second."""
    original_names: tuple[str, ...]
    """Name of each joint in the file, parallel to the skeleton's joints."""
    up: Literal["Y", "Z"]
    """The axis of the file that points up."""
    tip_joints: Ints
    """Joints at which the file has an end point, shape (tip_count,)."""
    tip_points: Floats
    """Those end points in their joint's frame [m], shape (tip_count, 3)."""
    notes: tuple[str, ...] = ()
    """One sentence about each thing that was noticed, decided or mended on the way."""

    def __post_init__(self) -> None:
        tips = seal(self.tip_joints, None, dtype="int64", name="tip_joints")
        object.__setattr__(self, "tip_joints", tips)
        object.__setattr__(self, "tip_points", seal(self.tip_points, len(tips), 3))

    @property
    def summary(self) -> str:
        """What it holds, in a few words."""
        return f"{self.motion.frame_count} frames of {len(self.skeleton.joints)} joints"


@runtime_checkable
class Reader(Protocol):
    """Reads files of motion. Its dataclass fields made by `option` are its options."""

    name: ClassVar[str]
    suffixes: ClassVar[tuple[str, ...]]
    """File name endings that it reads, lower case with the dot."""

    def read(self, path: Path) -> Recording | Capture:
        """Read one file: a skeleton that moves, or markers without one.

        Raises:
            FileError: The file is refused; one sentence with the file and the line.
        """
        ...
