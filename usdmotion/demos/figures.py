"""How the stage of a demo is drawn, so that it shows what the figure of a paper shows."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawn


@dataclass(frozen=True)
class Answer:
    """What a row of a picture shows."""

    title: str = "after"
    build: Callable[[Path], None] | None = None
    """Writes the stage that is worked on; None takes that of the demo."""
    variant: str = ""
    """Which one is selected in the variant set that the stage has."""
    without: tuple[str, ...] = ()
    """Names of the constraints that are switched off."""
    hidden: tuple[str, ...] = ()
    """Names of the prims that are not to be seen afterwards."""
    steps: tuple[str, ...] = ()
    """Commands, each on what the one before it wrote; none takes what `demo` says to go on by."""


@dataclass(frozen=True)
class Figure:
    """One picture of a stage: columns are frames, rows are what became of it."""

    shows: str
    """What is to be seen, and in which figure of a paper."""
    frames: tuple[float, ...] = ()
    """Time codes; none takes those at which it is worth looking."""
    views: tuple[str, ...] = ()
    """From where; none takes the usual view."""
    answers: tuple[Answer, ...] = (Answer(),)
    before: bool = True
    """Whether the first row is the stage as it was built."""


@dataclass(frozen=True)
class Plot:
    """A picture of curves."""

    shows: str
    """What is to be seen, and in which figure of a paper."""
    draw: Callable[[Path], "Drawn"]
    """Draws them from a stage."""
    solved: bool = False
    """Whether that is to be the stage after what `demo` says to go on by."""
