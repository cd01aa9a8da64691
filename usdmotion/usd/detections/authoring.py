"""What was found, written on a stage: detections, their noise patterns, their contacts."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from pxr import Sdf, Usd, UsdGeom, Vt

from usdmotion.detecting import Detected
from usdmotion.usd.detections.agreeing import agreed
from usdmotion.usd.detections.contact_authoring import author_contact, define_spec, drop, standing
from usdmotion.usd.detections.contact_prims import WORLD, contact_prims, says_where
from usdmotion.usd.detections.entries import Entry, entries_of, interval_of
from usdmotion.usd.detections.frames import Frame, Frames
from usdmotion.usd.detections.noise_patterns import author_pattern
from usdmotion.usd.detections.searches import Sought
from usdmotion.usd.layers import over, relate, set_value
from usdmotion.usd.provenance import hash_of

_TYPES = Sdf.ValueTypeNames
_OPTION_TYPES = {bool: _TYPES.Bool, int: _TYPES.Int, float: _TYPES.Double, str: _TYPES.Token}
_OPTION = "usdmotion:option:"
_LEFT = ("own", "template")
"""Contacts that hold and may be left as they are."""


@dataclass(frozen=True, eq=False)
class Found:
    """What a detector found on one object."""

    sought: Sought
    detected: Detected
    options: Mapping[str, bool | int | float | str]
    """All options that it ran with."""

    @property
    def given_by(self) -> Literal["templates", "prim", "estimate"]:
        """Where the noise pattern is from: templates, if one was of use, win over the prim."""
        search = self.sought.search
        if any(each not in self.detected.left_out for each in search.templates):
            return "templates"
        return "estimate" if search.pattern is None else "prim"


@dataclass(frozen=True, eq=False)
class Authored:
    """What has become of the contacts of one object."""

    found: Found
    entries: tuple[Entry, ...]
    """In the order of their times."""
    notes: tuple[str, ...]
    """One sentence about each thing that whoever asked should know."""


def author_detections(stage: Usd.Stage, found: Sequence[Found]) -> tuple[Authored, ...]:
    """Write what was found on the objects of a stage, in its edit target.

    Args:
        stage: The stage that was searched; its edit target is its strongest layer.
        found: What was found on each object.
    """
    frames = Frames(stage)
    above = [frames.above(each.sought.path, each.sought.trajectory.time_codes) for each in found]
    pairs = zip(found, above, strict=True)
    settled = agreed([_settled(each, frame) for each, frame in pairs])
    layer = stage.GetEditTarget().GetLayer()
    with Sdf.ChangeBlock():
        for each, frame in zip(settled, above, strict=True):
            sought = each.found.sought
            _author_detection(stage, layer, each.found)
            if frame.is_world:
                _author_world(layer, f"{sought.path}/{WORLD}")
            for entry in each.entries:
                on = entry.new or _is_on(stage, sought, entry)
                if entry.contact is not None:
                    author_contact(layer, sought, entry, frame, wake=not on)
                elif entry.state == "dropped" and on:
                    drop(layer, sought, entry)
    for each in settled:
        _author_pattern(stage, each.found)
    return settled


def _settled(found: Found, frame: Frame) -> Authored:
    sought = found.sought
    there = contact_prims(sought.watched.detection) if sought.watched.detection else []
    beside = sought.watched.detection.GetAllChildren() if sought.watched.detection else []
    entries, notes = entries_of(
        sought.known,
        found.detected.contacts,
        sought.trajectory,
        sought.facts,
        names=[prim.GetName() for prim in beside],
        placeless=[prim.GetName() for prim in there if not says_where(prim)],
    )
    said = (*found.detected.notes, *_lessons(found), *notes)
    told = (f"<{sought.path}>: {note}" for note in said)
    by_name = {prim.GetName(): prim for prim in there}
    whole = tuple(
        replace(each, there=standing(by_name[each.name], sought, each, frame))
        if each.contact is None and each.name in by_name and each.state in _LEFT
        else each
        for each in entries
    )
    return Authored(found, whole, (*sought.notes, *told))


def _lessons(found: Found) -> Iterator[str]:
    """Yield a sentence about each example that has taught the detector nothing."""
    sought = found.sought
    for template, reason in found.detected.left_out.items():
        held = interval_of(template, sought.trajectory, sought.facts)
        yield (
            f"nothing is learnt from the example from {held.start:g} to {held.end:g}, which is "
            f"marked all the same: {reason}"
        )


def _author_detection(stage: Usd.Stage, layer: Sdf.Layer, found: Found) -> None:
    sought = found.sought
    prim = over(layer, sought.path)
    if sought.watched.detection is None:
        _author_above(stage, layer, sought)
        define_spec(prim, "MotionDetection")
        if sought.watched.prim is not None:
            relate(prim, "usdmotion:object", sought.object)
        else:
            set_value(prim, "usdmotion:joint", _TYPES.Token, sought.watched.joint)
    asked = sought.asked
    if asked.kinds:
        kinds = Vt.TokenArray(list(asked.kinds))
        set_value(prim, "usdmotion:kinds", _TYPES.TokenArray, kinds)
    if asked.detector:
        set_value(prim, "usdmotion:detector", _TYPES.Token, asked.detector)
    if asked.minimum is not None:
        set_value(prim, "usdmotion:minimum", _TYPES.Double, float(asked.minimum))
    _author_options(prim, found)


def _author_above(stage: Usd.Stage, layer: Sdf.Layer, sought: Sought) -> None:
    """Make the edit or the scope that a new detection stands in, where it is not there."""
    path, place = Sdf.Path(sought.path).GetParentPath(), sought.place
    if not place.parent_type or stage.GetPrimAtPath(path):
        return
    above = over(layer, str(path))
    if place.parent_type == "MotionEdit":
        define_spec(above, "MotionEdit")
        if place.skeleton:
            relate(above, "usdmotion:skeleton", place.skeleton)
    else:
        above.specifier = Sdf.SpecifierDef
        above.typeName = place.parent_type


def _author_options(prim: Sdf.PrimSpec, found: Found) -> None:
    """Write the options that were asked for in words, and block those of another detector."""
    for name in found.sought.asked.options:
        value = found.options[name]
        set_value(prim, f"{_OPTION}{name}", _OPTION_TYPES[type(value)], value)
    detection = found.sought.watched.detection
    for attribute in detection.GetAuthoredAttributes() if detection else ():
        name = attribute.GetName().removeprefix(_OPTION)
        if attribute.GetName().startswith(_OPTION) and name not in found.options:
            set_value(prim, attribute.GetName(), attribute.GetTypeName(), Sdf.ValueBlock())


def _author_world(layer: Sdf.Layer, path: str) -> None:
    """Make a prim whose frame is the world's, whatever those above it do."""
    prim = over(layer, path)
    prim.specifier = Sdf.SpecifierDef
    prim.typeName = "Xform"
    order = Vt.TokenArray([UsdGeom.XformOpTypes.resetXformStack])
    set_value(prim, "xformOpOrder", _TYPES.TokenArray, order)


def _is_on(stage: Usd.Stage, sought: Sought, entry: Entry) -> bool:
    return bool(stage.GetPrimAtPath(f"{sought.path}/{entry.name}").IsActive())


def _author_pattern(stage: Usd.Stage, found: Found) -> None:
    pattern = found.detected.pattern
    # One that somebody has given is his, and is not written over.
    if pattern is None or found.given_by == "prim":
        return
    author_pattern(
        stage.GetPrimAtPath(found.sought.path),
        pattern,
        float(found.sought.trajectory.time_codes[0]),
        found.sought.facts,
        estimated=found.given_by == "estimate",
    )


def detection_provenance(authored: Sequence[Authored], notes: Sequence[str]) -> dict[str, object]:
    """Return what a layer says of how its contacts were found.

    It is the detector of each object, its options, hashes of what it was given, and the notes.
    """
    found = [each.found for each in authored]
    told: dict[str, object] = {
        "detectors": {each.sought.path: each.sought.detector for each in found},
        "options": {each.sought.path: dict(each.options) for each in found},
        "hashes": {each.sought.path: hash_of(each.sought.search) for each in found},
    }
    return told | ({"notes": Vt.StringArray(list(notes))} if notes else {})
