"""The characters of a stage that something moves."""

from collections.abc import Iterator

import numpy as np
from pxr import Usd, UsdGeom

from usdmotion.arrays import Floats
from usdmotion.cast import Cast
from usdmotion.errors import SceneError
from usdmotion.usd.characters import read_character
from usdmotion.usd.clips import own_times
from usdmotion.usd.relations import bound_animation, is_a, joints_of
from usdmotion.usd.seeing.looks import is_visible
from usdmotion.usd.seeing.seen import SeenBody
from usdmotion.usd.shot import Facts


def see_bodies(
    stage: Usd.Stage, time_codes: Floats, facts: Facts
) -> tuple[tuple[SeenBody, ...], tuple[str, ...]]:
    """Return the characters that an animation is bound to, and a note on each that is left out.

    Args:
        stage: The stage.
        time_codes: When, ascending, shape (frame_count,).
        facts: Units and rates of the stage.
    """
    found: list[SeenBody] = []
    notes: list[str] = []
    for prim in _bound(stage):
        try:
            found.append(_body(prim, time_codes, facts))
        except SceneError as error:
            notes.append(f"<{prim.GetPath()}> is not drawn as limbs: {error}")
    return tuple(found), tuple(notes)


def moved_skeletons(stage: Usd.Stage) -> tuple[str, ...]:
    """Return the paths of the Skeletons that an animation moves over time."""
    return tuple(
        str(prim.GetPath()) for prim in _bound(stage) if len(own_times(bound_animation(prim))) > 1
    )


def _bound(stage: Usd.Stage) -> Iterator[Usd.Prim]:
    """Yield the Skeletons that an animation is bound to, ghosts left out."""
    for prim in Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies()):
        if is_a(prim, "UsdSkelSkeleton") and joints_of(prim) and bound_animation(prim):
            # A Skeleton is often a guide itself; one that stands under a guide is a ghost.
            above = UsdGeom.Imageable(prim.GetParent())
            if not above or above.ComputePurpose() != UsdGeom.Tokens.guide:
                yield prim


def _body(skeleton: Usd.Prim, time_codes: Floats, facts: Facts) -> SeenBody:
    sitting = read_character(skeleton, bound_animation(skeleton), time_codes, facts)
    cast = Cast.of([sitting.character])
    return SeenBody(
        character=sitting.character,
        pose=(cast.positions[:, 1:], cast.orientations[:, 1:]),
        visible=np.array([is_visible(skeleton, code) for code in time_codes]),
    )
