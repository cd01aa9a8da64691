"""Where each segment of a body is and how it is turned, told from its markers frame by frame.

A segment's axes are those that the body has in a T-pose: x to its left, y up, z forward.
"""

from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.fitting import landmarks as at
from usdmotion.fitting.landmarks import SIDES, Landmarks, across, length, unit

X, Y, Z = np.eye(3)
_COLLAR = 0.12
"""Where a shoulder girdle begins, from the neck to the shoulder; chosen by eye."""
_HAND = 0.74
"""Length of a hand that has no marker, over that of the forearm: 0.108 and 0.146 of the height
(Winter, "Biomechanics and Motor Control of Human Movement", 2009, figure 4.1)."""


@dataclass(frozen=True, eq=False)
class Segment:
    """A joint and what hangs on it."""

    name: str
    parent: str
    """Name of the joint above it; "" for the root."""
    origins: Floats
    """Where the joint is [m], NaN where nobody knows, shape (frame_count, 3)."""
    axes: Floats
    """Directions of its x, y and z as columns, likewise, shape (frame_count, 3, 3)."""
    markers: tuple[str, ...] = ()
    """Plug-in-Gait names of the markers that ride on it."""
    end: Floats | None = None
    """Where it ends freely over time, shape (frame_count, 3); None where a joint is there."""


def axes_of(first: Floats, second: Floats, rest_first: Floats, rest_second: Floats) -> Floats:
    """Return the turn that brings two directions of the T-pose to where they are now.

    Args:
        first: Where the first one is now: exactly, shape (frame_count, 3).
        second: Where the second one is now: as far as it is across the first.
        rest_first: The first one in the T-pose, shape (3,).
        rest_second: The second one.
    """
    now, rest = _basis(first, second), _basis(rest_first[None], rest_second[None])[0]
    return np.asarray(now @ rest.T)


def _basis(first: Floats, second: Floats) -> Floats:
    one, other = unit(first), across(second, first)
    return np.stack([one, other, np.cross(one, other)], axis=-1)


def levelled(axes: Floats, up: Floats) -> Floats:
    """Return axes tilted by one angle for all frames, so that y is upright in the middle of them.

    What a segment's markers have for forward depends on where they were glued on.
    """
    heights = axes.transpose(0, 2, 1) @ up
    tilt = float(np.arctan2(np.nanmedian(heights[:, 2]), np.nanmedian(heights[:, 1])))
    c, s = np.cos(tilt), np.sin(tilt)
    return np.asarray(axes @ np.array(((1.0, 0.0, 0.0), (0.0, c, -s), (0.0, s, c))))


def segments_of_body(marks: Landmarks, up: Floats) -> list[Segment]:
    """Return the segments of a body that its markers show, parents before their children."""
    hips = at.hips(marks)
    left, upwards, _ = at.pelvis_axes(marks)
    pelvis = Segment(
        "Hips",
        "",
        0.5 * (hips["Left"] + hips["Right"]),
        levelled(axes_of(left, upwards, X, Y), up),
        ("LASI", "RASI", "LPSI", "RPSI", "SACR"),
    )
    found = [pelvis]
    if marks.has("C7", "LSHO", "RSHO"):
        found += _trunk(marks, pelvis, up)
    for side, letter, sign in SIDES:
        found += _leg(marks, hips[side], (side, letter, sign), up)
    return found


def _leg(marks: Landmarks, hip: Floats, names: tuple[str, str, float], up: Floats) -> list[Segment]:
    side, letter, sign = names
    knee_mark, ankle_mark = marks[f"{letter}KNE"], marks[f"{letter}ANK"]
    shank = length(knee_mark - ankle_mark)
    aside = at.outwards_of(marks, hip, f"{letter}THI", f"{letter}KNE", sign)
    knee = at.beside(hip, knee_mark, aside, 0.5 * at.KNEE_WIDTH * shank)
    below = at.outwards_of(marks, knee, f"{letter}TIB", f"{letter}ANK", sign)
    ankle = at.beside(knee, ankle_mark, below, 0.5 * at.ANKLE_WIDTH * shank)
    toe, heel = marks[f"{letter}TOE"], marks[f"{letter}HEE"]
    outer, lower = sign * (knee_mark - knee), sign * (ankle_mark - ankle)
    upper_axes = axes_of(knee - hip, outer, -Y, X)
    lower_axes = axes_of(ankle - knee, lower, -Y, X)
    foot_axes = axes_of(toe - heel, knee - ankle, Z, Y)
    if not marks.has(f"{letter}HEE"):
        foot_axes = levelled(axes_of(toe - ankle, knee - ankle, Z, Y), up)
    upper, shin, foot = f"{side}UpLeg", f"{side}Leg", f"{side}Foot"

    def own(*names: str) -> tuple[str, ...]:
        return tuple(letter + name for name in names)

    return [
        Segment(upper, "Hips", hip, upper_axes, own("THI", "KNE")),
        Segment(shin, upper, knee, lower_axes, own("TIB", "ANK")),
        Segment(foot, shin, ankle, foot_axes, own("HEE", "TOE"), toe),
    ]


