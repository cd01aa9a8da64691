"""What of one stage is drawn at some times, and how it is framed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.cast import Character
from usdmotion.drawing.bodies import Kind
from usdmotion.drawing.mannequin import Mannequin
from usdmotion.drawing.strips import Body, Surface
from usdmotion.guides import ContactMark
from usdmotion.picturing.surfaces import PLAIN, drawn, lies_under

if TYPE_CHECKING:
    from usdmotion.usd.seeing import SeenBody, SeenSurface, Side

_LARGE = 1.2
"""What is larger than this, over the height of a body, may go beyond a panel."""
_NEAR = 0.4
"""What is farther from all bodies than this, over their height, may go beyond a panel."""
_LOW = 0.12
"""What is not higher above the lowest joint than this, over the height of a body, is a ground."""
_COVERED = 0.5
"""A skin that moves with so many of the joints that limbs hang on is drawn in their place."""
_SKINS: dict[Kind, tuple[float, float, float]] = {
    "before": (0.7, 0.73, 0.76),
    "after": (0.08, 0.3, 0.56),
    "other": (0.55, 0.34, 0.5),
}
"""Of a skin that says nothing of its colour, linear, as limbs are drawn."""
_AT_REST = 1.0 - 1e-6
"""Cosine of half the angle to the rest pose, above which a joint is in it."""
_MOVED = 0.01
"""What stays within this, over its size, does not move."""
_STANDING = (-0.1, 0.45)
"""Whoever's lowest joint is between these, in lengths of a leg, moves on ground of height 0."""


@dataclass(frozen=True, eq=False)
class Scenery:
    """A stage at the times that are drawn."""

    side: Side
    bodies: tuple[SeenBody, ...]
    surfaces: tuple[tuple[SeenSurface, ...], ...]
    """Time by time."""
    contacts: tuple[ContactMark, ...]

    @property
    def is_empty(self) -> bool:
        """Whether there is nothing to see at any of the times."""
        return not any(self.surfaces) and not any(each.visible.any() for each in self.bodies)

    @cached_property
    def _mannequins(self) -> dict[str, Mannequin]:
        return {each.character.path: Mannequin.of(each.character) for each in self.bodies}

    @cached_property
    def _skinned(self) -> frozenset[str]:
        """Paths of the skeletons whose skins take the place of limbs."""
        moved: dict[str, set[int]] = {}
        for surface in (each for row in self.surfaces for each in row if not each.sketch):
            if surface.joints is not None:
                moved.setdefault(surface.skeleton, set()).update(surface.joints.tolist())
        nodes = {path: set(each.nodes) for path, each in self._mannequins.items()}
        return frozenset(
            path
            for path, own in nodes.items()
            if len(own & moved.get(path, set())) >= _COVERED * max(len(own), 1)
        )

    @cached_property
    def _solved_first(self) -> list[SeenBody]:
        """The bodies, those first whose result is seen: these differ in colour."""
        return sorted(self.bodies, key=lambda each: self._kind(each.character.path) == "other")

    def limbs(self, frame: int) -> tuple[Body, ...]:
        """Return the bodies that are drawn as limbs."""
        return tuple(
            Body(
                self._mannequins[each.character.path],
                (each.pose[0][frame], each.pose[1][frame]),
                self._kind(each.character.path),
                number,
            )
            for number, each in enumerate(self._solved_first)
            if each.visible[frame] and each.character.path not in self._skinned
        )

    def _kind(self, path: str) -> Kind:
        if self.side.kind == "alone":
            return "after"
        return self.side.kind if path in self.side.skeletons else "other"

    def drawn(self, frame: int, *, follows: bool) -> tuple[Surface, ...]:
        """Return the surfaces as they are drawn, without the light meshes of known bodies.

        Their limbs or skins show the same, and more of it.

        Args:
            frame: Number of the time.
            follows: Whether the panel follows the bodies, so that props are passed by.
        """
        frames = (frame,) if follows else range(len(self.surfaces))
        return tuple(
            drawn(
                each,
                _SKINS[self._kind(each.skeleton)] if each.skeleton else PLAIN,
                beyond=not any(self._is_framed(each, when) for when in frames),
            )
            for each in self.surfaces[frame]
            if not (each.sketch and each.skeleton in self._mannequins)
        )

    def places(self) -> Iterator[Floats]:
        """Yield where joints of bodies are time by time, or else the points of what moves [m]."""
        for each in self.bodies:
            yield from each.pose[0]
        if not self.bodies:
            for surface in (each for row in self.surfaces for each in row):
                if surface.path in self._moving:
                    yield surface.points

    def ground(self, up: Floats) -> float | None:
        """Return the height of the ground that the stage has not [m]; None where it has one."""
        places = list(self.places())
        if not places:
            return None
        moving = self._moving if not self.bodies else frozenset()
        still = (each for each in self.surfaces[0] if not each.skeleton)
        under = [each for each in still if each.path not in moving]
        if lies_under(under, np.concatenate(places), up):
            return None
        lowest = float(np.median([(each @ up).min() for each in places]))
        legs = [each.character.leg_length for each in self.bodies]
        low, high = (share * max(legs, default=0.0) for share in _STANDING)
        return 0.0 if low <= lowest <= high else lowest

    def _is_framed(self, surface: SeenSurface, frame: int) -> bool:
        """Tell whether a panel has to show a surface: a skin, what moves, what is near a body.

        Grounds and walls may go beyond it.
        """
        if not self.bodies:
            return surface.path in self._moving
        height = max(each.height for each in self._mannequins.values())
        if surface.skeleton:
            return True
        if np.ptp(surface.points, axis=0).max() > _LARGE * height:
            return False
        joints = np.concatenate([each.pose[0][frame] for each in self.bodies])
        up = self.side.facts.up
        if (surface.points @ up).max() < (joints @ up).min() + _LOW * height:
            return False
        low, high = surface.points.min(axis=0), surface.points.max(axis=0)
        away = np.maximum(np.maximum(low - joints, joints - high), 0.0)
        return bool(np.linalg.norm(away, axis=1).min() <= _NEAR * height)

    @cached_property
    def _moving(self) -> frozenset[str]:
        """Paths of the surfaces that move; of all, where none does."""
        first = {each.path: each.points for each in self.surfaces[0]}
        moving = frozenset(
            each.path
            for row in self.surfaces
            for each in row
            if each.path not in first
            or each.points.shape != first[each.path].shape
            or _moves(first[each.path], each.points)
        )
        return moving or frozenset(each.path for row in self.surfaces for each in row)


