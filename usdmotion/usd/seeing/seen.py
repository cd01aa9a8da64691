"""What is seen of a stage, in metres and in the world."""

from dataclasses import dataclass

from usdmotion.arrays import Bools, Floats, Ints
from usdmotion.cast import Character
from usdmotion.motion import WorldPose


@dataclass(frozen=True, eq=False)
class SeenSurface:
    """A surface at one time."""

    path: str
    """Path of the prim; of the instancer, for what that scatters."""
    points: Floats
    """World [m], shape (point_count, 3)."""
    triangles: Ints
    """Shape (triangle_count, 3)."""
    color: tuple[float, float, float] | None
    """Linear; None where nothing on the stage says."""
    opacity: float
    skeleton: str = ""
    """Path of the Skeleton that moves it, "" for none."""
    joints: Ints | None = None
    """Which joints of that do, by their numbers; None where no skeleton does."""
    sketch: bool = False
    """Whether it is the light mesh by which the joints of a skeleton are seen: one piece each."""


@dataclass(frozen=True, eq=False)
class SeenBody:
    """A character at the times that are looked at."""

    character: Character
    pose: WorldPose
    """Of its joints, (frame_count, joint_count, 3) and (frame_count, joint_count, 4)."""
    visible: Bools
    """When it is, shape (frame_count,)."""
