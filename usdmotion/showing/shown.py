"""What there is to see of a scene, on every frame and in the world: values to be drawn anywhere."""

from dataclasses import dataclass

from usdmotion.arrays import Bools, Floats
from usdmotion.cast import Character
from usdmotion.motion import WorldPose
from usdmotion.scene import Scene


@dataclass(frozen=True, eq=False)
class Course:
    """The trajectory of an effector, before and after."""

    path: str
    """Path of the constraint whose effector it is; of several, the first of the highest rank."""
    name: str
    """That path without its edit's."""
    before: Floats
    """In the input [m], shape (frame_count, 3)."""
    after: Floats | None
    """In the result [m]; None where nothing is solved yet."""
    on: Bools
    """Where something is asked of it, shape (frame_count,)."""


@dataclass(frozen=True, eq=False)
class GoalMark:
    """A goal, wherever it is meanwhile."""

    path: str
    """Path of the MotionGoal."""
    name: str
    translations: Floats
    """Where the effector is wanted by it [m], shape (frame_count, 3)."""
    rotations: Floats | None
    """How it is wanted turned, xyzw, shape (frame_count, 4); None where only the place matters."""
    activity: Floats
    """0..1, its constraint's included, shape (frame_count,)."""


@dataclass(frozen=True, eq=False)
class Miss:
    """What a constraint is from being met, where it is judged and missed."""

    path: str
    """Path of the constraint."""
    name: str
    places: Floats
    """Where its effector is in the result [m], shape (frame_count, 3)."""
    wanted: Floats | None
    """Where it is wanted [m], shape (frame_count, 3); None where it wants no place."""
    missed: Bools
    """When it is missed, shape (frame_count,)."""
    errors: Floats
    """How far it is from being met, in the constraint's own unit, shape (frame_count,)."""


@dataclass(frozen=True, eq=False)
class Link:
    """Two points that are to be so far apart."""

    path: str
    """Path of the constraint."""
    before: Floats
    """Both points in the input [m], shape (frame_count, 2, 3)."""
    after: Floats | None
    """The same in the result; None where nothing is solved yet."""
    activity: Floats
    """0..1, shape (frame_count,)."""


@dataclass(frozen=True, eq=False)
class BalanceMark:
    """The centre of mass over what it is supported by."""

    path: str
    """Path of the constraint that asks for it, else of the edit."""
    before: Floats
    """Centre of mass in the input [m], shape (frame_count, 3)."""
    after: Floats | None
    """The same in the result; None where nothing is solved yet."""
    supports: Floats
    """Points it should stay over, in the result where there is one [m], (frame_count, count, 3)."""
    supports_before: Floats
    """The same in the input."""
    bearing: Bools
    """Which of them bear the body then, shape (frame_count, count)."""


@dataclass(frozen=True, eq=False)
class ShownEdit:
    """What there is to see of one edit."""

    path: str
    skeleton: str
    solved: bool
    courses: tuple[Course, ...]
    goals: tuple[GoalMark, ...]
    links: tuple[Link, ...]
    misses: tuple[Miss, ...]
    """None of an edit that is not solved."""
    balance: BalanceMark | None


@dataclass(frozen=True, eq=False)
class Actor:
    """A character and its poses."""

    character: Character
    before: WorldPose
    """Of its joints in the input, (frame_count, joint_count, 3) and (…, 4)."""
    after: WorldPose | None
    """The same in the result; None where nothing is solved yet, or nothing solves it."""


@dataclass(frozen=True, eq=False)
class ShownScene:
    """What there is to see of a scene."""

    scene: Scene
    actors: tuple[Actor, ...]
    """Parallel to the scene's characters."""
    edits: tuple[ShownEdit, ...]
    """Parallel to the scene's edits."""