def _trunk(marks: Landmarks, pelvis: Segment, up: Floats) -> list[Segment]:
    acromia = marks["LSHO"] - marks["RSHO"]
    lumbar = at.lumbar(marks)
    # The neck is between the collar bones and the seventh vertebra.
    neck = marks.mean("C7", "CLAV")
    middle = marks.mean("T10", "STRN") if marks.has("T10", "STRN") else 0.5 * (neck + lumbar)
    chest_axes = levelled(axes_of(neck - middle, acromia, Y, X), up)
    forward = unit(pelvis.axes[..., 2]) + unit(chest_axes[..., 2])
    chest = "Spine1"
    markers = ("C7", "T10", "CLAV", "STRN", "RBAK", "LBAK")
    found = [
        Segment("Spine", "Hips", lumbar, axes_of(middle - lumbar, forward, Y, Z)),
        Segment(chest, "Spine", middle, chest_axes, markers),
    ]
    if marks.has("LFHD", "RFHD", "LBHD", "RBHD"):
        found += _head(marks, neck, chest_axes, up)
    drop = at.SHOULDER_DROP * length(acromia)
    for side, letter, sign in SIDES:
        if marks.has(f"{letter}SHO", f"{letter}ELB") and _wrist_marks(marks, letter):
            shoulder = marks[f"{letter}SHO"] - drop * chest_axes[..., 1]
            collar = neck + _COLLAR * (shoulder - neck)
            found += _arm(marks, collar, shoulder, chest_axes, (side, letter, sign))
    return found


def _head(marks: Landmarks, neck: Floats, chest_axes: Floats, up: Floats) -> list[Segment]:
    front, back = marks.mean("LFHD", "RFHD"), marks.mean("LBHD", "RBHD")
    left = marks.mean("LFHD", "LBHD") - marks.mean("RFHD", "RBHD")
    head_axes = levelled(axes_of(left, front - back, X, Z), up)
    base = at.skull_base(marks)
    forward = head_axes[..., 2] + chest_axes[..., 2]
    top = 0.5 * (front + back) + 0.5 * length(front - back) * head_axes[..., 1]
    return [
        Segment("Neck", "Spine1", neck, axes_of(base - neck, forward, Y, Z)),
        Segment("Head", "Neck", base, head_axes, ("LFHD", "RFHD", "LBHD", "RBHD"), top),
    ]


def _wrist_marks(marks: Landmarks, letter: str) -> tuple[str, ...]:
    names = (f"{letter}WRA", f"{letter}WRB", f"{letter}WRI")
    return tuple(name for name in names if marks.has(name))


def _arm(
    marks: Landmarks,
    collar: Floats,
    shoulder: Floats,
    chest_axes: Floats,
    names: tuple[str, str, float],
) -> list[Segment]:
    side, letter, sign = names
    wrist = marks.mean(*_wrist_marks(marks, letter))
    mark = marks[f"{letter}ELB"]
    half = 0.5 * at.ELBOW_WIDTH * length(marks[f"{letter}KNE"] - marks[f"{letter}ANK"])
    elbow = at.elbow(shoulder, mark, wrist, half, sign)
    upper, fore = elbow - shoulder, wrist - elbow
    along = sign * X
    # The axis of the elbow is upright in a T-pose, its lateral end above.
    upper_axes = axes_of(upper, mark - elbow, along, Y)
    thumb = marks[f"{letter}WRA"] - marks[f"{letter}WRB"]
    turned = marks.has(f"{letter}WRA", f"{letter}WRB")
    fore_axes = axes_of(fore, thumb if turned else upper_axes[..., 1], along, Z if turned else Y)
    finger = marks[f"{letter}FIN"]
    seen = marks.has(f"{letter}FIN") and turned
    hand_axes = axes_of(finger - wrist, thumb, along, Z) if seen else fore_axes
    tip = finger if seen else wrist + _HAND * fore

    def own(*marks_of: str) -> tuple[str, ...]:
        return tuple(letter + name for name in marks_of)

    girdle, arm, forearm = f"{side}Shoulder", f"{side}Arm", f"{side}ForeArm"
    girdle_axes = axes_of(shoulder - collar, chest_axes[..., 1], along, Y)
    return [
        Segment(girdle, "Spine1", collar, girdle_axes, own("SHO")),
        Segment(arm, girdle, shoulder, upper_axes, own("UPA", "ELB")),
        Segment(forearm, arm, elbow, fore_axes, own("FRA", "WRA", "WRB", "WRI")),
        Segment(f"{side}Hand", forearm, wrist, hand_axes, own("FIN"), tip),
    ]
