"""The set of 36 markers of OptiTrack's suits, told by what stands at Plug-in-Gait's places.

Its markers are on straps: around the hips and not on the iliac spines, behind the elbows and not
beside them. The places that the rest of the fit asks for are made of them by shares that are chosen
by eye; only the real markers are something that the body has to meet.
"""

import re
from collections.abc import Mapping, Sequence

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.fitting.landmarks import (
    ANKLE_WIDTH,
    ELBOW_WIDTH,
    SIDES,
    Landmarks,
    across,
    length,
    unit,
)

_CORE = re.compile(r"(?:.*_)?((?:Hip|Chest|Head|[LR](?:Shoulder|UArm|Hand|Thigh|Shin|Foot))\d)")
_WORN = {
    "Hips": ("Hip1", "Hip2", "Hip3", "Hip4"),
    "Spine1": ("Chest1", "Chest2", "Chest3"),
    "Head": ("Head1", "Head2", "Head3"),
}
_WORN_ASIDE = {
    "Shoulder": ("Shoulder1", "Shoulder2"),
    "Arm": ("UArm1", "UArm2"),
    "Hand": ("Hand1", "Hand2", "Hand3"),
    "UpLeg": ("Thigh1", "Thigh2"),
    "Leg": ("Shin1",),
    "Foot": ("Shin2", "Foot1", "Foot2"),
}
_THUMBS = {"L": ("Hand2", "Hand3"), "R": ("Hand3", "Hand2")}
"""On which side of a wrist its two markers are: thumb, little finger."""
_BELT, _SPINES = 0.15, 0.36
"""The iliac spines behind the front of a belt and beside its middle, over its depth and width."""
_ANKLE, _HEEL = 0.25, 0.15
"""The ankle from the back of the foot to its toes; the heel below that, over the shank."""
_OLECRANON = 0.04
"""The elbow's axis before the marker behind it [m]."""
_CAP, _EAR = 0.07, 0.07
"""A headband below the top of a cap, and half its width [m]."""


def cores(labels: Sequence[str]) -> dict[str, str]:
    """Return the labels of this set by their names in it; empty where it is another set."""
    found = {match[1]: label for label in labels if (match := _CORE.fullmatch(label))}
    needed = [*_WORN["Hips"], "LShoulder1", "RShoulder1"]
    needed += [side + mark for side in "LR" for mark in ("Thigh2", "Shin2", "Foot1", "Foot2")]
    return found if all(name in found for name in needed) else {}


def landmarks(markers: Mapping[str, Floats], up: Floats) -> Landmarks:
    """Return the landmarks of somebody in this set.

    Args:
        markers: Positions by the names of the set, NaN where not seen, (frame_count, 3) each.
        up: The direction away from the ground, shape (3,).
    """
    places = _pelvis(markers) | _head(markers, up)
    places["C7"] = 0.5 * (markers["LShoulder1"] + markers["RShoulder1"])
    left = unit(markers["Hip1"] - markers["Hip2"])
    for _, letter, sign in SIDES:
        own = {name[1:]: value for name, value in markers.items() if name.startswith(letter)}
        places |= {letter + name: value for name, value in _leg(own, sign * left).items()}
        shank = length(places[f"{letter}KNE"] - places[f"{letter}ANK"])
        half = 0.5 * ELBOW_WIDTH * shank
        places |= {letter + name: value for name, value in _arm(own, letter, sign, half).items()}
    worn = dict(_WORN)
    for side, letter, _ in SIDES:
        worn |= {
            side + joint: tuple(letter + n for n in names) for joint, names in _WORN_ASIDE.items()
        }
    frames = len(markers["Hip1"])
    return Landmarks(places | dict(markers), frames, worn)


def _pelvis(markers: Mapping[str, Floats]) -> dict[str, Floats]:
    left, right = markers["Hip1"], markers["Hip2"]
    aside, middle = left - right, 0.5 * (left + right)
    # Buckle and back of a belt are seldom in its middle.
    front, back = (
        end - ((end - middle) * unit(aside)).sum(axis=1, keepdims=True) * unit(aside)
        for end in (markers["Hip3"], markers["Hip4"])
    )
    spines = front + _BELT * (back - front)
    return {"LASI": spines + _SPINES * aside, "RASI": spines - _SPINES * aside, "SACR": back}


def _leg(own: Mapping[str, Floats], outwards: Floats) -> dict[str, Floats]:
    knee, back = own["Thigh2"], own["Shin2"]
    toe = 0.5 * (own["Foot1"] + own["Foot2"])
    ankle = back + _ANKLE * (toe - back)
    half = 0.5 * ANKLE_WIDTH * length(knee - back)
    return {
        "KNE": knee,
        "ANK": ankle + half * outwards,
        "HEE": back + _HEEL * (back - knee),
        "TOE": toe,
    }


def _arm(own: Mapping[str, Floats], letter: str, sign: float, half: float) -> dict[str, Floats]:
    if not {"UArm1", "Hand1", "Hand2", "Hand3"} <= own.keys():
        return {}
    thumb, little = _THUMBS[letter]
    shoulder, behind = own["Shoulder1"], own["UArm1"]
    line = unit(0.5 * (own[thumb] + own[little]) - shoulder)
    outwards = across(behind - shoulder, line)
    lateral = sign * np.cross(line, outwards)
    return {
        "SHO": shoulder,
        "ELB": behind - _OLECRANON * outwards + half * lateral,
        "WRA": own[thumb],
        "WRB": own[little],
        "FIN": own["Hand1"],
    }


def _head(markers: Mapping[str, Floats], up: Floats) -> dict[str, Floats]:
    """Return a headband under a cap that has a marker on top, one before and one on its right."""
    if not all(name in markers for name in _WORN["Head"]):
        return {}
    top, front, right = (markers[name] for name in _WORN["Head"])
    forward = unit(front - top)
    left = across(top - right, forward)
    above = np.cross(forward, left)
    # The one on the right is also lower; in the middle of the clip the head is not tilted aside.
    roll = np.arctan2(np.nanmedian(left @ up), np.nanmedian(above @ up))
    left, above = (
        np.cos(roll) * left - np.sin(roll) * above,
        np.sin(roll) * left + np.cos(roll) * above,
    )
    ahead, back = front - _CAP * above, top - _CAP * above
    return {
        "LFHD": ahead + _EAR * left,
        "RFHD": ahead - _EAR * left,
        "LBHD": back + _EAR * left,
        "RBHD": back - _EAR * left,
    }
