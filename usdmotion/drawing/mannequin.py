"""A body as capsules, seen from somewhere: plain polygons to be drawn from far to near."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Bools, Floats, Ints
from usdmotion.cast import Character
from usdmotion.drawing.eyes import Eye
from usdmotion.humanoid import PartMap
from usdmotion.humanoid.parts import LEG
from usdmotion.kernels import conjugate, forward, rotate

_GIRTHS = (
    ("skullbase", 0.115),
    ("humanoid_root", 0.085),
    ("sacroiliac", 0.085),
    ("hip", 0.085),
    ("knee", 0.06),
    ("talocrural", 0.042),
    ("sternoclavicular", 0.055),
    ("acromioclavicular", 0.055),
    ("shoulder", 0.052),
    ("elbow", 0.042),
    ("radiocarpal", 0.035),
    ("vc", 0.055),
    ("vt", 0.105),
    ("vl", 0.105),
    ("tars", 0.034),
    ("metatars", 0.034),
)
"""Thickness of what hangs on a part, in lengths of a leg; anything else is a finger or the like."""
_TRUNK = ("humanoid_root", "sacroiliac", "sternoclavicular", "acromioclavicular")
_THIN = 0.014
_ENDS = {"skullbase": 0.13, "radiocarpal": 0.2, "talocrural": 0.24, "metatarsophalangeal": 0.07}
"""How long the last segment of a part is that has no joint below it, in lengths of a leg."""
_FLANK = 0.1
"""Thickness of the trunk from hip to shoulder, in lengths of a leg."""
_FLANK_ENDS = ("hip", "shoulder")
_CORNERS = 9
"""Corners of either end of a capsule."""
_TAPER = 0.88
"""How thick a capsule is at its end, over its start."""


@dataclass(frozen=True, eq=False)
class Mannequin:
    """The capsules of one character."""

    nodes: list[int]
    """The joint that each hangs on, by its number in the character."""
    tips: list[int]
    """The joint at which each ends, -1 for one that ends in `ends`."""
    ends: Floats
    """Where it ends in its joint's frame [m], where it ends at no joint."""
    radii: Floats
    """Thickness [m], shape (capsule_count,)."""
    right: Bools
    """Which are of the right arm or leg, shape (capsule_count,)."""
    inner: Bools
    """Which are inside the trunk, where lines would only disturb, shape (capsule_count,)."""
    height: float
    """How tall the body is at rest, about [m]."""

    @classmethod
    def of(cls, character: Character) -> "Mannequin":
        """Return the mannequin of a character: a capsule for each segment below its root."""
        parts, chain = character.parts, character.skeleton.chain
        made = [*_segments(character), *_last_segments(character)]
        return cls(
            nodes=[each.joint for each in made],
            tips=[each.tip for each in made],
            ends=np.reshape([each.end for each in made], (len(made), 3)),
            radii=np.array([each.radius for each in made]),
            right=np.array([_is_right(parts, chain(each.joint)) for each in made], dtype=np.bool_),
            inner=np.array(
                [each.tip >= 0 and _is_trunk(parts, each.joint) for each in made], dtype=np.bool_
            ),
            height=2.1 * character.leg_length,
        )

    def capsules(self, positions: Floats, orientations: Floats) -> tuple[Floats, Floats]:
        """Return both ends of each capsule in a pose of the character's joints.

        Args:
            positions: World [m], shape (joint_count, 3).
            orientations: World, xyzw, shape (joint_count, 4).

        Returns:
            World [m], each of shape (capsule_count, 3).
        """
        starts = positions[self.nodes]
        free = starts + rotate(orientations[self.nodes], self.ends)
        tips = np.array(self.tips, dtype=np.int64)
        return starts, np.where(tips[:, None] < 0, free, positions[tips])


def outlines(eye: Eye, starts: Floats, ends: Floats, radii: Floats) -> tuple[Floats, Ints]:
    """Return capsules as polygons in the picture, the farthest first, and their order.

    Args:
        eye: From where they are seen.
        starts: World [m], shape (capsule_count, 3).
        ends: World [m], shape (capsule_count, 3).
        radii: Thickness at the start [m], shape (capsule_count,); the end is a bit thinner.

    Returns:
        Shape (capsule_count, corner_count, 2), and the order (capsule_count,) of the capsules.
    """
    order = np.argsort(eye.near(0.5 * (starts + ends)), kind="stable")
    starts, ends, radii = starts[order], ends[order], radii[order]
    first, last = eye.flat(starts), eye.flat(ends)
    along = last - first
    angle = np.arctan2(along[:, 1], along[:, 0])[:, None]
    half = np.linspace(-0.5 * np.pi, 0.5 * np.pi, _CORNERS)[None, :]
    ahead = np.stack([np.cos(angle + half), np.sin(angle + half)], axis=-1)
    behind = np.stack([np.cos(angle + np.pi + half), np.sin(angle + np.pi + half)], axis=-1)
    thick, thin = (
        (part * radii * eye.size(there))[:, None, None]
        for part, there in ((1.0, starts), (_TAPER, ends))
    )
    return np.concatenate([last[:, None] + thin * ahead, first[:, None] + thick * behind], 1), order


