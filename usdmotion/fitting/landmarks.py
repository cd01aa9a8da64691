"""Where the joints of a body are, told from the markers on its skin.

Hip joints: Harrington, Zavatsky, Lawson, Yuan & Theologis, "Prediction of the hip joint centre in
adults, children, and patients with cerebral palsy based on magnetic resonance imaging", Journal of
Biomechanics 40 (2007), the equations of pelvic width and depth. Knees and ankles: half a joint's
width inwards from their lateral markers, as the chord of Davis, Õunpuu, Tyburski & Gage, "A gait
analysis data collection and reduction technique", Human Movement Science 10 (1991). Shoulder
joints: 17 % of the distance between the acromia below them (Rab, Petuskey & Bagley, "A method for
determination of upper extremity kinematics", Gait & Posture 15 (2002)). What those leave open is
chosen by eye: the widths of knee, ankle and elbow as shares of the shank, where the lumbar spine
begins, and the base of the skull under a headband.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from usdmotion.arrays import Floats

KNEE_WIDTH, ANKLE_WIDTH, ELBOW_WIDTH = 0.26, 0.18, 0.19
"""Widths of joints with a marker beside them, over the length of the shank."""
SHOULDER_DROP = 0.17
"""Shoulder joint below the acromion, over the distance between the acromia."""
_LUMBAR = 0.35
"""Where the lumbar spine begins, from the back of the pelvis to its front."""
_SKULL = 0.45
"""Base of the skull below a headband, over the length of the head from back to front."""
SIDES = (("Left", "L", 1.0), ("Right", "R", -1.0))
"""Name, letter, and the sign of the direction to the left."""


@dataclass(frozen=True, eq=False)
class Landmarks:
    """Places on a body over time, NaN where nobody knows, shape (frame_count, 3) each."""

    markers: Mapping[str, Floats]
    """Markers by their Plug-in-Gait names, and by their own where these are others."""
    frame_count: int
    worn: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """The markers on each segment by its name; empty: those of Plug-in-Gait."""

    def __getitem__(self, name: str) -> Floats:
        """Return where a marker is."""
        found = self.markers.get(name)
        return np.full((self.frame_count, 3), np.nan) if found is None else found

    def mean(self, *names: str) -> Floats:
        """Return the mean of those markers that are there."""
        present = [name for name in names if name in self.markers]
        return np.asarray(np.mean([self[name] for name in present or names], axis=0))

    def has(self, *names: str) -> bool:
        """Tell whether all of these markers were ever seen."""
        return all(name in self.markers for name in names)


def unit(vectors: Floats) -> Floats:
    """(…, 3) to (…, 3)."""
    return np.asarray(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))


def across(vectors: Floats, axis: Floats) -> Floats:
    """Return unit vectors along the part of some that is perpendicular to an axis, (…, 3)."""
    along = unit(axis)
    return unit(vectors - (vectors * along).sum(axis=-1, keepdims=True) * along)


def length(vectors: Floats) -> float:
    """Return the usual length of a vector over time."""
    found = np.linalg.norm(vectors, axis=-1)
    return float(np.median(found[np.isfinite(found)])) if np.isfinite(found).any() else np.nan


def pelvis_axes(marks: Landmarks) -> tuple[Floats, Floats, Floats]:
    """Return the directions to the left, up and forward of the pelvis."""
    left = unit(marks["LASI"] - marks["RASI"])
    front, back = marks.mean("LASI", "RASI"), marks.mean("LPSI", "RPSI", "SACR")
    forward = across(front - back, left)
    return left, np.cross(forward, left), forward


def hips(marks: Landmarks) -> dict[str, Floats]:
    """Return the hip joints by side (Harrington 2007, table 4; in millimetres there)."""
    left, up, forward = pelvis_axes(marks)
    front, back = marks.mean("LASI", "RASI"), marks.mean("LPSI", "RPSI", "SACR")
    width, depth = length(marks["LASI"] - marks["RASI"]), length(front - back)
    behind, below = 0.24 * depth + 0.0099, 0.30 * width + 0.0109
    aside = 0.33 * width + 0.0073
    return {
        side: front - behind * forward - below * up + sign * aside * left for side, _, sign in SIDES
    }


def lumbar(marks: Landmarks) -> Floats:
    """Return where the spine leaves the pelvis."""
    front, back = marks.mean("LASI", "RASI"), marks.mean("LPSI", "RPSI", "SACR")
    return back + _LUMBAR * (front - back)


def beside(start: Floats, marker: Floats, outwards: Floats, half: float) -> Floats:
    """Return the joint beside a lateral marker: the chord of Davis et al.

    Args:
        start: The joint before it.
        marker: On the joint's axis, on its outer side.
        outwards: Roughly the direction from the joint to the marker.
        half: Half the width of the joint [m].
    """
    back = start - marker
    share = half / np.linalg.norm(back, axis=-1, keepdims=True)
    inwards = -across(outwards, back)
    return np.asarray(marker + half * (share * unit(back) + np.sqrt(1.0 - share**2) * inwards))


def outwards_of(marks: Landmarks, start: Floats, wand: str, marker: str, side: float) -> Floats:
    """Return the outer side of a leg: where a wand is, or that of the pelvis without one."""
    left, _, _ = pelvis_axes(marks)
    if not marks.has(wand):
        return side * left
    plane = marks[wand] - start
    return across(plane, marks[marker] - start)


def elbow(shoulder: Floats, marker: Floats, wrist: Floats, half: float, side: float) -> Floats:
    """Return the elbow, inwards from its lateral marker along the axis of the joint.

    Upper arm and forearm are across that axis, and so is the line from shoulder to wrist. Seen
    along this line the marker is half a width from the elbow, the elbow as far from the line as the
    arm is bent, at a right angle: so the angle between marker and axis is known. Of the two ways
    round, the one is right with which the arm bends forward. A straight arm is the limit of it.

    Args:
        shoulder: The shoulder joint.
        marker: On the lateral epicondyle.
        wrist: The wrist.
        half: Half the width of the elbow [m].
        side: 1 of the left arm, -1 of the right.
    """
    line, out = unit(wrist - shoulder), marker - shoulder
    towards = across(out, line)
    away = (out * towards).sum(axis=1, keepdims=True)
    cosine = np.minimum(half / away, 1.0)
    axis = cosine * towards + side * np.sqrt(1.0 - cosine**2) * np.cross(line, towards)
    return np.asarray(marker - half * axis)


def skull_base(marks: Landmarks) -> Floats:
    """Return where the head turns on the neck, under a band with four markers."""
    front, back = marks.mean("LFHD", "RFHD"), marks.mean("LBHD", "RBHD")
    left = marks.mean("LFHD", "LBHD") - marks.mean("RFHD", "RBHD")
    up = unit(np.cross(front - back, left))
    return 0.5 * (front + back) - _SKULL * length(front - back) * up
