"""Options of a plugin: dataclass fields that carry their own documentation and limits."""

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

from usdmotion.errors import OptionError

_Plugin = TypeVar("_Plugin")
_TRUE = {"1", "true", "yes", "on"}
_FALSE = {"0", "false", "no", "off"}


@dataclass(frozen=True, slots=True)
class Option:
    """One option of a plugin, as the command line, a stage and an editor need to know it."""

    name: str
    default: bool | int | float | str
    doc: str
    minimum: float = -math.inf
    maximum: float = math.inf
    choices: tuple[str, ...] = ()

    def parse(self, value: object) -> bool | int | float | str:
        """Return a value of the option's type, from a value of it or from text.

        Raises:
            OptionError: The value is of another type or outside the limits.
        """
        parsed = _parsed(value, type(self.default))
        if parsed is None:
            raise OptionError(f"option '{self.name}' is {value!r}, not {self.allowed}")
        outside = isinstance(parsed, (int, float)) and not self.minimum <= parsed <= self.maximum
        if outside or (self.choices and parsed not in self.choices):
            raise OptionError(f"option '{self.name}' is {value!r}, not {self.allowed}")
        return parsed

    @property
    def allowed(self) -> str:
        """What values it can have, in a few words."""
        if self.choices:
            return "one of " + ", ".join(self.choices)
        kind = {bool: "true or false", int: "a whole number", float: "a number", str: "text"}
        wanted = kind[type(self.default)]
        if math.isfinite(self.minimum):
            wanted += f" of at least {self.minimum:g}"
        if math.isfinite(self.maximum):
            wanted += f", at most {self.maximum:g}"
        return wanted


def option(
    default: bool | int | float | str,
    doc: str,
    *,
    minimum: float = -math.inf,
    maximum: float = math.inf,
    choices: tuple[str, ...] = (),
) -> Any:
    """Declare a dataclass field of a plugin as an option.

    Args:
        default: Value where nobody says otherwise; its type is the option's.
        doc: One sentence, with the unit.
        minimum: Smallest number allowed.
        maximum: Largest number allowed.
        choices: Texts allowed; empty allows any.
    """
    details = {"doc": doc, "minimum": minimum, "maximum": maximum, "choices": choices}
    return dataclasses.field(default=default, metadata={"option": details})


def options(plugin: type) -> tuple[Option, ...]:
    """Return the options of a plugin class, in the order of its fields."""
    if not dataclasses.is_dataclass(plugin):
        return ()
    return tuple(
        Option(field.name, field.default, **field.metadata["option"])  # type: ignore[arg-type]
        for field in dataclasses.fields(plugin)
        if "option" in field.metadata
    )


def configured(plugin: type[_Plugin], values: Mapping[str, object]) -> _Plugin:
    """Return an instance of a plugin class with some options set.

    Raises:
        OptionError: A name is unknown or a value is not allowed.
    """
    known = {each.name: each for each in options(plugin)}
    for name in values:
        if name not in known:
            names = ", ".join(known) or "none"
            plugin_name = getattr(plugin, "name", plugin.__name__)
            raise OptionError(f"'{plugin_name}' has no option '{name}'; it has: {names}")
    return plugin(**{name: known[name].parse(value) for name, value in values.items()})


def _parsed(value: object, kind: type) -> bool | int | float | str | None:
    if kind is bool:
        text = str(value).lower()
        return True if text in _TRUE else False if text in _FALSE else None
    if kind is str:
        return str(value)
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        return None
    if isinstance(value, bool) or not math.isfinite(number):
        return None
    if kind is int:
        return int(number) if number == int(number) else None
    return number