def _moves(before: Floats, after: Floats) -> bool:
    """Tell whether a surface is seen to move, (point_count, 3) both."""
    size = float(np.ptp(before, axis=0).max(initial=0.0))
    return bool(np.abs(after - before).max(initial=0.0) > _MOVED * size)


def look(
    side: Side, codes: Floats, contacts: tuple[ContactMark, ...]
) -> tuple[Scenery, tuple[str, ...]]:
    """Return what of a stage is drawn at some times, and a note on each thing that is not.

    Args:
        side: The stage.
        codes: When, ascending, in time codes.
        contacts: Those on it.
    """
    from usdmotion.usd.seeing import Sight, see_bodies

    sight = Sight.of(side.stage, side.facts)
    bodies, notes = see_bodies(side.stage, codes, side.facts)
    surfaces = [sight.surfaces(float(code)) for code in codes]
    resting = {each.character.path for each in bodies if _rests(each.character)}
    if len(resting) < len(bodies):
        # Nobody has put a motion on them, and all of them may stand at one place.
        paths = ", ".join(f"<{path}>" for path in sorted(resting))
        notes += (f"left out, because in their rest pose: {paths}",) if resting else ()
        bodies = tuple(each for each in bodies if each.character.path not in resting)
        surfaces = [
            tuple(each for each in row if not (each.sketch and each.skeleton in resting))
            for row in surfaces
        ]
    return Scenery(side, bodies, tuple(surfaces), contacts), (*notes, *sight.notes.values())


def _rests(character: Character) -> bool:
    """Tell whether all joints of a character are turned as they rest, at all times."""
    alike = np.einsum("fji,ji->fj", character.motion.rotations, character.skeleton.rest_rotations)
    return bool((np.abs(alike) > _AT_REST).all())


def common_ground(sceneries: Sequence[Scenery], up: Floats) -> float | None:
    """Return the height of the ground to be drawn under all of some stages; None for none."""
    found = [each.ground(up) for each in sceneries]
    heights = [each for each in found if each is not None]
    return min(heights) if len(heights) == len(found) and heights else None
