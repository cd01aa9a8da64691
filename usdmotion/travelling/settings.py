"""How what travels is to be solved."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Settings:
    """What an edit says beside its constraints; it goes where they go."""

    solver: str = ""
    """Registered name; "" is the default one."""
    span: tuple[float, float] | None = None
    """First and last time that is solved [s]; None is all of the motion."""
    cleaning: float = 0.0
    """Cutoff of the filter that cleans the input first [Hz]; 0 is none."""
    smoothing: float = 0.0
    """Cutoff of the filter between two passes [Hz]; 0 is off."""
    passes: int = 1
    """How often the constraints are enforced."""
    ground: tuple[str, ...] = ()
    """Paths of the prims that the input is put on."""
    options: Mapping[str, bool | int | float | str] = field(default_factory=dict)
    """Options of the solver."""
