"""One contact as the spec of a prim, and what is remembered of it."""

from typing import Any

import numpy as np
from pxr import Gf, Sdf, Usd

from usdmotion.arrays import Floats
from usdmotion.detecting import Contact
from usdmotion.usd.attribute_authoring import time_code_array
from usdmotion.usd.detections.contact_prims import MEMORY, REMEMBERED, WORLD, says_where
from usdmotion.usd.detections.entries import Entry
from usdmotion.usd.detections.frames import Frame
from usdmotion.usd.detections.searches import Sought
from usdmotion.usd.layers import over, relate, set_value
from usdmotion.usd.relations import value

_TYPES = {
    "kind": Sdf.ValueTypeNames.Token,
    "joint": Sdf.ValueTypeNames.Token,
    "times": Sdf.ValueTypeNames.TimeCodeArray,
    "point": Sdf.ValueTypeNames.Point3d,
    "location": Sdf.ValueTypeNames.Point3d,
    "orientation": Sdf.ValueTypeNames.Quatd,
    "axis": Sdf.ValueTypeNames.Vector3f,
    "residual": Sdf.ValueTypeNames.Double,
    "template": Sdf.ValueTypeNames.Bool,
}


def author_contact(
    layer: Sdf.Layer, sought: Sought, entry: Entry, frame: Frame, *, wake: bool = False
) -> None:
    """Write a contact, made where it is not there yet.

    Args:
        layer: Where.
        sought: What was looked for, and on what.
        entry: The contact.
        frame: The frame above it.
        wake: Whether it is to be switched on.
    """
    assert entry.contact is not None
    prim = over(layer, f"{sought.path}/{entry.name}")
    if entry.new:
        define_spec(prim, "MotionContactConstraint")
        if entry.priority != 1:
            set_value(prim, "usdmotion:priority", Sdf.ValueTypeNames.Int, entry.priority)
    elif wake:
        prim.SetInfo("active", True)
    values = _values(sought, entry, entry.contact, frame)
    for name, held in values.items():
        set_value(prim, f"usdmotion:{name}", _TYPES[name], held)
    if sought.watched.prim is not None:
        relate(prim, "usdmotion:object", sought.object)
    if frame.is_world:
        relate(prim, "usdmotion:space", f"{sought.path}/{WORLD}")
    _remember(prim, values, entry)


def standing(prim: Usd.Prim, sought: Sought, entry: Entry, frame: Frame) -> Contact | None:
    """Return what a contact that is left as it is holds; None where that cannot be told.

    Args:
        prim: The contact.
        sought: What was looked for, and on what.
        entry: It as it is known.
        frame: The frame above it.
    """
    beside = prim.GetParent().GetPath().AppendChild(WORLD)
    target = prim.GetRelationship("usdmotion:space").GetTargets()
    if not says_where(prim) or target != ([beside] if frame.is_world else []):
        return None
    turn = value(prim, "usdmotion:orientation")
    middle = 0.5 * (entry.interval.start + entry.interval.end)
    units = sought.trajectory.units_at(middle)
    inside = np.array(value(prim, "usdmotion:location"))
    return Contact(
        kind=str(value(prim, "usdmotion:kind")),
        start=0.0,
        end=0.0,
        point=np.array(value(prim, "usdmotion:point")) * units,
        location=frame.world_point(inside) * sought.facts.meters_per_unit,
        orientation=frame.world_orientation(np.array([*turn.GetImaginary(), turn.GetReal()])),
    )


def drop(layer: Sdf.Layer, sought: Sought, entry: Entry) -> None:
    """Switch off a contact that was not found again; it is remembered who did it."""
    prim = over(layer, f"{sought.path}/{entry.name}")
    prim.SetInfo("active", False)
    prim.customData[MEMORY] = {**prim.customData.get(MEMORY, {}), "dropped": True}


def define_spec(prim: Sdf.PrimSpec, schema: str) -> None:
    """Make a spec that of a prim of a schema class that nobody renders."""
    prim.specifier = Sdf.SpecifierDef
    prim.typeName = schema
    set_value(prim, "purpose", Sdf.ValueTypeNames.Token, "guide")


def _remember(prim: Sdf.PrimSpec, values: dict[str, Any], entry: Entry) -> None:
    """Keep what was written of a contact, to tell later what a person has changed."""
    example = entry.example
    codes = (example.start, example.end) if example and entry.state == "template" else ()
    memory = {name: values[name] for name in REMEMBERED}
    # Dictionaries of several layers are one, so that every key has to be said.
    memory |= {"dropped": False, "example": time_code_array(codes)}
    prim.customData[MEMORY] = memory


def _values(sought: Sought, entry: Entry, contact: Contact, frame: Frame) -> dict[str, Any]:
    unit = sought.facts.meters_per_unit
    middle = 0.5 * (entry.interval.start + entry.interval.end)
    turned = frame.orientation(contact.orientation)
    values = {
        "kind": contact.kind,
        "joint": sought.watched.joint,
        "times": time_code_array(entry.times),
        "point": _vector(contact.point / sought.trajectory.units_at(middle)),
        "location": _vector(frame.point(contact.location / unit)),
        "orientation": Gf.Quatd(float(turned[3]), *(float(each) for each in turned[:3])),
        "axis": Gf.Vec3f(*(float(each) for each in frame.direction(contact.axis))),
        "residual": contact.residual / unit,
    }
    return values | ({"template": True} if entry.state == "template" else {})


def _vector(values: Floats) -> Gf.Vec3d:
    return Gf.Vec3d(*(float(each) for each in values))
