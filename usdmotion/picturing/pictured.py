"""What a picture shows, to be told: a few lines and JSON."""

from collections.abc import Sequence
from dataclasses import dataclass

from rich.table import Table

from usdmotion import terminal


@dataclass(frozen=True)
class Pictured:
    """What was drawn; its fields are keys of the JSON."""

    file: str
    frames: tuple[float, ...]
    """Time codes of the columns."""
    rows: tuple[str, ...]
    """What each row shows, from above."""
    skeletons: tuple[str, ...]
    """Paths of the bodies."""
    notes: tuple[str, ...]
    """One sentence about each thing that whoever looks should know."""

    def to_json(self) -> str:
        """Return the machine-readable form."""
        return terminal.to_json(self)

    def tables(self) -> Sequence[Table | str]:
        """Return what people read."""
        frames = ", ".join(f"{code:g}" for code in self.frames)
        return [f"frames: {frames}"]
