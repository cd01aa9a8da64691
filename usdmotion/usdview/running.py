"""A command is carried out: what it has to say is shown, and nothing that it raises gets out."""

import sys
import traceback
from dataclasses import dataclass, field
from typing import Any

from usdmotion.errors import UsdMotionError
from usdmotion.usdview.windows import Cancelled, Window

_OURS = "usdmotion"


@dataclass(eq=False)
class Desk:
    """What is kept between commands, for as long as usdview runs."""

    destination: str = "to_session"
    """Verb of the item of the submenu that is in force."""
    layer: str = ""
    """Path of the layer file that somebody chose."""
    shot: str = ""
    """Identifier of the root layer of the stage for which it was chosen."""
    marks: dict[str, Any] = field(default_factory=dict)
    """The actions of the submenu, by verb; empty in older releases."""
    busy: bool = False
    """Whether a command is going on, so that no other may begin."""

    def mark(self) -> None:
        """Tick the item of the submenu that is in force."""
        for verb, action in self.marks.items():
            action.setCheckable(True)
            action.setChecked(verb == self.destination)


def run(verb: str, desk: Desk, api: Any) -> None:
    """Carry out a command.

    Args:
        verb: Name of its function.
        desk: What is kept between commands.
        api: What usdview offers its plugins.
    """
    if desk.busy:  # picked while events are looked after during long work
        return
    desk.busy = True
    try:
        told = _told(verb, desk, api)
    finally:
        desk.busy = False
        desk.mark()
    api.UpdateGUI()
    api.PrintStatus(told)


def _told(verb: str, desk: Desk, api: Any) -> str:
    """Return what became of a command, in a sentence; a fault is shown as well."""
    try:
        from usdmotion.usdview import commands
        from usdmotion.usdview.here import Here

        return str(getattr(commands, verb)(Here.of(api, desk)))
    except Cancelled:
        return "nothing was done"
    except Exception as error:
        sentence = _sentence(error)
    Window(api).refuse(sentence)
    return sentence


def _sentence(error: Exception) -> str:
    """Return what a fault is, as the command line says it; what is nobody's fault but ours too."""
    if isinstance(error, UsdMotionError):
        return str(error)
    if isinstance(error, ModuleNotFoundError) and not str(error.name).startswith(_OURS):
        return (
            f"the Python of usdview has no package '{error.name}', which usdmotion needs; install "
            "it there with pip"
        )
    traceback.print_exception(error, file=sys.stderr)
    said = " ".join(str(error).split())
    return (
        f"this is a bug in usdmotion ({type(error).__name__}: {said[:200]}); the terminal that "
        "usdview was started from has the details"
    )
