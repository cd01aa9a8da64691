"""Where a command is carried out: the window, what is selected in it, where results go."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from usdmotion.answering import Say
from usdmotion.usdview.destinations import destination
from usdmotion.usdview.running import Desk
from usdmotion.usdview.selection import Selection
from usdmotion.usdview.windows import Window


@dataclass(frozen=True, eq=False)
class Here:
    """What a command is given."""

    api: Any
    """What usdview offers its plugins."""
    desk: Desk
    """What is kept between commands."""
    window: Window
    selection: Selection

    @classmethod
    def of(cls, api: Any, desk: Desk) -> "Here":
        """Return where a command is carried out.

        Raises:
            SceneError: No stage is open.
        """
        return cls(api, desk, Window(api), Selection.of(api))

    @contextmanager
    def writing(self) -> Iterator[tuple[Say, str]]:
        """Let edits go where results go, while it shows that something is going on.

        Yields:
            What to tell about the work, and how the place is called where it goes.

        Raises:
            FileError: The file that somebody chose cannot be read or written.
        """
        with self.window.busy() as say, destination(self.selection.stage, self.desk) as place:
            yield say, place

    def select(self, path: str) -> None:
        """Select a prim, and nothing else."""
        prim = self.selection.stage.GetPrimAtPath(path)
        self.api.dataModel.selection.setPrim(prim)

    def show_guides(self) -> None:
        """Let the view show what has the purpose guide."""
        self.api.dataModel.viewSettings.displayGuide = True
