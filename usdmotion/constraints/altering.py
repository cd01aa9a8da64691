"""Constraints and goals with other values, which are looked at before anybody uses them."""

import dataclasses
from typing import Any, TypeVar

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.constraints.constraint import Constraint
from usdmotion.constraints.goal import Goal
from usdmotion.errors import SceneError

_Value = TypeVar("_Value", Constraint, Goal)
_MODES = ("position", "offset")


def altered(value: _Value, frame_count: int, **fields: object) -> _Value:
    """Return a constraint or a goal with other values of some of its fields.

    Args:
        value: The constraint or goal.
        frame_count: How many values there are of what is said frame by frame.
        fields: New values by the names of the fields.

    Raises:
        SceneError: It has no such field, or the field cannot have such a value.
    """
    known = {each.name: each for each in dataclasses.fields(value)}
    for name in fields:
        if name not in known:
            names = ", ".join(known)
            raise SceneError(f"<{value.path}> has no '{name}' to be changed; it has {names}")
    fitted = {
        name: _fitted(value.path, known[name], new, frame_count) for name, new in fields.items()
    }
    return dataclasses.replace(value, **fitted)


def sound(value: _Value, frame_count: int) -> _Value:
    """Return a constraint or a goal with every field of the type that its kind has it of.

    Raises:
        SceneError: A field has a value that it cannot have.
    """
    fields = {each.name: getattr(value, each.name) for each in dataclasses.fields(value)}
    return altered(value, frame_count, **fields)


def _fitted(path: str, field: dataclasses.Field[Any], value: Any, frame_count: int) -> Any:
    """Return a value as one of the type of a field's default."""
    default = field.default
    if field.default_factory is not dataclasses.MISSING:
        default = field.default_factory()
    if field.metadata.get("attribute", {}).get("animated") and isinstance(default, float):
        default = np.array(default)
    try:
        return _like(default, field.name, value, frame_count)
    except (TypeError, ValueError) as error:
        told = f"<{path}> cannot have {_shown(value)} as its {field.name}"
        raise SceneError(f"{told}; give {_wanted(default, field.name, frame_count)}") from error


def _like(default: Any, name: str, value: Any, frame_count: int) -> Any:
    if isinstance(default, np.ndarray):
        return _array(default, value, frame_count)
    if name == "goals":
        goals = tuple(value)
        if not all(isinstance(goal, Goal) for goal in goals):
            raise TypeError(name)
        return tuple(sound(goal, frame_count) for goal in goals)
    if isinstance(default, tuple):
        numbers = tuple(each if isinstance(each, str) else float(each) for each in value)
        if name == "times" and (len(numbers) not in (0, 2, 4) or list(numbers) != sorted(numbers)):
            raise ValueError(name)
        return numbers
    if isinstance(default, (bool, int)):
        if value != int(value):
            raise ValueError(name)
        return type(default)(value)
    if isinstance(default, float):
        if not np.isfinite(value):
            raise ValueError(name)
        return float(value)
    wanted = str if default is dataclasses.MISSING else type(default)
    if default is not None and not isinstance(value, wanted):
        raise TypeError(name)
    if name == "mode" and value not in _MODES:
        raise ValueError(name)
    return value


def _array(default: Floats, value: Any, frame_count: int) -> Floats | float:
    """Return a number or an array like a default, or such a one for each frame."""
    array = np.array(value, dtype=np.float64)
    shape = array.shape[array.ndim - default.ndim :]
    fits = shape == default.shape or (0 in default.shape and shape[1:] == default.shape[1:])
    if not fits or array.shape[: array.ndim - default.ndim] not in ((), (frame_count,)):
        raise ValueError(array.shape)
    if not np.isfinite(array).all():
        raise ValueError("not finite")
    if default.shape == (4,):
        lengths = np.linalg.norm(array, axis=-1, keepdims=True)
        if not (lengths > 0.0).all():
            raise ValueError("no rotation")
        array /= lengths
    return array if array.ndim else float(array)


def _wanted(default: Any, name: str, frame_count: int) -> str:
    """Return what would do, in a few words."""
    if isinstance(default, np.ndarray):
        size = "x".join(str(length or "n") for length in default.shape)
        many = f"{size} numbers" if size else "a number"
        return f"{many}, or {many} for each of the {frame_count} frames"
    if name == "goals":
        return "a list of goals"
    if name == "times":
        return "none, two, or t0 t1 t2 t3, the earliest first"
    if name == "mode":
        return " or ".join(_MODES)
    if isinstance(default, tuple):
        return "a list"
    kinds = {bool: "true or false", int: "a whole number", float: "a number"}
    return kinds.get(type(default), "text" if isinstance(default, str) else "what its kind has")


def _shown(value: object) -> str:
    """Return a value as it stands in a sentence."""
    if isinstance(value, np.ndarray):
        return f"an array of the shape {value.shape}"
    text = repr(value)
    return text if len(text) < 60 else f"a {type(value).__name__} like this"
