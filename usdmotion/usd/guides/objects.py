"""The objects that the contacts of a stage hold, however those came there."""

from collections.abc import Sequence
from dataclasses import dataclass

from pxr import Usd

from usdmotion.guides import ContactObject, trajectory
from usdmotion.usd.detections.authoring import Authored
from usdmotion.usd.detections.contact_prims import contact_prims
from usdmotion.usd.detections.joints import feet_of
from usdmotion.usd.detections.performers import Performer
from usdmotion.usd.detections.survey import Survey
from usdmotion.usd.detections.trajectories import Trajectory, read_trajectory
from usdmotion.usd.drawn import without_guides
from usdmotion.usd.relations import is_a, skeleton_of, target, value


@dataclass(frozen=True, eq=False)
class Touched:
    """An object, with contacts that hold it."""

    held: ContactObject
    trajectory: Trajectory
    contacts: tuple[Usd.Prim, ...]
    """Those that are on."""
    is_foot: bool
    """Whether it is the ankle or the ball of a foot."""


def touched_by(stage: Usd.Stage, authored: Sequence[Authored]) -> tuple[Touched, ...]:
    """Return the objects that were looked at."""
    found = []
    for each in authored:
        sought = each.found.sought
        contacts = contact_prims(stage.GetPrimAtPath(sought.path))
        on = tuple(prim for prim in contacts if prim.IsActive())
        watched = sought.watched
        found.append(_touched(watched.key, watched.performer, sought.trajectory, on))
    return tuple(found)


def touched_on(stage: Usd.Stage) -> tuple[Touched, ...]:
    """Return the objects that the contacts of a stage hold, detected or not.

    Raises:
        SceneError: The motion of one cannot be read.
    """
    here = Survey(stage)
    contacts: dict[tuple[str, str], list[Usd.Prim]] = {}
    for prim in without_guides(Usd.PrimRange.Stage(stage)):
        if is_a(prim, "UsdMotionContactConstraint") and (key := _key(prim)):
            contacts.setdefault(key, []).append(prim)
    return tuple(_read(here, key, tuple(prims)) for key, prims in contacts.items())


def _key(contact: Usd.Prim) -> tuple[str, str] | None:
    """Return the Skeleton and joint that a contact holds, or the prim and ""; None for nothing."""
    above = contact.GetParent()
    for prim in (contact, above) if is_a(above, "UsdMotionDetection") else (contact,):
        held = target(prim, "usdmotion:object")
        if held is not None:
            return str(held.GetPath()), ""
        joint, skeleton = str(value(prim, "usdmotion:joint", "")), skeleton_of(prim)
        if joint and skeleton is not None:
            return str(skeleton.GetPath()), joint
    return None


def _read(here: Survey, key: tuple[str, str], contacts: tuple[Usd.Prim, ...]) -> Touched:
    path, joint = key
    prim = here.stage.GetPrimAtPath(path)
    if not joint:
        return _touched(key, None, read_trajectory(prim, here.facts, still=True), contacts)
    performer = here.performer(prim)
    return _touched(key, performer, performer.trajectory(joint), contacts)


def _touched(
    key: tuple[str, str],
    performer: Performer | None,
    moves: Trajectory,
    contacts: tuple[Usd.Prim, ...],
) -> Touched:
    path, joint = key
    held = ContactObject(
        path=path,
        joint=joint,
        points=moves.points,
        units=moves.units[0],
        start=float(moves.time_codes[0]),
        course=trajectory(moves.translations, moves.points),
    )
    feet = () if performer is None else feet_of(performer.tokens, performer.parts)
    return Touched(held, moves, contacts, joint in feet)
