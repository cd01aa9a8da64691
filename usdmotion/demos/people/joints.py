"""The segments of a body with as many vertebrae and finger joints as one likes, and twist joints.

Places are fractions of the height, in the T-pose, as in `body`. The fingers are chosen by eye.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.demos.body import SEGMENTS, Segment

_TRUNK = ("Spine", "Spine1", "Spine2")
_VERTEBRAE = ("vl5", "vl3", "vl1", "vt12", "vt10", "vt8", "vt6", "vt4", "vt2")
_FINGERS = {
    # Name: ahead of the middle of the hand, from the wrist out, length of its joints.
    "Thumb": (0.017, 0.016, 0.020),
    "Index": (0.013, 0.052, 0.0155),
    "Middle": (0.004, 0.054, 0.017),
    "Ring": (-0.005, 0.052, 0.0155),
    "Pinky": (-0.013, 0.048, 0.012),
}
_LIMBS_THAT_TWIST = ("Arm", "ForeArm", "UpLeg")
MOST_VERTEBRAE = len(_VERTEBRAE)
"""How many vertebrae a back may have."""
MOST_FINGER_JOINTS = 3
"""How many joints a finger may have."""


def segments(*, vertebrae: int, finger_joints: int, twists: bool) -> list[Segment]:
    """Return the segments of a usual body, parents before children.

    Args:
        vertebrae: How many joints the back has, 1 to 9.
        finger_joints: How many each finger has, 0 to 3.
        twists: Whether upper arms, forearms and thighs have a joint for their twist.
    """
    top = "Spine" if vertebrae == 1 else f"Spine{vertebrae - 1}"
    built: list[Segment] = []
    for segment in SEGMENTS:
        if segment.name in _TRUNK:
            built += _back(vertebrae) if segment.name == _TRUNK[0] else []
            continue
        built.append(replace(segment, parent=top) if segment.parent == _TRUNK[-1] else segment)
        side = next((each for each in ("Left", "Right") if segment.name.startswith(each)), "")
        if twists and segment.name.removeprefix(side) in _LIMBS_THAT_TWIST:
            built.append(_twist(segment))
        if segment.name == f"{side}Hand":
            built += _fingers(segment, finger_joints)
    return built


def _back(count: int) -> list[Segment]:
    """Return so many vertebrae; what weighs hangs on the highest that is not above it."""
    usual = [segment for segment in SEGMENTS if segment.name in _TRUNK]
    if count == len(usual):
        return usual
    corners = np.array([*(s.place for s in usual), usual[-1].end])
    shares = np.linspace(0.0, len(usual), count + 1)
    places = np.stack(
        [np.interp(shares, np.arange(len(corners)), column) for column in corners.T], axis=-1
    )
    names = ["Spine", *(f"Spine{index}" for index in range(1, count))]
    parts = [_VERTEBRAE[round(each)] for each in np.linspace(0, len(_VERTEBRAE) - 1, count)]
    weights = _weights(usual, places)
    return [
        Segment(
            name,
            "Hips" if index == 0 else names[index - 1],
            parts[index],
            _triple(places[index]),
            _triple(places[index + 1]),
            0.057,
            *weights[index],
        )
        for index, name in enumerate(names)
    ]


def _weights(usual: Sequence[Segment], places: Floats) -> list[tuple[float, float]]:
    """Return the mass and the share at which it is of each vertebra."""
    masses, moments = np.zeros(len(places) - 1), np.zeros(len(places) - 1)
    for segment in usual:
        height = np.interp(segment.mass_center, (0, 1), (segment.place[1], segment.end[1]))
        vertebra = int(np.searchsorted(places[1:-1, 1], height, side="right"))
        masses[vertebra] += segment.mass
        moments[vertebra] += segment.mass * height
    heights = np.where(masses > 0.0, moments / np.where(masses > 0.0, masses, 1.0), places[:-1, 1])
    shares = (heights - places[:-1, 1]) / np.diff(places[:, 1])
    return [(float(mass), float(share)) for mass, share in zip(masses, shares, strict=True)]


def _twist(limb: Segment) -> Segment:
    """Return the joint in the middle of a segment, which nothing hangs on."""
    middle = 0.5 * np.add(limb.place, limb.end)
    return Segment(f"{limb.name}Twist", limb.name, "", _triple(middle), limb.end, 0.0)


def _fingers(hand: Segment, joints: int) -> list[Segment]:
    """Return five fingers of so many joints each."""
    side, prefix = np.sign(hand.place[0]), hand.part[0]
    built = []
    for digit, (name, (ahead, out, length)) in enumerate(_FINGERS.items(), start=1):
        way = np.array((side, 0.0, 0.6)) / np.hypot(1.0, 0.6) if digit == 1 else (side, 0.0, 0.0)
        places = np.add(hand.place, (side * out, 0.0, ahead)) + np.outer(
            np.arange(joints + 1) * length, way
        )
        for index, part in enumerate(_finger_parts(digit)[:joints]):
            own = f"{hand.name}{name}"
            parent = hand.name if index == 0 else f"{own}{index}"
            ends = _triple(places[index]), _triple(places[index + 1])
            built.append(Segment(f"{own}{index + 1}", parent, f"{prefix}_{part}", *ends, 0.005))
    return built


def _finger_parts(digit: int) -> tuple[str, str, str]:
    """Return the parts of a finger from the palm out, without their side."""
    if digit == 1:
        return ("carpometacarpal_1", "metacarpophalangeal_1", "carpal_interphalangeal_1")
    return (
        f"metacarpophalangeal_{digit}",
        f"carpal_proximal_interphalangeal_{digit}",
        f"carpal_distal_interphalangeal_{digit}",
    )


def _triple(place: Floats | tuple[float, ...]) -> tuple[float, float, float]:
    x, y, z = (float(each) for each in place)
    return x, y, z