def facing(character: Character, positions: Floats, up: Floats) -> Floats:
    """Return where a body looks in a pose, level, of length one, shape (3,)."""
    parts = character.parts
    hips = [parts.joint(f"{side}_{LEG[0]}") for side in "lr"] if parts is not None else [None]
    if None in hips:
        level = positions - positions.mean(axis=0)
        level = level - np.outer(level @ up, up)
        across = np.linalg.svd(level)[2][0]
    else:
        left, right = (positions[joint] for joint in hips)
        across = left - right
    ahead = np.cross(across, up)
    length = np.linalg.norm(ahead)
    if length < 1e-9:
        ahead = np.cross(np.eye(3)[np.abs(up).argmin()], up)
        length = np.linalg.norm(ahead)
    return np.asarray(ahead / length)


def _plain(part: str) -> str:
    """Return the name of a part without its side."""
    return part[2:] if part[:2] in ("l_", "r_") else part


@dataclass(frozen=True, eq=False)
class _Capsule:
    """One capsule: from a joint to another, or to a point of its own frame."""

    joint: int
    tip: int
    end: Floats
    radius: float


def _segments(character: Character) -> Iterator[_Capsule]:
    """Yield a capsule from joint to joint, and the flanks from hip to shoulder."""
    skeleton, parts, leg = character.skeleton, character.parts, character.leg_length
    head = parts.joint("skullbase") if parts is not None else None
    pelvis = _pelvis(character)
    for joint in _below(character):
        parent = int(skeleton.parents[joint])
        length = float(np.linalg.norm(skeleton.rest_translations[joint]))
        # What is in a face is drawn as the head.
        if joint != pelvis and length > 1e-4 and head not in skeleton.chain(parent):
            radius = _radius(parts, skeleton.chain(parent), leg, length)
            yield _Capsule(parent, joint, np.zeros(3), radius)
    for side in "lr" if parts is not None else "":
        hip, shoulder = (parts.joint(f"{side}_{each}") if parts else None for each in _FLANK_ENDS)
        if hip is not None and shoulder is not None:
            yield _Capsule(hip, shoulder, np.zeros(3), _FLANK * leg)


def _last_segments(character: Character) -> Iterator[_Capsule]:
    """Yield the capsules of heads, hands and feet beyond their last joints."""
    skeleton, parts, leg = character.skeleton, character.parts, character.leg_length
    for joint in _below(character) if parts is not None else ():
        part = _plain(parts.parts[joint]) if parts is not None else ""
        if part in _ENDS and (part == "skullbase" or joint not in skeleton.parents):
            way = _ahead if part == "talocrural" else _onward
            end = _ENDS[part] * leg * way(character, joint)
            yield _Capsule(joint, -1, end, _radius(parts, (joint,), leg, np.inf))


def _pelvis(character: Character) -> int:
    known = character.parts.pelvis if character.parts is not None else None
    return character.root if known is None else known


def _below(character: Character) -> list[int]:
    """Return the pelvis and what hangs on it."""
    skeleton, pelvis = character.skeleton, _pelvis(character)
    return [joint for joint in range(len(skeleton.joints)) if pelvis in skeleton.chain(joint)]


def _is_right(parts: PartMap | None, chain: tuple[int, ...]) -> bool:
    return parts is not None and any(parts.parts[joint].startswith("r_") for joint in chain)


def _is_trunk(parts: PartMap | None, joint: int) -> bool:
    part = parts.parts[joint] if parts is not None else ""
    return part[:2] in ("vl", "vt", "vc") or _plain(part) in _TRUNK


def _radius(parts: PartMap | None, chain: tuple[int, ...], leg: float, length: float) -> float:
    """Return how thick a segment is by the nearest known part above it."""
    named = [_plain(parts.parts[joint]) for joint in chain if parts.parts[joint]] if parts else []
    if not named:
        return min(0.2 * length, 0.05 * leg)
    girth = next((girth for part, girth in _GIRTHS if named[0].startswith(part)), _THIN)
    return min(girth * leg, max(0.45 * length, _THIN * leg))


def _onward(character: Character, joint: int) -> Floats:
    """Return in which direction of a joint's frame its segment goes on, as it came, at rest."""
    positions, orientations = _rest(character)
    parent = int(character.skeleton.parents[joint])
    way = positions[joint] - positions[parent] if parent >= 0 else np.array((0.0, 1.0, 0.0))
    length = float(np.linalg.norm(way))
    return np.asarray(rotate(conjugate(orientations[joint]), way / max(length, 1e-9)))


def _ahead(character: Character, joint: int) -> Floats:
    """Return in which direction of an ankle's frame the toes are, at rest, were there any."""
    positions, orientations = _rest(character)
    chain = character.skeleton.chain(joint)
    up = positions[chain[2]] - positions[joint] if len(chain) > 2 else np.array((0.0, 1.0, 0.0))
    up = up / max(float(np.linalg.norm(up)), 1e-9)
    way = facing(character, positions, up) - 0.25 * up
    return np.asarray(rotate(conjugate(orientations[joint]), way))


def _rest(character: Character) -> tuple[Floats, Floats]:
    skeleton = character.skeleton
    rest = skeleton.rest_translations[None], skeleton.rest_rotations[None]
    positions, orientations = forward(skeleton.parents, *rest)
    return positions[0], orientations[0]
