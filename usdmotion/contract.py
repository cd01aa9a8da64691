"""What a plugin's classes have to be, checked before anything of theirs is used."""

from dataclasses import is_dataclass
from pathlib import Path

from usdmotion.constraints import Constraint, attributes
from usdmotion.errors import OptionError, PluginError
from usdmotion.options import options


def check_solver_kind(solver: object) -> None:
    """Raise PluginError unless this is a solver class with sound options."""
    _check_class(solver, "solver", "solve")
    start = getattr(solver, "start", None)
    if start is not None and not callable(start):
        raise PluginError(
            f"its solver '{getattr(solver, 'name', '')}' has a `start` that is no method; "
            "make it one that returns a Performance, or give it another name"
        )


def check_detector_kind(detector: object) -> None:
    """Raise PluginError unless this is a detector class with sound options."""
    _check_class(detector, "detector", "detect")


def check_reader_kind(reader: object) -> None:
    """Raise PluginError unless this is a reader class with sound options and suffixes."""
    _check_class(reader, "reader", "read")
    suffixes = getattr(reader, "suffixes", None)
    fine = isinstance(suffixes, tuple) and all(
        isinstance(each, str) and each.startswith(".") and each == each.lower() for each in suffixes
    )
    if not suffixes or not fine:
        raise PluginError(
            f"its reader {reader!r} has the suffixes {suffixes!r}; name some, "
            "as a tuple of lower-case endings with the dot"
        )


def _check_class(offered: object, kind: str, verb: str) -> None:
    if not isinstance(offered, type):
        raise PluginError(f"it registers {offered!r} as a {kind}, which is not a class")
    name = getattr(offered, "name", None)
    if not isinstance(name, str) or not name.isidentifier():
        raise PluginError(f"its {kind} {offered.__name__} needs a `name` that is an identifier")
    if not callable(getattr(offered, verb, None)):
        raise PluginError(f"its {kind} '{name}' has no method `{verb}`")
    _check_options(offered, f"{kind} '{name}'")
    try:
        offered()
    except Exception as error:
        raise PluginError(f"its {kind} '{name}' cannot be made by {name}(): {error}") from error


def _check_options(offered: type, owner: str) -> None:
    for option in options(offered):
        if not isinstance(option.default, (bool, int, float, str)):
            raise PluginError(f"its {owner} has an option '{option.name}' that is no plain value")
        if not option.doc.strip():
            raise PluginError(f"its {owner} does not say what the option '{option.name}' is")
        try:
            option.parse(option.default)
        except OptionError as error:
            raise PluginError(f"its {owner} has a default outside its limits: {error}") from error


def check_constraint_kind(kind: object) -> None:
    """Raise PluginError unless this is a constraint kind: a dataclass with schema and tasks."""
    if not isinstance(kind, type) or not issubclass(kind, Constraint):
        raise PluginError(f"it registers {kind!r} as a constraint, which is no Constraint class")
    schema = getattr(kind, "schema", None)
    if not isinstance(schema, str) or not schema.isidentifier():
        raise PluginError(f"its constraint {kind.__name__} needs the `schema` of its prims")
    if "__dataclass_params__" not in vars(kind) or not is_dataclass(kind):
        raise PluginError(f"its constraint '{schema}' is not a dataclass")
    if kind.tasks is Constraint.tasks:
        raise PluginError(f"its constraint '{schema}' has no method `tasks`")
    if kind.unit not in ("m", "deg"):
        raise PluginError(f"its constraint '{schema}' has the unit '{kind.unit}', not 'm' or 'deg'")
    attributes(kind)


def check_schema_folder(folder: object) -> None:
    """Raise PluginError unless this is a folder with a plugInfo.json."""
    if not isinstance(folder, Path) or not (folder / "plugInfo.json").is_file():
        raise PluginError(
            f"its schema {str(folder)!r} is not the path of a folder with plugInfo.json"
        )
