"""What a laboratory captures besides a skeleton: markers, rigid clusters, force plates, events."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from usdmotion.arrays import Bools, Floats, seal

if TYPE_CHECKING:
    from usdmotion.recording import Recording


@dataclass(frozen=True, eq=False)
class Markers:
    """Points that cameras followed; while they see one not, it stays where it was seen last."""

    labels: tuple[str, ...]
    """Name of each marker, unique."""
    positions: Floats
    """World positions [m], shape (frame_count, marker_count, 3); finite throughout."""
    seen: Bools
    """Where the position was measured, shape (frame_count, marker_count)."""

    def __post_init__(self) -> None:
        frames, count = len(self.positions), len(self.labels)
        _seal(self, "positions", frames, count, 3)
        object.__setattr__(self, "seen", seal(self.seen, frames, count, dtype="bool", name="seen"))


@dataclass(frozen=True, eq=False)
class Cluster:
    """Three or more markers on one rigid thing, and where that is."""

    name: str
    """What to call it: a valid prim name."""
    labels: tuple[str, ...]
    """The markers on it."""
    points: Floats
    """Where they are in its frame, whose origin is their mean [m], shape (label_count, 3)."""
    translations: Floats
    """World position [m], shape (frame_count, 3)."""
    rotations: Floats
    """World orientation, unit xyzw, shape (frame_count, 4)."""
    placed: Bools
    """Where enough markers were seen to tell, shape (frame_count,); between, it moves evenly."""
    residual: float = 0.0
    """Root mean square distance of its markers from where a rigid thing has them [m]."""

    def __post_init__(self) -> None:
        frames = len(self.translations)
        _seal(self, "points", len(self.labels), 3)
        _seal(self, "translations", frames, 3)
        _seal(self, "rotations", frames, 4)
        object.__setattr__(self, "placed", seal(self.placed, frames, dtype="bool", name="placed"))


@dataclass(frozen=True, eq=False)
class ForcePlate:
    """A plate in the floor, and what it pushed back with: world axes, on the body."""

    name: str
    """What to call it: a valid prim name."""
    corners: Floats
    """Corners of its upper face, in turn around it [m], shape (4, 3)."""
    times: Floats
    """Seconds from the first frame of the markers, ascending, shape (sample_count,)."""
    forces: Floats
    """Force on the body [N], shape (sample_count, 3)."""
    moments: Floats
    """Moment on the body about the middle of the upper face [N m], shape (sample_count, 3)."""
    centers: Floats
    """Centre of pressure [m], shape (sample_count, 3); while nothing loads the plate, the last."""
    loaded: Bools
    """Where the plate is loaded, so that there is a centre of pressure, shape (sample_count,)."""

    def __post_init__(self) -> None:
        count = len(self.times)
        _seal(self, "corners", 4, 3)
        _seal(self, "times", count)
        for name in ("forces", "moments", "centers"):
            _seal(self, name, count, 3)
        object.__setattr__(self, "loaded", seal(self.loaded, count, dtype="bool", name="loaded"))


@dataclass(frozen=True, slots=True)
class Event:
    """Something that happened at an instant, such as a heel that struck the ground."""

    label: str
    """What happened."""
    time: float
    """When [s], from the first frame; it may be outside of the clip."""
    context: str = ""
    """Whom or which side it is about, as the file says it: Left, Right, General."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Capture:
    """Everything of a file of captured markers; metres and seconds."""

    name: str
    """What to call it: a valid prim name."""
    up: Literal["Y", "Z"]
    """The axis that points up."""
    frame_rate: float
    """Frames of the markers per second."""
    times: Floats
    """Seconds of the frames, the first is 0, shape (frame_count,)."""
    markers: Markers
    clusters: tuple[Cluster, ...] = ()
    """Rigid things among the markers; a reader gives those that its file knows."""
    plates: tuple[ForcePlate, ...] = ()
    events: tuple[Event, ...] = ()
    """In the order of their times."""
    fitted: Recording | None = None
    """The skeleton that was fitted to the markers; a reader gives none."""
    notes: tuple[str, ...] = ()
    """One sentence about each thing that was noticed, decided or mended on the way."""

    def __post_init__(self) -> None:
        _seal(self, "times", len(self.markers.positions))

    @property
    def summary(self) -> str:
        """What it holds, in a few words."""
        counts = {
            "cluster": len(self.clusters),
            "force plate": len(self.plates),
            "event": len(self.events),
        }
        parts = [f"{len(self.times)} frames of {len(self.markers.labels)} markers"]
        parts += [f"{n} {what}{'s' * (n != 1)}" for what, n in counts.items() if n]
        if self.fitted is not None:
            parts.append(f"a skeleton of {len(self.fitted.skeleton.joints)} joints")
        return ", ".join(parts)


def _seal(value: object, name: str, *shape: int | None) -> None:
    object.__setattr__(value, name, seal(getattr(value, name), *shape, name=name))
