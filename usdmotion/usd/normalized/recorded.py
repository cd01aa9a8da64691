"""A motion on a stage, taken off its body with what it must obey."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from pxr import Usd

from usdmotion.arrays import Floats
from usdmotion.cast import Character
from usdmotion.constraints import Constraint, ContactConstraint
from usdmotion.humanoid import FEET
from usdmotion.s4d import Held, Morphology, normalize
from usdmotion.travelling import (
    Left,
    Luggage,
    Meanings,
    Settings,
    StaysBehind,
    Traveller,
    Way,
    carried,
    contacts_of_feet,
    held_by,
)
from usdmotion.usd.characters import Sitting
from usdmotion.usd.normalized.gathering import gather
from usdmotion.usd.normalized.lowering import on_ground
from usdmotion.usd.normalized.settings import read_settings
from usdmotion.usd.normalized.subjects import Subject, bodies_of, morphology_of, read_sittings
from usdmotion.usd.provenance import hash_of
from usdmotion.usd.shot import Facts
from usdmotion.usd.stages import read_facts


@dataclass(frozen=True, eq=False)
class Recorded:
    """A motion that was taken off its body, and that body."""

    luggage: Luggage
    body: Morphology
    character: Character
    contacts: Mapping[str, ContactConstraint]
    """Those of its feet, on that body, by their names."""
    subject: Subject


def read_recorded(
    stage: Usd.Stage,
    subject: Subject,
    name: str,
    frames: tuple[float, float] | None,
    kinds: Sequence[type[Constraint]],
    found: Sequence[str] = (),
) -> Recorded:
    """Return a motion without its body.

    Args:
        stage: The stage.
        subject: Who moves.
        name: What to call the motion, as a prim.
        frames: First and last time code; None is all of it.
        kinds: What prims can be read as.
        found: Paths of the detections whose contacts nobody has asked for.

    Raises:
        SceneError: The body is not human, or something cannot be told without guessing.
    """
    facts = read_facts(stage)
    codes, sittings = read_sittings(subject, frames, facts)
    sitting = sittings[subject.path]
    body, character = morphology_of(subject.skeleton, sitting), sitting.character
    meanings = Meanings.of(subject.path, body, facts.up)
    on_body: tuple[Traveller, ...] = ()
    left: tuple[Left, ...] = ()
    low: list[Held] = []
    if subject.edit is not None:
        on_body, left = gather(subject.edit, subject.path, kinds, sittings, codes, facts)
        above = _names(subject, found)
        on_body, low = on_ground(on_body, above, meanings, character, body, facts.up)
    travellers, behind = carry(on_body, _ways(stage, subject, sittings, name, facts))
    luggage = Luggage(
        name=name,
        motion=normalize(
            character.motion,
            character.placement,
            body,
            up=facts.up,
            held=[*held_by(on_body, meanings, character.motion.times), *low],
        ),
        first=float(codes[0]) / facts.time_codes_per_second,
        travellers=travellers,
        left=(*left, *behind),
        settings=_settings(subject, codes, facts),
        found=_below(subject, travellers, found),
        body=fingerprint(body),
        source=str(subject.animation.GetPath()),
    )
    contacts = {name: contact for name, _, contact in contacts_of_feet(on_body, meanings)}
    return Recorded(luggage, body, character, contacts, subject)


def carry(
    travellers: Sequence[Traveller], ways: Mapping[str, Way]
) -> tuple[tuple[Traveller, ...], tuple[Left, ...]]:
    """Return constraints at the other end of a way, and those that stay behind."""
    there, left = [], []
    for each in travellers:
        try:
            there.append(carried(each, ways))
        except StaysBehind as why:
            left.append(Left(each.name, str(why)))
    return tuple(there), tuple(left)


def feet_of(body: Morphology) -> tuple[str, ...]:
    """Return the tokens of the ankles and balls of a body."""
    feet = [body.parts.joint(part) for part in FEET]
    return tuple(body.skeleton.joints[joint] for joint in feet if joint is not None)


def fingerprint(body: Morphology) -> str:
    """Return what tells a body from others: joints, their parts, where they are at rest."""
    shape = body.skeleton
    return hash_of(shape.joints, body.parts.parts, shape.rest_translations, shape.rest_rotations)


def _ways(
    stage: Usd.Stage, subject: Subject, sittings: Mapping[str, Sitting], name: str, facts: Facts
) -> dict[str, Way]:
    """Return the way off each body that takes part; only the subject's gets another name."""
    return {
        path: Way(
            Meanings.of(path, body, facts.up), False, f"/{name}" if path == subject.path else path
        )
        for path, body in bodies_of(stage, sittings)
    }


def _settings(subject: Subject, codes: Floats, facts: Facts) -> Settings:
    return Settings() if subject.edit is None else read_settings(subject.edit, codes, facts)


def _below(
    subject: Subject, travellers: Sequence[Traveller], found: Sequence[str]
) -> tuple[str, ...]:
    """Return the names of what stands below some detections."""
    above = _names(subject, found)
    return tuple(each.name for each in travellers if each.name.startswith(above)) if above else ()


def _names(subject: Subject, found: Sequence[str]) -> tuple[str, ...]:
    """Return what the names of what stands below some detections begin with."""
    edit = "" if subject.edit is None else str(subject.edit.GetPath())
    return tuple(f"{path}/".removeprefix(f"{edit}/") for path in found)
