"""A scene: all the characters that are solved together, and what is asked of them."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

from usdmotion.arrays import Floats, seal
from usdmotion.cast import Cast, Character
from usdmotion.constraints import Constraint
from usdmotion.tasks import Demand


@dataclass(frozen=True, eq=False)
class Edit:
    """One solve of one skeleton, with its constraints."""

    path: str
    """Path of the MotionEdit prim."""
    skeleton: str
    """Path of the Skeleton that it solves."""
    constraints: tuple[Constraint, ...]
    solver: str = "prioritized_ik"
    """Registered name of the solver."""
    options: Mapping[str, object] = field(default_factory=dict)
    """Options of the solver, as authored."""
    smoothing: float = 0.0
    """Cutoff of the filter between two passes [Hz]; 0 is off."""
    passes: int = 1
    """How often the constraints are enforced; with smoothing at least twice."""


@dataclass(frozen=True, eq=False)
class Scene:
    """Characters at common times, and the edits to be solved on them."""

    characters: tuple[Character, ...]
    """The edited ones, and those in whose joints' frames goals are given."""
    edits: tuple[Edit, ...]
    time_codes: Floats
    """Time code of each frame, shape (frame_count,); seconds are in the motions."""
    up: Floats
    """The direction away from the ground, shape (3,)."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "time_codes", seal(self.time_codes, None, name="time_codes"))
        object.__setattr__(self, "up", seal(self.up, 3, name="up"))

    @cached_property
    def cast(self) -> Cast:
        """All joints in one numbering."""
        return Cast.of(self.characters)

    @cached_property
    def constraints(self) -> tuple[Constraint, ...]:
        """The constraints of all edits, edit by edit."""
        return tuple(constraint for edit in self.edits for constraint in edit.constraints)

    @cached_property
    def demands(self) -> tuple[Demand, ...]:
        """What each constraint asks for, parallel to `constraints`."""
        return tuple(constraint.demand(self.cast) for constraint in self.constraints)

    def character(self, path: str) -> Character:
        """Return the character of a skeleton."""
        return next(character for character in self.characters if character.path == path)

    @property
    def notes(self) -> tuple[str, ...]:
        """One sentence about each thing that was not said and had to be taken from elsewhere."""
        weighed = {each.skeleton for each in self.constraints if each.weighs}
        return tuple(
            f"the masses of <{each.path}> are from {each.masses_from}; author usdmotion:masses to "
            "say otherwise"
            for each in self.characters
            if each.path in weighed and each.masses_from != "authored"
        )
