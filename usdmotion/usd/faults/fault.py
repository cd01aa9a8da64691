"""One fault of a stage, and one check that finds some."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Literal

from pxr import Tf, Usd

Severity = Literal["error", "warning", "note"]


@dataclass(frozen=True, slots=True)
class Fault:
    """Something on a stage that cannot be right."""

    path: str
    """Path of the prim."""
    name: str
    """What kind of fault it is, for a machine: `UnknownJoint`."""
    sentence: str
    """What is wrong, naming the prim, and what would do."""
    severity: Severity = "error"
    """An error keeps the stage from being solved; a warning says what is probably not meant; a note
    what may be as it is, and that one should know."""


@dataclass(frozen=True, slots=True)
class StageCheck:
    """A function that looks at a stage as a whole."""

    name: str
    """Name of the validator in USD, without its plugin."""
    find: Callable[[Usd.Stage], Iterable[Fault]]
    """The check itself; its docstring is the validator's."""


@dataclass(frozen=True, slots=True)
class Check:
    """A function that looks at one prim."""

    name: str
    """Name of the validator in USD, without its plugin."""
    types: tuple[str, ...]
    """TfTypes of the prims it looks at, and of the API schemas they have applied."""
    find: Callable[[Usd.Prim], Iterable[Fault]]
    """The check itself; its docstring is the validator's."""

    def concerns(self, prim: Usd.Prim) -> bool:
        """Tell whether it looks at such a prim."""
        types = (Tf.Type.FindByName(name) for name in self.types)
        return any(bool(prim.IsA(kind) or prim.HasAPI(kind)) for kind in types)


def note(prim: Usd.Prim, name: str, what: str) -> Fault:
    """Return a note on a prim; `what` goes on where the prim's path ends."""
    return Fault(str(prim.GetPath()), name, f"<{prim.GetPath()}> {what}", "note")


def error(prim: Usd.Prim, name: str, what: str) -> Fault:
    """Return an error of a prim; `what` goes on where the prim's path ends."""
    return Fault(str(prim.GetPath()), name, f"<{prim.GetPath()}> {what}")


def warning(prim: Usd.Prim, name: str, what: str) -> Fault:
    """Return a warning about a prim; `what` goes on where the prim's path ends."""
    return Fault(str(prim.GetPath()), name, f"<{prim.GetPath()}> {what}", "warning")
