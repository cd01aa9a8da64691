"""What there is to tell of a stage, as plain values."""

from dataclasses import dataclass

from usdmotion.usd.faults import Fault


@dataclass(frozen=True, slots=True)
class SkeletonFacts:
    """One Skeleton."""

    path: str
    joint_count: int
    root: str
    """The joint with six degrees of freedom in a solve."""
    animation: str
    """Path of the SkelAnimation that is bound, "" for none."""
    rest: bool
    """Whether it has rest transforms, one for each joint."""
    bind: bool
    """Whether it has bind transforms, one for each joint."""
    instance: bool
    """Whether it is inside an instance."""
    parts: int
    """How many joints are known to be which part of a body."""
    joints: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class ClipFacts:
    """One SkelAnimation."""

    path: str
    joint_count: int
    samples: int
    first: float | None
    """Time code of its first sample."""
    last: float | None
    rate: float | None
    """Samples per second, by the median of their distances."""
    edit: str
    """Path of the MotionEdit that it is a result of, "" for none."""
    source: str
    """Path of the SkelAnimation that it was made from, "" for none."""


@dataclass(frozen=True, slots=True)
class EditFacts:
    """One MotionEdit."""

    path: str
    skeleton: str
    source: str
    solver: str
    range: tuple[float, ...]
    """First and last time code; empty is all of the source."""
    sample_rate: float
    constraint_count: int
    options: tuple[str, ...]
    """Each as name=value."""
    ground: tuple[str, ...] = ()
    """Paths of the prims that its input is put on."""


@dataclass(frozen=True, slots=True)
class ConstraintFacts:
    """One constraint of an edit."""

    path: str
    type: str
    edit: str
    priority: int
    joint: str
    recruits: tuple[str, ...]
    """Empty: from its joint up to the root."""
    times: tuple[float, ...]
    goals: tuple[str, ...]
    """Name and mode of each."""
    solvable: bool
    """Whether something installed can solve such constraints."""


@dataclass(frozen=True, slots=True)
class DetectionFacts:
    """One MotionDetection: what was looked for on one joint or prim."""

    path: str
    object: str
    """The joint, or the path of the prim, that is looked at."""
    edit: str
    """Path of the MotionEdit whose constraints its contacts are, "" where they are data."""
    detector: str
    kinds: tuple[str, ...]
    contacts: int
    """How many contacts are switched on."""
    templates: int
    """How many of these are examples."""
    switched_off: int
    pattern: bool
    """Whether it carries a noise pattern."""


@dataclass(frozen=True, slots=True)
class ContactFacts:
    """One contact, detected or authored."""

    path: str
    kind: str
    target: str
    """The joint, or the path of the prim, that is held."""
    times: tuple[float, ...]
    template: bool


@dataclass(frozen=True, slots=True)
class Note:
    """Something that is as it may be, and that one should know."""

    path: str
    """Path of the prim."""
    sentence: str
    """What it leads to, and what would do."""


@dataclass(frozen=True, slots=True)
class Inspection:
    """What is on a stage."""

    file: str
    meters_per_unit: float
    up_axis: str
    time_codes_per_second: float
    frames_per_second: float
    start: float | None
    end: float | None
    default_prim: str
    skeletons: tuple[SkeletonFacts, ...]
    clips: tuple[ClipFacts, ...]
    edits: tuple[EditFacts, ...]
    constraints: tuple[ConstraintFacts, ...]
    detections: tuple[DetectionFacts, ...]
    contacts: tuple[ContactFacts, ...]
    faults: tuple[Fault, ...]
    notes: tuple[Note, ...]
