"""The input of a scene, put on the ground before anything is asked of it."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from usdmotion.cast import Cast, Character
from usdmotion.constraints import Constraint
from usdmotion.errors import SceneError
from usdmotion.grounding.account import Grounding
from usdmotion.grounding.contacts import footprint_of, is_footprint, on_ground, staying
from usdmotion.grounding.looking import Detect, find_footprints
from usdmotion.s4d import Footprint, Morphology, Standing, stand
from usdmotion.s4d.standing import Pose
from usdmotion.scene import Edit, Scene
from usdmotion.travelling import frames_of

_MILLIMETRE = 1e-3


@dataclass(frozen=True, eq=False)
class Grounded:
    """A scene whose edits start from inputs on their grounds."""

    scene: Scene
    """With other input motions; what is asked for is as it was."""
    contacts: Mapping[str, Constraint] = field(default_factory=dict)
    """The contacts of feet as they are on the ground, by their paths."""
    accounts: Mapping[str, Grounding] = field(default_factory=dict)
    """What was done for each edit that has a ground, by its path."""

    def posed(self, scene: Scene) -> Scene:
        """Return a scene with the contacts of feet on the ground, as it is to be solved."""
        if not self.contacts:
            return scene

        def put(edit: Edit) -> Edit:
            asked = tuple(self.contacts.get(each.path, each) for each in edit.constraints)
            return replace(edit, constraints=asked)

        return replace(scene, edits=tuple(map(put, scene.edits)))


def grounded(scene: Scene, detect: Detect) -> Grounded:
    """Return a scene whose edits start from motions on their grounds.

    Footprints are an edit's contacts of feet; where it has none, they are looked for. Edits without
    a ground keep their motions.

    Args:
        scene: What was read, cleaned where that is asked for.
        detect: What finds contacts of a joint.

    Raises:
        SceneError: Nobody knows which joints are the legs of one that is to stand on a ground.
    """
    characters: dict[str, Character] = {}
    contacts: dict[str, Constraint] = {}
    accounts: dict[str, Grounding] = {}
    for edit in scene.edits:
        if edit.ground is None:
            continue
        given = scene.character(edit.skeleton)
        feet = [each for each in edit.constraints if is_footprint(each, given)]
        feet = [each for each in feet if frames_of(each, given.motion.times).any()]
        before = _pose(given)
        footprints = [footprint_of(each, given, before) for each in feet]
        footprints = footprints or list(find_footprints(given, detect, scene.up))
        standing = _standing(edit, given, footprints, scene)
        there = replace(given, motion=standing.motion)
        after = _pose(there)
        contacts |= {each.path: on_ground(each, given, before, after, standing) for each in feet}
        characters[given.path] = there
        account = _account(footprints, not feet, standing, scene)
        left = staying(edit.constraints, given)
        accounts[edit.path] = replace(account, staying=left)
    if not accounts:
        return Grounded(scene)
    cast = tuple(characters.get(each.path, each) for each in scene.characters)
    return Grounded(replace(scene, characters=cast), contacts, accounts)


def _standing(edit: Edit, given: Character, footprints: list[Footprint], scene: Scene) -> Standing:
    if given.parts is None:
        raise SceneError(
            f"<{edit.path}> stands on a ground, and nobody knows which joints of <{given.path}> "
            "are its legs; author usdmotion:parts on it"
        )
    who = f"<{given.path}>"
    body = Morphology.of(given.skeleton, given.parts, poses=given.motion, who=who)
    return stand(
        given.motion, given.placement, body, footprints, edit.ground, up=scene.up, body=given.body
    )


def _account(
    footprints: list[Footprint], detected: bool, standing: Standing, scene: Scene
) -> Grounding:
    heights = standing.heights
    low = heights.wished - heights.root
    frame = int(low.argmax())
    rises = np.array([tread.drawn @ scene.up for tread in standing.treads.values()])
    gives = float(low[frame])
    return Grounding(
        footprints=len(footprints),
        detected=detected and bool(footprints),
        without_ground=len(standing.groundless),
        made_on=standing.made_on,
        lowest=float(rises.min()),
        highest=float(rises.max()),
        given_way=gives if gives > _MILLIMETRE else 0.0,
        given_way_time=float(scene.time_codes[frame]) if gives > _MILLIMETRE else None,
    )


def _pose(character: Character) -> Pose:
    cast = Cast.of([character])
    return Pose(cast.positions[:, 1:], cast.orientations[:, 1:])
