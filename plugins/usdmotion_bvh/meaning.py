"""What a file leaves open: how positions are meant, which axis is up, how long a unit is."""

import dataclasses
from dataclasses import dataclass

import numpy as np

from usdmotion import Floats
from usdmotion_bvh.bodies import body_height, world_positions
from usdmotion_bvh.clashes import path_factor
from usdmotion_bvh.followers import decide_followers, following, leading
from usdmotion_bvh.jumps import find_jumps
from usdmotion_bvh.roots import decide_root, local_translations
from usdmotion_bvh.takes import Take
from usdmotion_bvh.units import decide_unit
from usdmotion_bvh.upright import AXIS, Up, decide_up


@dataclass(frozen=True)
class Wishes:
    """What whoever reads the file wants to decide."""

    unit: float = 0.0
    """Metres per unit; 0 leaves it to the data."""
    root: str = "auto"
    up: str = "auto"
    root_scale: float = 0.0
    """Factor on the root's positions; 0 takes them as they are, unless they contradict OFFSETs."""


@dataclass(frozen=True, eq=False)
class Meaning:
    """What was decided."""

    translations: Floats
    """Local translations in units of the file, shape (frame_count, joint_count, 3)."""
    up: Up
    metres: float
    """Metres per unit."""
    notes: tuple[str, ...]


def decide_meaning(take: Take, wishes: Wishes) -> Meaning:
    """Decide from the data whatever is not wished for.

    Raises:
        FileError: It would have to be guessed.
    """
    hierarchy, poses = take.hierarchy, take.poses
    height = body_height(hierarchy)
    leaders = leading(poses)
    factors = np.where(leaders, wishes.root_scale or 1.0, 1.0)
    poses = dataclasses.replace(poses, positions=poses.positions * factors[:, None])

    below, notes = decide_followers(take.source, hierarchy, poses)
    relative = following(poses) & (below == "relative")
    points = world_positions(hierarchy, poses, local_translations(poses, relative))
    up, up_notes = decide_up(hierarchy, poses, points, height, wishes.up)
    rule, root_notes = decide_root(hierarchy, poses, height, AXIS[up], below, wishes.root)
    relative |= leaders & (rule == "relative")
    translations = local_translations(poses, relative)
    points = world_positions(hierarchy, poses, translations)
    if wishes.root_scale == 0.0:
        _refuse_clash(take, points, AXIS[up])
    metres, unit_notes = decide_unit(height, len(leaders), wishes.unit)
    notes += [*up_notes, *root_notes, *unit_notes, *find_jumps(points, height)]
    return Meaning(translations, up, metres, tuple(notes))


def _refuse_clash(take: Take, points: Floats, axis: int) -> None:
    factor = path_factor(points, axis)
    if factor != 1.0:
        says = "the root's positions and the OFFSETs are in different units"
        cure = f"the feet stand still with the option root_scale={factor:.2g}"
        raise take.source.refusal(take.rows.first_line, f"{says}; {cure}")
