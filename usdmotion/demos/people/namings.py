"""What joints are called in the words of several tools, and in no words at all.

As USD has them: what is no letter, digit or underscore cannot be in the path of a joint.
"""

import re
from collections.abc import Sequence
from dataclasses import replace

from usdmotion.demos.body import Segment

NAMINGS = ("plain", "mixamorig", "h_anim", "blender", "unreal", "numbers")
"""Ways of naming joints. `numbers` says nothing: what is what is in the parts alone."""

_BLENDER = {
    "Hips": "hips",
    "Neck": "neck",
    "Head": "head",
    "Shoulder": "shoulder",
    "Arm": "upper_arm",
    "ForeArm": "forearm",
    "Hand": "hand",
    "UpLeg": "thigh",
    "Leg": "shin",
    "Foot": "foot",
    "ToeBase": "toe",
}
_UNREAL = {
    "Hips": "pelvis",
    "Neck": "neck_01",
    "Head": "head",
    "Shoulder": "clavicle",
    "Arm": "upperarm",
    "ForeArm": "lowerarm",
    "Hand": "hand",
    "UpLeg": "thigh",
    "Leg": "calf",
    "Foot": "foot",
    "ToeBase": "ball",
}
_TAKEN_APART = re.compile(r"(Left|Right)?(\D+?)(\d*)")


def renamed(segments: Sequence[Segment], naming: str) -> list[Segment]:
    """Return segments whose joints are called as somebody else calls them.

    Args:
        segments: By their plain names, parents before children.
        naming: One of `NAMINGS`.
    """
    names = {s.name: _called(s, index, naming) for index, s in enumerate(segments)}
    return [replace(s, name=names[s.name], parent=names.get(s.parent, "")) for s in segments]


def _called(segment: Segment, index: int, naming: str) -> str:
    """Return what a joint is called."""
    if naming == "mixamorig":
        return f"mixamorig_{segment.name}"
    if naming == "h_anim":
        return segment.part or segment.name
    if naming == "numbers":
        return f"joint{index:03d}"
    taken = _TAKEN_APART.fullmatch(segment.name)
    assert taken is not None
    side, word, number = taken[1] or "", taken[2], taken[3]
    if naming == "blender":
        counted = f"_{int(number):03d}" if number else ""
        return _worded(word, _BLENDER) + counted + (f"_{side[0]}" if side else "")
    if naming == "unreal":
        counted = (
            f"_{int(number or 0) + (word == 'Spine'):02d}" if number or word == "Spine" else ""
        )
        return _worded(word, _UNREAL) + counted + (f"_{side[0].lower()}" if side else "")
    return segment.name


def _worded(word: str, words: dict[str, str]) -> str:
    """Return a word of ours in theirs: `HandThumb` is `thumb`, `ForeArmTwist` `forearm_twist`."""
    if word.startswith("Hand") and word != "Hand":
        return word.removeprefix("Hand").lower()
    if word.endswith("Twist"):
        return f"{words[word.removesuffix('Twist')]}_twist"
    return words.get(word, word.lower())
