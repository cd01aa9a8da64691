"""The contacts of a detection that are on a stage, and whose they are."""

from typing import Any

import numpy as np
from pxr import Sdf, Usd

from usdmotion.arrays import Floats
from usdmotion.curves import plateau
from usdmotion.usd.detections.keeping import Interval, Known, State
from usdmotion.usd.relations import floats, is_a, value

MEMORY = "usdmotion"
"""Key of custom data under which prims of a detection keep what was written of them."""
WORLD = "World"
"""Name of the prim beside contacts whose frame is the world's."""
REMEMBERED = ("kind", "joint", "times", "point", "location", "orientation", "axis")
"""Attributes, without their namespace, that say what a contact is."""
_SAME = 1e-6
"""Values that differ by less, relative or absolute, were not changed: some are single precision."""


def contact_prims(detection: Usd.Prim) -> list[Usd.Prim]:
    """Return the contacts of a detection, those that are switched off too."""
    return [prim for prim in detection.GetAllChildren() if is_a(prim, "UsdMotionContactConstraint")]


def known_contact(prim: Usd.Prim, span: tuple[float, float]) -> Known:
    """Return when a contact holds, and whose it is.

    Args:
        prim: The contact.
        span: First and last time code of the motion.
    """
    state = _state(prim)
    kind = str(value(prim, "usdmotion:kind", "space"))
    held = Interval(kind, *plateau(floats(value(prim, "usdmotion:times", ())), span))
    example = floats(_memory_of(prim).get("example", ()))
    if state == "template" and len(example) == 2 and _as_written(prim, ("times",)):
        held = Interval(kind, example[0], example[1])
    return Known(prim.GetName(), state, held)


def _memory_of(prim: Usd.Prim) -> dict[str, Any]:
    """Return what was written of a contact when it was detected, by the names of attributes."""
    memory = prim.GetCustomDataByKey(MEMORY)
    return memory if isinstance(memory, dict) else {}


def says_where(prim: Usd.Prim) -> bool:
    """Tell whether a contact says where it is held, and not only when."""
    names = ("usdmotion:location", "usdmotion:orientation")
    return any(prim.GetAttribute(name).HasAuthoredValue() for name in names)


def _state(prim: Usd.Prim) -> State:
    memory = _memory_of(prim)
    untouched = bool(memory) and _as_written(prim, REMEMBERED) and _in_its_place(prim)
    if not prim.IsActive():
        return "dropped" if untouched and memory.get("dropped") else "off"
    if value(prim, "usdmotion:template", False):
        return "template"
    # What was dropped, and is on again, somebody has switched on.
    return "detected" if untouched and not memory.get("dropped") else "own"


def _as_written(prim: Usd.Prim, names: tuple[str, ...]) -> bool:
    memory = _memory_of(prim)
    return all(
        name in memory and _same(value(prim, f"usdmotion:{name}"), memory[name]) for name in names
    )


def _in_its_place(prim: Usd.Prim) -> bool:
    """Tell whether a contact is in the frame in which contacts are written."""
    targets = prim.GetRelationship("usdmotion:space").GetTargets()
    return targets in ([], [prim.GetParent().GetPath().AppendChild(WORLD)])


def _same(now: Any, then: Any) -> bool:
    if isinstance(then, str):
        return str(now) == then
    one, other = _numbers(now), _numbers(then)
    return one.shape == other.shape and np.allclose(one, other, rtol=_SAME, atol=_SAME)


def _numbers(held: Any) -> Floats:
    if hasattr(held, "GetImaginary"):
        return np.array([held.GetReal(), *held.GetImaginary()])
    if isinstance(held, Sdf.TimeCode):
        return np.array([float(held)])
    return np.array([float(number) for number in held] if held is not None else [])
