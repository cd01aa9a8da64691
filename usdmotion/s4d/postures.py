"""How the parts of a body are turned in the world by a normalized motion."""

from collections.abc import Callable, Iterable, Mapping, Sequence

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.errors import SceneError
from usdmotion.humanoid import NECK, PARTS, SPINE
from usdmotion.kernels import conjugate, multiply
from usdmotion.s4d.bodies.anatomy import basis
from usdmotion.s4d.bodies.places import ENDS, FINGERS, MIDDLES, ROOT, TOPS, carrier
from usdmotion.s4d.chains import cut_neck, cut_row, cut_spine
from usdmotion.s4d.normalized import NormalizedMotion
from usdmotion.s4d.turns import continuous

_HEAD = "skullbase"


class Postures:
    """The parts of the normalized skeleton, each turned as seen from the world, y up.

    Raises:
        SceneError: Some that every body has are missing.
    """

    def __init__(self, normalized: NormalizedMotion) -> None:
        require_whole(normalized)
        self.normalized = normalized
        self.limbs: dict[str, Floats] = {}
        """Frame of each limb by its top, (F, 4)."""
        self._turned = {
            ROOT: multiply(normalized.root_heading, normalized.root_orientation),
        }
        limbs = list(normalized.limbs)
        for part in (part for part in PARTS if part in (*normalized.segments, *limbs)):
            if part in limbs:
                above = self._turned[carrier(part, normalized.segments)]
                frame = multiply(above, normalized.limb_frames[:, limbs.index(part)])
                self.limbs[part] = frame
                self._turned[part] = multiply(frame, conjugate(basis(part)))
            else:
                self._turned[part] = self._segment(part)

    def _segment(self, part: str) -> Floats:
        normalized = self.normalized
        present = normalized.limbs if part in ENDS else normalized.segments
        own = normalized.segment_rotations[:, normalized.segments.index(part)]
        return multiply(self._turned[carrier(part, present)], own)

    def on(
        self, parts: Iterable[str], spine: Floats, at_rest: Callable[[str, str], Floats]
    ) -> dict[str, Floats]:
        """Return how the parts of a body are turned, all but knees and elbows, each (F, 4).

        Chains with other joint counts are cut anew; what the motion does not know rests on what
        carries it.

        Args:
            parts: Those of the body.
            spine: From its pelvis to the first vertebra, from one to the next, and on to the neck;
                shape (vertebra_count + 1,).
            at_rest: Returns how a part rests on another, xyzw, shape (4,).
        """
        known = set(parts)
        own = [part for part in PARTS if part in known]
        found = self._spine(own, spine) | self._neck(own)
        for row in FINGERS:
            found |= self._finger(row, own)
        for part in (part for part in own if part not in found):
            if part in self._turned:
                found[part] = self._turned[part]
        for part in (part for part in own if part not in found and part not in MIDDLES):
            above = carrier(part, own)
            found[part] = multiply(found[above], at_rest(part, above))
        return found

    def _spine(self, own: Sequence[str], lengths: Floats) -> dict[str, Floats]:
        theirs = self._known(SPINE)
        wanted = [part for part in SPINE if part in own]
        if len(theirs) == len(wanted):
            return self._in_order(theirs, wanted)
        pelvis = self._turned[ROOT][:, None]
        seen = multiply(conjugate(pelvis), self._stack(theirs))
        cut = cut_spine(self.normalized.spine, seen, lengths)
        return dict(zip(wanted, np.moveaxis(multiply(pelvis, cut), 1, 0), strict=True))

    def _neck(self, own: Sequence[str]) -> dict[str, Floats]:
        theirs = self._known(NECK)
        wanted = [part for part in NECK if part in own]
        if len(theirs) == len(wanted):
            return self._in_order(theirs, wanted)
        nodes = self._stack([self._known(SPINE)[-1], *theirs, _HEAD])
        return dict(zip(wanted, np.moveaxis(cut_neck(nodes, len(wanted)), 1, 0), strict=True))

    def _finger(self, row: Sequence[str], own: Sequence[str]) -> dict[str, Floats]:
        wanted = [part for part in _phalanges(row) if part in own]
        theirs = self._known(_phalanges(row)) or self._beside(row)
        if not wanted or not theirs:
            return {}
        if len(theirs) == len(wanted):
            return self._in_order(theirs, wanted)
        nodes = self._stack([f"{row[0][0]}_radiocarpal", *theirs])
        return dict(zip(wanted, np.moveaxis(cut_row(nodes, len(wanted)), 1, 0), strict=True))

    def _beside(self, row: Sequence[str]) -> list[str]:
        """Return the nearest finger that the motion knows, for one that is no thumb."""
        side, place = divmod(FINGERS.index(tuple(row)), 5)
        others = [FINGERS[5 * side + digit] for digit in range(1, 5)] if place else []
        known = [self._known(_phalanges(other)) for other in others]
        near = sorted(range(len(known)), key=lambda digit: abs(digit + 1 - place))
        return next((known[digit] for digit in near if known[digit]), [])

    def _known(self, parts: Iterable[str]) -> list[str]:
        return [part for part in parts if part in self.normalized.segments]

    def _in_order(self, theirs: Sequence[str], wanted: Sequence[str]) -> dict[str, Floats]:
        return {part: self._turned[other] for part, other in zip(wanted, theirs, strict=True)}

    def _stack(self, parts: Sequence[str]) -> Floats:
        return np.stack([self._turned[part] for part in parts], axis=1)


