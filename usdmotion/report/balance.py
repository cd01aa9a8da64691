"""The centre of mass and what it should be over, in the input and in the result."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Bools, Floats
from usdmotion.constraints import CenterOfMassConstraint, ContactConstraint
from usdmotion.kernels import world_points
from usdmotion.motion import WorldPose
from usdmotion.quality import along_ground, center_of_mass, standing
from usdmotion.report.feet import Footing
from usdmotion.scene import Edit, Scene


@dataclass(frozen=True, eq=False)
class Supports:
    """The points that a centre of mass should stay over."""

    before: Floats
    """In the input [m], shape (frame_count, count, 3)."""
    after: Floats
    """In the result."""
    bearing: Bools
    """Which of them bear the body, as the input says, shape (frame_count, count)."""


@dataclass(frozen=True, eq=False)
class Balance:
    """The centre of mass and its supports, in the input and in the result."""

    before: Floats
    """Centre of mass in the input [m], shape (frame_count, 3)."""
    after: Floats
    """The same in the result."""
    supports: Supports
    masses_from: str

    @property
    def support_before(self) -> Floats:
        """The middle of the supports in the input [m], shape (frame_count, 3)."""
        return np.asarray(self.supports.before.mean(axis=1))

    @property
    def support_after(self) -> Floats:
        """The same in the result."""
        return np.asarray(self.supports.after.mean(axis=1))

    def away(self, up: Floats) -> tuple[Floats, Floats]:
        """Return how far it is from its supports along the ground [m], before and after."""
        pairs = ((self.before, self.support_before), (self.after, self.support_after))
        before, after = (np.linalg.norm(along_ground(a - b, up), axis=1) for a, b in pairs)
        return before, after


def balance_of(
    scene: Scene, edit: Edit, feet: Sequence[Footing], after: WorldPose
) -> Balance | None:
    """Return the balance of an edit's character; None where there is nothing it could be over.

    Args:
        scene: The scene, with the input.
        edit: Whose.
        feet: The points of its feet.
        after: The result as the pose of all nodes.
    """
    cast = scene.cast
    character = scene.character(edit.skeleton)
    supports = _supports(scene, edit, feet, after)
    if supports is None or not cast.masses[scene.nodes(edit.skeleton)].any():
        return None
    before = mass_center(scene, edit.skeleton, (cast.positions, cast.orientations))
    there = mass_center(scene, edit.skeleton, after)
    return Balance(before, there, supports, character.masses_from)


def mass_center(scene: Scene, skeleton: str, pose: WorldPose) -> Floats:
    """Return where the centre of mass of a body is in a pose of all nodes [m], (frame_count, 3)."""
    joints, cast = scene.nodes(skeleton), scene.cast
    positions, orientations = (each[:, joints] for each in pose)
    return center_of_mass(positions, orientations, cast.masses[joints], cast.mass_centers[joints])


def balancing(edit: Edit) -> CenterOfMassConstraint | None:
    """Return what asks for the balance of an edit, one that names supports first; None if none."""
    asking = [each for each in edit.constraints if isinstance(each, CenterOfMassConstraint)]
    return min(asking, key=lambda each: not each.supports, default=None)


def _supports(
    scene: Scene, edit: Edit, feet: Sequence[Footing], after: WorldPose
) -> Supports | None:
    """Return what a constraint names, else the points of the feet."""
    cast, asking = scene.cast, balancing(edit)
    if asking is not None and asking.supports:
        nodes = [cast.node((asking.skeleton, token), asking.path) for token in asking.supports]
        points = asking.support_points if len(asking.support_points) else np.zeros((len(nodes), 3))
        before, there = (
            world_points(positions[:, nodes], orientations[:, nodes], points)
            for positions, orientations in ((cast.positions, cast.orientations), after)
        )
        return Supports(before, there, _bearing(scene, edit, asking, before))
    if not feet:
        return None
    columns = ([each.before for each in feet], [each.after for each in feet])
    before, there = (np.stack(each, axis=1) for each in columns)
    return Supports(before, there, np.stack([each.stands for each in feet], axis=1))


def _bearing(scene: Scene, edit: Edit, asking: CenterOfMassConstraint, before: Floats) -> Bools:
    """Return which supports stand, as contacts say or the input shows; all where none does."""
    cast, each_one = scene.cast, np.arange(len(asking.supports))
    leg = scene.character(edit.skeleton).leg_length
    bears = standing(cast.times, before, before, each_one, scene.up, leg)
    contacts = [each for each in edit.constraints if isinstance(each, ContactConstraint)]
    for index, token in enumerate(asking.supports):
        holds = [each.plateau(cast) for each in contacts if each.joint == token]
        if holds:
            bears[:, index] = np.any(holds, axis=0)
    bears[~bears.any(axis=1)] = True
    return bears
