"""The searches that a stage and somebody's words ask for: plain values for a detector."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from pxr import Usd

from usdmotion.arrays import Floats
from usdmotion.asking import Asked, Example
from usdmotion.detecting import KINDS, Search, Template
from usdmotion.errors import OptionError, SceneError
from usdmotion.usd.bindings import holder_of
from usdmotion.usd.constraints import constraint_prims
from usdmotion.usd.detections.contact_prims import contact_prims, known_contact
from usdmotion.usd.detections.joints import leaf_of
from usdmotion.usd.detections.keeping import Interval, Known
from usdmotion.usd.detections.noise_patterns import read_pattern
from usdmotion.usd.detections.objects import Watched, find_watched, objects_of
from usdmotion.usd.detections.places import Place, Places
from usdmotion.usd.detections.survey import Survey
from usdmotion.usd.detections.trajectories import Trajectory, read_trajectory
from usdmotion.usd.edits import options_of
from usdmotion.usd.faults.detections import find_idle_detections
from usdmotion.usd.relations import is_a, value
from usdmotion.usd.shot import Facts

DEFAULT_DETECTOR = "contacts"
"""What looks where nobody names a detector."""
_SLACK = 1e-6
"""How far a time code may be beside a clip that it is inside of."""


@dataclass(frozen=True, eq=False)
class Sought:
    """A search on a stage, and where what is found is to be written."""

    search: Search
    detector: str
    """Registered name of the detector."""
    options: Mapping[str, object]
    """Options that it is to have."""
    watched: Watched
    place: Place
    trajectory: Trajectory
    known: tuple[Known, ...]
    """The contacts that are there, and examples that are to be."""
    asked: Asked
    facts: Facts
    notes: tuple[str, ...] = ()

    @property
    def path(self) -> str:
        """Path of the MotionDetection."""
        return self.place.path

    @property
    def object(self) -> str:
        """The joint's token, or the prim's path."""
        path, joint = self.watched.key
        return joint or path


def read_searches(stage: Usd.Stage, asked: Asked) -> tuple[Sought, ...]:
    """Return what is to be looked for on a stage, object by object.

    What is asked for in words wins over what the detections of the stage say.

    Raises:
        SceneError: Something that is named is not there or cannot be read.
        OptionError: An example is outside of the motion, or of a kind that there is not.
    """
    survey = Survey(stage, asked.edit, asked.skeletons)
    examples: dict[tuple[str, str], list[Example]] = {}
    for example in asked.templates:
        for each in objects_of(survey, example.object):
            examples.setdefault(each.key, []).append(example)
    places = Places(stage)
    return tuple(
        _sought(survey, asked, watched, places.of(watched), examples.get(watched.key, ()))
        for watched in find_watched(survey, asked)
    )


def _sought(
    survey: Survey, asked: Asked, watched: Watched, place: Place, examples: Sequence[Example]
) -> Sought:
    facts = survey.facts
    trajectory = _trajectory(watched, facts)
    known = (*_known(watched, trajectory), *_new(examples, watched, trajectory))
    taken = _without_repeats(known)
    detector, options = _detector(watched.detection, asked)
    name = leaf_of(watched.joint) if watched.joint else str(watched.key[0])
    search = Search(
        name=name,
        times=_seconds(trajectory.time_codes, trajectory, facts),
        translations=trajectory.translations,
        rotations=trajectory.rotations,
        points=trajectory.points,
        up=survey.up,
        ground=trajectory.ground,
        kinds=_kinds(watched.detection, asked, taken),
        templates=_templates(taken, place, trajectory, facts),
        **_settings(watched.detection, asked, trajectory, facts),
    )
    notes = (*_notes(watched), *_not_sought(taken, search))
    return Sought(search, detector, options, watched, place, trajectory, taken, asked, facts, notes)


def _trajectory(watched: Watched, facts: Facts) -> Trajectory:
    if watched.performer is not None:
        return watched.performer.trajectory(watched.joint)
    return read_trajectory(watched.prim, facts)


def _known(watched: Watched, trajectory: Trajectory) -> tuple[Known, ...]:
    if watched.detection is None:
        return ()
    span = float(trajectory.time_codes[0]), float(trajectory.time_codes[-1])
    return tuple(known_contact(prim, span) for prim in contact_prims(watched.detection))


def _new(
    examples: Sequence[Example], watched: Watched, trajectory: Trajectory
) -> tuple[Known, ...]:
    first, last = trajectory.time_codes[0], trajectory.time_codes[-1]
    for each in examples:
        words = f"--template {each.object}:{each.start:g}:{each.end:g}"
        if each.kind not in KINDS:
            raise OptionError(f"{words}:{each.kind} is of no kind; it may be {', '.join(KINDS)}")
        if not each.start <= each.end:
            raise OptionError(f"{words} ends before it starts; write the earlier time first")
        if each.start < first - _SLACK or each.end > last + _SLACK:
            raise OptionError(
                f"{words} is outside of the motion of {watched.joint or watched.key[0]}, which is "
                f"from {first:g} to {last:g}; give times within"
            )
    return tuple(
        Known("", "template", Interval(each.kind, each.start, each.end)) for each in examples
    )


def _without_repeats(known: Sequence[Known]) -> tuple[Known, ...]:
    """Leave out new examples that are there already."""
    there = [each.interval for each in known if each.name and each.state == "template"]
    kept: list[Known] = []
    for each in known:
        if each.name or each.interval not in there:
            kept.append(each)
            there += [] if each.name else [each.interval]
    return tuple(kept)


def _templates(
    known: Sequence[Known], place: Place, trajectory: Trajectory, facts: Facts
) -> tuple[Template, ...]:
    codes = trajectory.time_codes
    found = []
    for each in sorted(known, key=lambda one: (one.interval.start, one.interval.end)):
        if each.state != "template":
            continue
        ends = np.clip([each.interval.start, each.interval.end], codes[0], codes[-1])
        if each.interval.end < codes[0] - _SLACK or each.interval.start > codes[-1] + _SLACK:
            raise SceneError(
                f"the template <{place.path}/{each.name}> is from {each.interval.start:g} to "
                f"{each.interval.end:g}, outside of the motion, which is from {codes[0]:g} to "
                f"{codes[-1]:g}; move or deactivate it"
            )
        start, end = _seconds(ends, trajectory, facts)
        found.append(Template(each.interval.kind, float(start), float(end)))
    return tuple(found)


def _detector(prim: Usd.Prim | None, asked: Asked) -> tuple[str, dict[str, object]]:
    """Return the name of a detector and the options that it is to have."""
    said = str(value(prim, "usdmotion:detector", "")) if prim else ""
    carried = options_of(prim) if prim else {}
    before = said or DEFAULT_DETECTOR
    name = asked.detector or before
    # What a prim carries are options of the detector that it names, and of no other.
    return name, (carried if name == before else {}) | dict(asked.options)


def _kinds(prim: Usd.Prim | None, asked: Asked, known: Sequence[Known]) -> tuple[str, ...]:
    if asked.kinds:
        return asked.kinds
    if prim and prim.GetAttribute("usdmotion:kinds").HasAuthoredValue():
        return tuple(str(kind) for kind in value(prim, "usdmotion:kinds", ()))
    # Who shows what a line is wants lines to be found.
    shown = (each.interval.kind for each in known if each.state == "template")
    return tuple(dict.fromkeys(("space", *shown)))


def _settings(
    prim: Usd.Prim | None, asked: Asked, trajectory: Trajectory, facts: Facts
) -> dict[str, Any]:
    """Return the fields of a search that a detection has set."""
    unit = facts.meters_per_unit
    names = {
        "step": ("step", 1.0),
        "parallel_angle": ("parallelAngle", 1.0),
        "merge_distance": ("mergeDistance", unit),
        "gap": ("gap", 1.0),
        "gap_distance": ("gapDistance", unit),
        "minimum": ("minimum", 1.0),
    }
    found: dict[str, Any] = {}
    for field, (name, scale) in names.items() if prim else ():
        number = float(value(prim, f"usdmotion:{name}", 0.0))
        if number:
            found[field] = number * scale
    if asked.minimum is not None:
        found["minimum"] = asked.minimum
    if prim:
        found["pattern"] = read_pattern(prim, trajectory.time_codes, facts)
    return found


def _notes(watched: Watched) -> tuple[str, ...]:
    """Return what is probably not meant of a detection."""
    found = find_idle_detections(watched.detection) if watched.detection is not None else ()
    idle = (each.sentence for each in found if each.name in ("TwoObjects", "HalfAPattern"))
    return (*idle, *_rivals(watched), *_unsolvable(watched))


def _unsolvable(watched: Watched) -> Iterator[str]:
    """Yield why an edit of a joint's skeleton could not be solved, if so."""
    try:
        if watched.performer is not None:
            holder_of(watched.performer.prim)
    except SceneError as error:
        yield f"contacts are found, but cannot be solved as it is: {error}"


def _not_sought(known: Sequence[Known], search: Search) -> Iterator[str]:
    """Yield a sentence about each example of what is not looked for."""
    for each in known:
        held = each.interval
        if each.state == "template" and held.kind not in search.kinds:
            yield (
                f"the example of '{search.name}' from {held.start:g} to {held.end:g} is of the "
                f"kind '{held.kind}', which is not looked for; to find more of it add "
                f"{held.kind} to --kinds, or to usdmotion:kinds"
            )


def _rivals(watched: Watched) -> Iterator[str]:
    """Yield a sentence about each constraint that holds a joint whose contacts are looked for."""
    edit = watched.performer.edit if watched.performer is not None else None
    for prim in constraint_prims(edit) if edit is not None else ():
        holds = str(value(prim, "usdmotion:joint", "")) == watched.joint
        if holds and not is_a(prim.GetParent(), "UsdMotionDetection"):
            yield (
                f"<{prim.GetPath()}> holds the joint '{leaf_of(watched.joint)}' as well; where it "
                "asks for another place than its contacts do, deactivate one or the other"
            )


def _seconds(codes: Floats, trajectory: Trajectory, facts: Facts) -> Floats:
    return np.asarray((codes - trajectory.time_codes[0]) / facts.time_codes_per_second)
