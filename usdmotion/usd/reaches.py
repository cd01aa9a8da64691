"""A position constraint at a joint, made by a tool: it can be solved as it is, and means little.

It asks for what is there already, or for the prop that it is to follow, and takes nothing from the
constraints that are there: it ranks below all of them, and recruits what they let it.
"""

import numpy as np
from pxr import Tf, Usd, UsdGeom, Vt

from usdmotion.constraints import Goal, PositionConstraint
from usdmotion.errors import SceneError
from usdmotion.recruiting import allowed
from usdmotion.usd.attribute_authoring import define, time_code_array
from usdmotion.usd.authoring import author
from usdmotion.usd.constraints import constraint_prims
from usdmotion.usd.detections.joints import leaf_of
from usdmotion.usd.detections.objects import Watched, objects_of
from usdmotion.usd.detections.performers import Performer
from usdmotion.usd.detections.places import Places, author_edit_above
from usdmotion.usd.detections.survey import Survey
from usdmotion.usd.faults.recruits import claims_of
from usdmotion.usd.relations import edit_of, floats, value

_EDIT = "Edit"
"""Name of the edit that is made of a skeleton that has none."""
_GOAL = "Goal"
_LASTS = 1.0
"""From its first time to its last [s]."""
_EASES = 0.25
"""How long it eases at either end [s]."""


def author_reach(
    stage: Usd.Stage, skeleton: str, joint: str, *, time_code: float, space: str = ""
) -> str:
    """Make a position constraint around a time, with one goal.

    Args:
        stage: Where, in its edit target.
        skeleton: Path of the Skeleton, or of the MotionEdit of one that it is to go into.
        joint: The joint, as a token, leaf name or H-Anim name.
        time_code: The middle of the second for which it is on.
        space: Path of the prim that the goal follows; "" offsets the motion, by nothing yet.

    Returns:
        Path of the constraint. Its goal is the prim `Goal` below it.

    Raises:
        SceneError: The Skeleton, the joint or the prim is not there, or nothing moves it.
    """
    _require_space(stage, space)
    within = edit_of(stage.GetPrimAtPath(skeleton))
    only = ("", (skeleton,)) if within is None else (str(within.GetPath()), ())
    (watched,) = objects_of(Survey(stage, *only), joint)
    performer = _performer(watched)
    leaf = leaf_of(watched.joint)
    name = Tf.MakeValidIdentifier(f"Reach{leaf[:1].upper()}{leaf[1:]}")
    place = Places(stage).within(performer, name, _EDIT)
    rank = _lowest(performer.edit) + 1
    author_edit_above(stage, place)
    goals = () if space else (Goal(path=_GOAL, mode="offset"),)
    asked = PositionConstraint(
        path="", skeleton=performer.path, joint=watched.joint, priority=rank, goals=goals
    )
    author(stage, place.path, asked)
    prim = stage.GetPrimAtPath(place.path)
    times = time_code_array(_times(performer, time_code))
    prim.GetAttribute("usdmotion:times").Set(times)
    if space:
        goal = define(stage, f"{place.path}/{_GOAL}", "MotionGoal")
        goal.GetRelationship("usdmotion:space").SetTargets([space])
    _author_recruits(prim)
    return place.path


def _require_space(stage: Usd.Stage, space: str) -> None:
    prim = stage.GetPrimAtPath(space) if space else None
    if space and not (prim and prim.IsA(UsdGeom.Xformable)):
        raise SceneError(f"<{space}> is no Xformable prim, so that nothing can follow it")


def _performer(watched: Watched) -> Performer:
    if watched.performer is None:
        raise SceneError(f"<{watched.key[0]}> is no joint; name one of the Skeleton")
    return watched.performer


def _lowest(edit: Usd.Prim | None) -> int:
    """Return the priority that is enforced last of those in an edit, 0 where there is none."""
    constraints = () if edit is None else constraint_prims(edit)
    return max((int(value(prim, "usdmotion:priority", 1)) for prim in constraints), default=0)


def _times(performer: Performer, time_code: float) -> list[float]:
    """Return key times around a time, all of them within what the edit solves."""
    edit, codes = performer.edit, performer.time_codes
    span = floats(value(edit, "usdmotion:range", ())) if edit else []
    first, last = (span[0], span[1]) if span else (codes[0], codes[-1])
    rate = performer.facts.time_codes_per_second
    half = 0.5 * _LASTS
    around = np.array([-half, -half + _EASES, half - _EASES, half]) * rate
    middle = np.clip(time_code, first, last)
    return [float(code) for code in np.clip(middle + around, first, last)]


def _author_recruits(prim: Usd.Prim) -> None:
    """Let a constraint move only what those that rank above it may move as well."""
    parents, claims = claims_of(edit_of(prim))
    own = next((claim for claim in claims if claim.name == str(prim.GetPath())), None)
    if own is None:
        return
    kept = allowed(parents, claims, own)
    # One that may move nothing is no use; `inspect` says what it disturbs.
    if kept and kept != own.recruits:
        tokens = [joint for joint in parents if joint in kept]
        prim.GetAttribute("usdmotion:recruits").Set(Vt.TokenArray(tokens))
