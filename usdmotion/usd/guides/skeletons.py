"""The motion that an edit starts from, as a pale skeleton that UsdSkel moves."""

from dataclasses import dataclass

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, UsdSkel, Vt

from usdmotion.arrays import Floats, Ints
from usdmotion.guides import SegmentGuide, segment_guide
from usdmotion.kernels import forward
from usdmotion.usd.characters import Sitting, read_character
from usdmotion.usd.clips import own_times
from usdmotion.usd.guides.pages import BEFORE, Page
from usdmotion.usd.guides.placements import Placement, author_placement, placement
from usdmotion.usd.guides.prims import (
    author_color,
    author_extent,
    author_mesh,
    author_opacity,
    make,
)
from usdmotion.usd.layers import apply_schema, over, relate, set_value, set_varying
from usdmotion.usd.origins import source_of
from usdmotion.usd.relations import value
from usdmotion.usd.shot import Facts
from usdmotion.usd.transforms import matrices_of

GHOST = "Ghost"
_OPACITY = 0.25
_BEYOND = 0.05
"""How far a box goes beyond joints, over its own size: segments are thick."""
_SHORT = 0.2
"""A segment of a bind pose that is shorter than this, over its length in motion, tells nothing."""
_TYPES = Sdf.ValueTypeNames
_NO_JOINTS: Ints = np.zeros(0, dtype=np.int64)


@dataclass(frozen=True, eq=False)
class Ghost:
    """A skeleton as it is to be drawn."""

    source: str
    """Path of the SkelAnimation that moves it."""
    joints: tuple[str, ...]
    rest: Vt.Matrix4dArray | None
    """As the skeleton has it; None where it has none."""
    bind: Floats
    """The pose in which its segments are made, in its units, shape (joint_count, 4, 4)."""
    segments: SegmentGuide
    box: Floats
    """Around all that its joints reach, in its units, shape (2, 3)."""
    placed: Placement
    """From its space to the edit's."""
    in_root: bool
    """Whether the edit is below a SkelRoot already."""


def read_ghost(edit: Usd.Prim, skeleton: Usd.Prim, codes: Floats, facts: Facts) -> Ghost | None:
    """Return the ghost of what an edit starts from; None where there is nothing to see.

    Args:
        edit: The MotionEdit.
        skeleton: The Skeleton that it solves.
        codes: Time codes of the frames.
        facts: Units and rates of the stage.

    Raises:
        SceneError: There is no motion to start from.
    """
    source = source_of(edit, skeleton)
    own = own_times(source)
    sitting = read_character(skeleton, source, own if len(own) else codes[:1], facts)
    places = _places(sitting)
    bind = _bind(skeleton, sitting)
    segments = segment_guide(sitting.joints.parents, bind[:, 3, :3], _NO_JOINTS, np.zeros((0, 3)))
    if not len(segments.faces):
        return None
    rest = value(skeleton, "restTransforms")
    box = np.array([places.min(axis=(0, 1)), places.max(axis=(0, 1))])
    box += _BEYOND * np.linalg.norm(box[1] - box[0]) * np.array([[-1.0], [1.0]])
    return Ghost(
        source=str(source.GetPath()),
        joints=sitting.joints.tokens,
        rest=rest if rest is not None and len(rest) == len(sitting.joints.tokens) else None,
        bind=bind,
        segments=segments,
        box=box,
        placed=placement(edit, onto=skeleton),
        in_root=bool(UsdSkel.Root.Find(edit)),
    )


def draw_ghost(page: Page, ghost: Ghost) -> None:
    """Draw a ghost: a Skeleton that the source moves, and a mesh that it moves."""
    layer, path = page.sheet.layer, f"{page.home}/{GHOST}"
    above = over(layer, path)
    make(above, "Xform" if ghost.in_root else "SkelRoot")
    author_placement(page.sheet, above, ghost.placed)
    author_color(above, BEFORE)
    author_opacity(above, _OPACITY)
    if not ghost.in_root:
        author_extent(above, ghost.box)
    skeleton = over(layer, f"{path}/Skeleton")
    _author_skeleton(skeleton, ghost)
    _author_segments(over(layer, f"{path}/Segments"), str(skeleton.path), ghost, page.near)


def _author_skeleton(prim: Sdf.PrimSpec, ghost: Ghost) -> None:
    make(prim, "Skeleton")
    apply_schema(prim, "SkelBindingAPI")
    set_value(prim, "joints", _TYPES.TokenArray, Vt.TokenArray(list(ghost.joints)))
    bind = Vt.Matrix4dArray.FromNumpy(np.round(ghost.bind, 7) + 0.0)
    set_value(prim, "bindTransforms", _TYPES.Matrix4dArray, bind)
    if ghost.rest is not None:
        set_value(prim, "restTransforms", _TYPES.Matrix4dArray, ghost.rest)
    relate(prim, "skel:animationSource", ghost.source)
    # Viewers that draw skeletons themselves would draw it over its segments.
    set_varying(prim, "visibility", _TYPES.Token, UsdGeom.Tokens.invisible)
    author_extent(prim, ghost.box)


def _author_segments(prim: Sdf.PrimSpec, skeleton: str, ghost: Ghost, detail: float) -> None:
    faces = ghost.segments.faces
    author_mesh(prim, ghost.segments.points, [3] * len(faces), faces.ravel().tolist(), detail)
    author_extent(prim, ghost.box)
    apply_schema(prim, "SkelBindingAPI")
    relate(prim, "skel:skeleton", skeleton)
    joints = Vt.IntArray(ghost.segments.reaching.tolist())
    weights = Vt.FloatArray([1.0] * len(joints))
    for name, kind, array in (
        ("Indices", _TYPES.IntArray, joints),
        ("Weights", _TYPES.FloatArray, weights),
    ):
        set_varying(prim, f"primvars:skel:joint{name}", kind, array, UsdGeom.Tokens.vertex)
        prim.attributes[f"primvars:skel:joint{name}"].SetInfo("elementSize", 1)
    still = Gf.Matrix4d(1.0)
    set_varying(prim, "primvars:skel:geomBindTransform", _TYPES.Matrix4d, still)


def _places(sitting: Sitting) -> Floats:
    """Return where joints are, in the skeleton's space and units, (frame_count, joint_count, 3)."""
    motion, parents = sitting.character.motion, sitting.joints.parents
    positions, _ = forward(parents, motion.translations, motion.rotations)
    return np.asarray(positions / np.reshape(sitting.scaling.of_space, (-1, 1, 1)))


def _bind(skeleton: Usd.Prim, sitting: Sitting) -> Floats:
    """Return the bind pose; the first pose where there is none in which segments have a length."""
    count = len(sitting.joints.tokens)
    bind = np.asarray(value(skeleton, "bindTransforms", ()), dtype=np.float64).reshape(-1, 4, 4)
    motion, parents = sitting.character.motion, sitting.joints.parents
    first = forward(parents, motion.translations[:1], motion.rotations[:1])
    places = first[0][0] / sitting.scaling.of_space[0]
    if len(bind) == count and (np.abs(np.linalg.det(bind)) > 0.0).all():
        below = np.flatnonzero(parents >= 0)
        lengths, now = (
            np.linalg.norm(each[below] - each[parents[below]], axis=1)
            for each in (bind[:, 3, :3], places)
        )
        if (lengths > _SHORT * now).all():
            return bind
    return matrices_of(places, first[1][0])
