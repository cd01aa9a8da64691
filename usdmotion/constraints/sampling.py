"""What is said frame by frame, cut down to some of the frames."""

import dataclasses
from functools import cache
from typing import Any, TypeVar

import numpy as np

_Value = TypeVar("_Value")


def during(value: _Value, frames: slice) -> _Value:
    """Return a constraint, a goal or a space as it is on some of the frames.

    A field with one axis more than its default has a value for each frame, as in every kind; what
    is said once for the whole clip stays as it is.
    """
    kind: type = type(value)
    cut = {name: _cut(getattr(value, name), axes, frames) for name, axes in axes_of(kind)}
    changed = {name: new for name, new in cut.items() if new is not getattr(value, name)}
    return dataclasses.replace(value, **changed) if changed else value  # type: ignore[type-var]


@cache
def axes_of(kind: type) -> tuple[tuple[str, int], ...]:
    """Return the fields of a kind, with how many axes each has where it is the same throughout."""
    return tuple(
        (field.name, np.ndim(default) if isinstance(default := _default(field), np.ndarray) else 0)
        for field in dataclasses.fields(kind)
    )


def _default(field: dataclasses.Field[Any]) -> Any:
    if field.default_factory is not dataclasses.MISSING:
        return field.default_factory()
    return field.default


def _cut(value: Any, axes: int, frames: slice) -> Any:
    if isinstance(value, np.ndarray):
        return value[frames] if value.ndim > axes else value
    if isinstance(value, tuple):
        parts = tuple(_cut(part, 0, frames) for part in value)
        return (
            parts if any(new is not old for new, old in zip(parts, value, strict=True)) else value
        )
    return during(value, frames) if dataclasses.is_dataclass(value) else value
