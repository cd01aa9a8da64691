"""A scene: all the characters that are solved together, and what is asked of them."""

from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from usdmotion.arrays import Bools, Floats, seal
from usdmotion.cast import Cast, Character
from usdmotion.constraints import Constraint, during
from usdmotion.ground import Ground
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
    cleaning: float = 0.0
    """Cutoff of the filter that cleans the input first [Hz]; 0 leaves the input as it is."""
    ground: Ground | None = None
    """What the input is put on after that; None leaves it where it is."""
    passes: int = 1
    """How often the constraints are enforced; with smoothing at least twice."""

    def during(self, frames: slice, kept: Set[int]) -> "Edit":
        """Return the edit on some of its frames, with those of its constraints whose id is kept."""
        constraints = tuple(during(each, frames) for each in self.constraints if id(each) in kept)
        return replace(self, constraints=constraints)


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
    moved: Bools | None = None
    """Of a part of a clip: what constraints recruit on any frame of it, shape (node_count,)."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "time_codes", seal(self.time_codes, None, name="time_codes"))
        object.__setattr__(self, "up", seal(self.up, 3, name="up"))

    @property
    def times(self) -> Floats:
        """Seconds from the first frame, shape (frame_count,)."""
        return self.characters[0].motion.times

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
        demands = [constraint.demand(self.cast) for constraint in self.constraints]
        return tuple(self._together(index, demands) for index in range(len(demands)))

    @cached_property
    def recruited(self) -> Bools:
        """Which nodes some constraint may move, on any frame of the clip, shape (node_count,)."""
        if self.moved is not None:
            return self.moved
        cast = Cast.of([each.during(slice(0, 1)) for each in self.characters])
        recruited = np.zeros(cast.node_count, dtype=np.bool_)
        for each in self.constraints:
            recruited[list(each.recruited(cast))] = True
        return recruited

    def _together(self, index: int, demands: Sequence[Demand]) -> Demand:
        """Return a demand that also moves what it follows, where that follows it in the same rank.

        Two that go towards each other would each go the whole way, and never meet. So each reckons
        with what the other moves, as long as both are on at the same times.
        """
        own, demand = self.constraints[index], demands[index]
        if {self.cast.joints[node][0] for node in demand.moves} <= {own.skeleton}:
            return demand
        recruits = np.array(demand.recruits)
        for other, asked in zip(self.constraints, demands, strict=True):
            if own.skeleton == other.skeleton or not _in_step(own, other):
                continue
            followed = demand.moves & _nodes(asked)
            if followed and asked.moves & _nodes(demand):
                recruits[list(followed)] = True
        return replace(demand, recruits=recruits)

    def during(self, frames: slice) -> "Scene":
        """Return the scene on some of its frames, with the constraints that can matter there.

        Of each rank one stays in any case, so that every part of a clip has the same levels.
        """
        kept = _mattering(self.constraints, self.times[frames])
        return replace(
            self,
            characters=tuple(each.during(frames) for each in self.characters),
            edits=tuple(each.during(frames, kept) for each in self.edits),
            time_codes=self.time_codes[frames],
            moved=self.recruited,
        )

    def character(self, path: str) -> Character:
        """Return the character of a skeleton."""
        return next(character for character in self.characters if character.path == path)

    def nodes(self, path: str) -> slice:
        """Return the nodes of the cast that are a skeleton's joints; they stand after its space."""
        first = 1
        for each in self.characters:
            if each.path == path:
                break
            first += 1 + len(each.skeleton.joints)
        return slice(first, first + len(self.character(path).skeleton.joints))

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


def _nodes(demand: Demand) -> Set[int]:
    return set(np.flatnonzero(demand.recruits).tolist())


def _in_step(one: Constraint, other: Constraint) -> bool:
    """Tell whether two constraints of one rank are on at the same times, however long the clip."""
    same = one.priority == other.priority and one.times == other.times
    still = np.ndim(one.activity) == 0 and np.ndim(other.activity) == 0
    return bool(same and still and one.activity == other.activity)


def _mattering(constraints: Sequence[Constraint], times: Floats) -> Set[int]:
    """Return the ids of the constraints that can ask for something, and of one of each rank."""
    ranks: dict[int, list[int]] = {}
    for each in constraints:
        span, rank = each.span(times), ranks.setdefault(each.priority, [])
        if span.start < span.stop:
            rank.append(id(each))
    idle = {each.priority: id(each) for each in constraints if not ranks[each.priority]}
    return {each for rank in ranks.values() for each in rank} | set(idle.values())
