"""The points of feet that stand, and how far they slide there in the input and in the result."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Bools, Floats
from usdmotion.cast import Cast, Character
from usdmotion.constraints import Constraint, ContactConstraint, PositionConstraint
from usdmotion.humanoid import PartMap
from usdmotion.humanoid.parts import LEG
from usdmotion.kernels import world_points
from usdmotion.motion import WorldPose
from usdmotion.quality import runs, slide, standing
from usdmotion.scene import Edit, Scene

_SIDES = {"l": "left", "r": "right"}


@dataclass(frozen=True, eq=False)
class Footing:
    """One point of a foot, when it stands, and what becomes of it there."""

    name: str
    stands: Bools
    """When it stands, which the input says alone, shape (frame_count,)."""
    before: Floats
    """World positions in the input [m], shape (frame_count, 3)."""
    after: Floats
    """World positions in the result [m]."""
    slid_before: Floats
    """How far it is from the middle of where it stands, in the input [m], shape (frame_count,)."""
    slid_after: Floats
    """The same in the result."""

    @property
    def stances(self) -> list[tuple[int, int]]:
        """First frame of each stretch in which it stands, and one past the last."""
        return runs(self.stands)


@dataclass(frozen=True, eq=False)
class _Point:
    """A point of a foot that is to be watched."""

    name: str
    node: int
    point: Floats
    foot: int
    """The foot it belongs to, -1 for none that is known."""
    stands: Bools | None
    """When it stands, where a contact says so."""


def footings(scene: Scene, edit: Edit, solved: WorldPose) -> tuple[Footing, ...]:
    """Return the points of one character's feet.

    They are what contacts and position constraints hold on the feet, else ankles and toes, as the
    map of the body has them. When they stand is told by contacts, else by `quality.standing`.
    """
    cast, character = scene.cast, scene.character(edit.skeleton)
    points = _points(cast, character, edit.constraints)
    before = _places(points, (cast.positions, cast.orientations))
    after = _places(points, solved)
    stands = _stands(scene, character, points, before)
    found = [
        Footing(
            point.name,
            stands[:, index],
            before[:, index],
            after[:, index],
            slide(before[:, index], stands[:, index], scene.up),
            slide(after[:, index], stands[:, index], scene.up),
        )
        for index, point in enumerate(points)
    ]
    return tuple(each for each in found if each.stands.any())


def _points(cast: Cast, character: Character, constraints: Sequence[Constraint]) -> list[_Point]:
    held = list(_held(cast, character, constraints))
    named = {point.foot for point in held}
    parts = character.parts
    for foot, side in enumerate(_SIDES if parts else ()):
        if foot in named:
            continue
        for part, word in ((LEG[2], "ankle"), (LEG[3], "toes")):
            joint = parts.joint(f"{side}_{part}") if parts else None
            if joint is not None:
                node = cast.index[character.path, character.skeleton.joints[joint]]
                held.append(_Point(f"{_SIDES[side]} {word}", node, np.zeros(3), foot, None))
    return held


def _held(cast: Cast, character: Character, constraints: Sequence[Constraint]) -> Iterator[_Point]:
    """Yield the points of feet that constraints hold, each once, however often it is held."""
    groups: dict[tuple[str, bytes], list[Constraint]] = {}
    for each in constraints:
        if isinstance(each, (ContactConstraint, PositionConstraint)):
            groups.setdefault((each.joint, each.point.tobytes()), []).append(each)
    for (joint, _), group in groups.items():
        foot = _foot(character, joint)
        contacts = [each for each in group if isinstance(each, ContactConstraint)]
        if foot < 0 and not contacts:
            continue
        on = [each.plateau(cast) for each in contacts]
        name = joint if len(group) > 1 else group[0].path
        yield _Point(
            name.rsplit("/", 1)[-1],
            group[0].node(cast),
            group[0].point,
            foot,
            np.any(on, axis=0) if on else None,
        )


def _foot(character: Character, token: str) -> int:
    """Return which foot a joint is of, 0 the left, 1 the right, -1 none."""
    skeleton = character.skeleton
    for foot, ankle in enumerate(_ankles(character.parts)):
        if ankle is not None and ankle in skeleton.chain(skeleton.index[token]):
            return foot
    return -1


def _ankles(parts: PartMap | None) -> list[int | None]:
    return [parts.joint(f"{side}_{LEG[2]}") if parts else None for side in _SIDES]


def _places(points: Sequence[_Point], pose: WorldPose) -> Floats:
    """Return where points are in a pose of all nodes [m], shape (frame_count, point_count, 3)."""
    positions, orientations = pose
    places = np.zeros((len(positions), len(points), 3))
    for index, point in enumerate(points):
        places[:, index] = world_points(
            positions[:, point.node], orientations[:, point.node], point.point
        )
    return places


def _stands(scene: Scene, character: Character, points: Sequence[_Point], before: Floats) -> Bools:
    cast = scene.cast
    ankles = [ankle for ankle in _ankles(character.parts) if ankle is not None]
    stands = np.zeros(before.shape[:2], dtype=np.bool_)
    if ankles:
        nodes = [cast.index[character.path, character.skeleton.joints[each]] for each in ankles]
        feet = np.array([max(point.foot, 0) for point in points], dtype=np.int64)
        stands = standing(
            cast.times,
            before,
            cast.positions[:, nodes],
            np.minimum(feet, len(ankles) - 1),
            scene.up,
            character.leg_length,
        )
    for index, point in enumerate(points):
        if point.stands is not None:
            stands[:, index] = point.stands
    return stands