def seen_from_carriers(
    turned: Mapping[str, Floats], limbs: Mapping[str, Floats], segments: Sequence[str]
) -> tuple[Floats, Floats]:
    """Return the frames of limbs and the rotations of segments as seen from what carries them.

    Args:
        turned: How the root and each segment is turned in the world, (F, 4).
        limbs: Frame of each limb in the world by its top, (F, 4).
        segments: What has a rotation of its own.

    Returns:
        Quaternions xyzw, shapes (F, limb_count, 4) and (F, segment_count, 4).
    """
    frames = [
        multiply(conjugate(turned[carrier(top, segments)]), limb) for top, limb in limbs.items()
    ]
    rotations = []
    for part in segments:
        if part in ENDS:
            top = carrier(part, TOPS)
            above = multiply(limbs[top], conjugate(basis(top)))
        else:
            above = turned[carrier(part, segments)]
        rotations.append(multiply(conjugate(above), turned[part]))
    return continuous(np.stack(frames, axis=1)), continuous(np.stack(rotations, axis=1))


def require_whole(normalized: NormalizedMotion) -> None:
    """Refuse a motion that lacks what every body has.

    Raises:
        SceneError: It names what is missing.
    """
    what = lacking(normalized.limbs, normalized.segments, normalized.spine.shape[1])
    if what:
        raise SceneError(f"a normalized motion {what}")


def lacking(limbs: Sequence[str], segments: Sequence[str], points: int) -> str:
    """Return what a normalized motion lacks that every body has, as a predicate; "" for nothing.

    Args:
        limbs: Its limbs by their top joints.
        segments: Its segments.
        points: How many points its spine has.
    """
    missing = [part for part in TOPS if part not in limbs]
    if missing:
        return f"has no {', '.join(missing)} among its limbs; normalize the motion again"
    vertebrae = [part for part in segments if part in SPINE]
    missing = [part for part in (*ENDS, _HEAD) if part not in segments]
    missing += [] if vertebrae else list(SPINE[:1])
    if missing:
        return f"has no {', '.join(missing)} among its segments; normalize the motion again"
    if points != len(vertebrae) + 2:
        return (
            f"has {points} points in its spine for {len(vertebrae)} vertebrae; it needs two more "
            "than these, normalize the motion again"
        )
    return ""


def _phalanges(row: Sequence[str]) -> Sequence[str]:
    """Return the joints of a digit that are not in the palm; a thumb has none there."""
    return row if row[0].endswith("_1") else row[1:]
