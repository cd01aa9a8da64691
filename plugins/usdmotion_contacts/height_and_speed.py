"""Contacts where an object is low and slow (2005, section 3, after Menardais et al. 2004)."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from usdmotion import Bools, Contact, Detected, Floats, OptionError, Search, option
from usdmotion.kernels import chordal_mean, rotate

LOW = 0.05
"""Which share of the heights of an object is beneath where it stands: a few are outliers."""


@dataclass(frozen=True)
class HeightAndSpeed:
    """Holds an object while it is near the ground and moves slowly.

    Nothing is smoothed and nothing bridged: a frame is held or not for itself. So it needs a flat
    ground that is known, or that the object touches somewhere in the clip, and a motion without
    much noise, which derivatives amplify.
    """

    name: ClassVar[str] = "height_and_speed"

    height: float = option(0.05, "How far above the ground counts as on it [m].", minimum=0.0)
    speed: float = option(0.4, "How fast counts as standing [m/s].", minimum=0.0)

    def detect(self, search: Search) -> Detected:
        """Return a space contact for each stretch of frames on which the object is low and slow.

        Raises:
            OptionError: Something else than space is looked for.
        """
        others = [kind for kind in search.kinds if kind != "space"]
        if others:
            raise OptionError(f"'{self.name}' finds no kind '{others[0]}'; it finds: space")
        held = low_and_slow(search, self.height, self.speed)
        contacts = tuple(_contact(search, each) for each in _stretches(held))
        long = tuple(each for each in contacts if each.end - each.start >= search.minimum)
        reason = f"'{self.name}' learns from none"
        left_out = dict.fromkeys(search.templates, reason)
        return Detected(long, notes=_notes(search), left_out=left_out)


def low_and_slow(search: Search, height: float, speed: float) -> Bools:
    """Return the frames on which an object is under both thresholds, shape (frame_count,).

    Args:
        search: The object.
        height: Of its lowest point above the ground [m].
        speed: Of its slowest point [m/s].
    """
    heights, speeds = heights_and_speeds(search)
    return np.asarray((heights <= height) & (speeds <= speed))


def heights_and_speeds(search: Search) -> tuple[Floats, Floats]:
    """Return how high an object is above the ground, and how fast.

    The height is that of the lowest of its points, the speed that of the slowest: of a foot that
    rolls from the heel to the toes, one end stands. Where nobody knows the ground it is as low as
    the object seldom is beneath.

    Returns:
        Metres and metres per second, each of shape (frame_count,).
    """
    places = search.translations[:, None] + rotate(search.rotations[:, None], search.points)
    heights = (places @ search.up).min(axis=1)
    ground = search.ground if np.isfinite(search.ground) else np.quantile(heights, LOW)
    if len(search.times) < 2:
        return heights - ground, np.zeros(len(heights))
    velocities = np.gradient(places, search.times, axis=0)
    return heights - ground, np.linalg.norm(velocities, axis=2).min(axis=1)


def _contact(search: Search, stretch: slice) -> Contact:
    """Return the contact that holds the mean of some poses."""
    places, turns = search.translations[stretch], search.rotations[stretch]
    location = places.mean(axis=0)
    return Contact(
        kind="space",
        start=float(search.times[stretch][0]),
        end=float(search.times[stretch][-1]),
        point=np.zeros(3),
        location=location,
        orientation=chordal_mean(turns, np.ones(len(turns))),
        residual=float(np.linalg.norm(places - location, axis=1).max()),
    )


def _stretches(held: Bools) -> list[slice]:
    edges = np.diff(np.pad(held.astype(np.int8), 1))
    pairs = zip(np.flatnonzero(edges > 0), np.flatnonzero(edges < 0), strict=True)
    return [slice(int(first), int(end)) for first, end in pairs]


def _notes(search: Search) -> tuple[str, ...]:
    if np.isfinite(search.ground):
        return ()
    return (
        f"nobody says where the ground under {search.name} is: "
        "it is taken to be where the object is lowest",
    )
