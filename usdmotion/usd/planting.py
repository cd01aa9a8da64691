"""Edits that plant feet: contacts above all, then what keeps the rest of the motion."""

from collections.abc import Sequence

from pxr import Tf, Usd

from usdmotion.cast import Character
from usdmotion.constraints import Constraint, OrientationConstraint, PositionConstraint
from usdmotion.scene import Edit
from usdmotion.usd.authoring import author
from usdmotion.usd.relations import edit_of, value

SMOOTHING = 4.0
"""Cutoff of the filter between enforcing and enforcing again, where nobody says another [Hz]."""
_PASSES = 2
_ANY_LENGTH, _ANY_ANGLE = 1000.0, 180.0
"""Tolerances [m, degrees] of what is kept as far as contacts allow."""


def edits_of(stage: Usd.Stage, detections: Sequence[str]) -> tuple[str, ...]:
    """Return the paths of the edits that some detections are in, each once."""
    edits = [edit_of(stage.GetPrimAtPath(path)) for path in detections]
    return tuple(dict.fromkeys(str(each.GetPath()) for each in edits if each is not None))


def author_passes(stage: Usd.Stage, edit: str, smoothing: float | None) -> None:
    """Let an edit be enforced, filtered and enforced again.

    Args:
        stage: Where, in its edit target.
        edit: Path of the MotionEdit.
        smoothing: Cutoff of the filter [Hz], 0 for none; None leaves what the edit says, if it
            says any.
    """
    prim = stage.GetPrimAtPath(edit)
    attribute = prim.GetAttribute("usdmotion:smoothing")
    if smoothing is None and attribute.HasAuthoredValue():
        return
    cutoff = SMOOTHING if smoothing is None else smoothing
    attribute.Set(float(cutoff))
    if cutoff > 0.0 and int(value(prim, "usdmotion:passes", 1)) < _PASSES:
        prim.GetAttribute("usdmotion:passes").Set(_PASSES)


def author_keeping(
    stage: Usd.Stage, edit: Edit, character: Character, detections: Sequence[str]
) -> None:
    """Let an edit keep what contacts leave: how the pelvis is turned, and where free feet go.

    Without that a leg that cannot reach its contact would turn the body, and the other leg with it.
    What is there already stays as it is.

    Args:
        stage: Where, in its edit target.
        edit: The edit as it was read.
        character: Whose edit it is.
        detections: Paths of the detections of feet in it.
    """
    joints = [str(value(stage.GetPrimAtPath(path), "usdmotion:joint", "")) for path in detections]
    feet = [each for each in joints if not any(each.startswith(f"{other}/") for other in joints)]
    lowest = max((each.priority for each in edit.constraints), default=0)
    for constraint in _keeping(character, feet, lowest):
        path = f"{edit.path}/{constraint.path}"
        if not stage.GetPrimAtPath(path):
            author(stage, path, constraint)


def _keeping(character: Character, feet: Sequence[str], lowest: int) -> list[Constraint]:
    """Return what keeps the pelvis and feet, below some rank; paths are names of prims."""
    parts, tokens = character.parts, character.skeleton.joints
    pelvis = parts.pelvis if parts else None
    body = tokens[character.root if pelvis is None else pelvis]
    return [
        OrientationConstraint(
            path=_name(body),
            skeleton=character.path,
            joint=body,
            priority=lowest + 1,
            tolerance=_ANY_ANGLE,
        ),
        *(
            PositionConstraint(
                path=_name(foot),
                skeleton=character.path,
                joint=foot,
                priority=lowest + 2,
                tolerance=_ANY_LENGTH,
            )
            for foot in feet
        ),
    ]


def _name(token: str) -> str:
    return f"Keep{Tf.MakeValidIdentifier(token.rsplit('/', 1)[-1])}"
