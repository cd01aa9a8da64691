"""Detections of feet, made where there are none yet."""

from collections.abc import Sequence

from pxr import Sdf, Usd

from usdmotion.asking import Asked
from usdmotion.errors import SceneError
from usdmotion.options import options
from usdmotion.plugins import host
from usdmotion.usd.attribute_authoring import define
from usdmotion.usd.detections.joints import feet_of
from usdmotion.usd.detections.objects import Watched, find_watched
from usdmotion.usd.detections.places import Place, Places, author_edit_above
from usdmotion.usd.detections.searches import DEFAULT_DETECTOR
from usdmotion.usd.detections.survey import Survey
from usdmotion.usd.relations import edit_of

SHORTEST = 0.1
"""A foot that stands for less does not stand [s]."""
BENT = 20.0
"""How far toes may bend while the ball of their foot stands [degrees]."""


def author_feet(stage: Usd.Stage, joints: Sequence[str] = (), *, edit: str = "") -> tuple[str, ...]:
    """Make a detection for each joint of feet that has none, in the edit target of a stage.

    Args:
        stage: The stage.
        joints: The joints that stand, as tokens, leaf names or H-Anim names; none takes the ankles
            and balls of the feet of every skeleton of which they are known.
        edit: Path of the only MotionEdit whose skeleton is looked at; "" looks at all.

    Returns:
        Paths of the detections.

    Raises:
        SceneError: Nobody knows which joints are feet, or a named one is not there, or what is
            found on one could not be solved.
    """
    survey, places = Survey(stage, edit), Places(stage)
    watched = find_watched(survey, Asked(joints=tuple(joints) or _known(survey)))
    found = [(each, places.of(each)) for each in watched]
    for each, place in found:
        if each.detection is None:
            _author(stage, each, place, _is_carried(each, watched))
    paths = tuple(place.path for _, place in found)
    for path in paths:
        if edit_of(stage.GetPrimAtPath(path)) is None:
            raise SceneError(
                f"<{path}> is in no MotionEdit, so its contacts cannot be solved; move it into one"
            )
    return paths


def _known(survey: Survey) -> tuple[str, ...]:
    performers = [survey.performer(skeleton) for skeleton in survey.skeletons]
    tokens = [token for each in performers for token in feet_of(each.tokens, each.parts)]
    if tokens:
        return tuple(dict.fromkeys(tokens))
    paths = ", ".join(f"<{each.path}>" for each in performers)
    if not paths:
        raise SceneError("there is no Skeleton in motion; import one, or bind a SkelAnimation")
    raise SceneError(
        f"nobody knows which joints of {paths} are feet; name the ankles and the balls of the feet "
        "with --joints, or say in usdmotion:parts which they are"
    )


def _is_carried(one: Watched, watched: Sequence[Watched]) -> bool:
    """Tell whether a joint is below another one that is looked at, as a ball below its ankle."""
    return any(
        one.performer is each.performer and one.joint.startswith(f"{each.joint}/")
        for each in watched
    )


def _author(stage: Usd.Stage, watched: Watched, place: Place, carried: bool) -> None:
    author_edit_above(stage, place)
    prim = define(stage, place.path, "MotionDetection")
    prim.GetAttribute("usdmotion:joint").Set(watched.joint)
    prim.GetAttribute("usdmotion:minimum").Set(SHORTEST)
    if carried:
        prim.GetAttribute("usdmotion:parallelAngle").Set(BENT)
    # A foot that is only setting down or rolling off is not to be held.
    if any(each.name == "rounds" for each in options(host().detector(DEFAULT_DETECTOR))):
        prim.CreateAttribute("usdmotion:option:rounds", Sdf.ValueTypeNames.Int, custom=True).Set(1)
