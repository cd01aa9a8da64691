"""What an animator writes, one kind a file; `position.py` is the shortest and the tutorial.

A kind is a frozen dataclass whose fields are the attributes of its schema class. Nothing else in
the house has a list of kinds: this package finds its own modules, plugins hand theirs over
through `register_constraints`.
"""

from importlib import import_module
from pkgutil import iter_modules

from usdmotion.constraints.aim import AimConstraint
from usdmotion.constraints.altering import altered, sound
from usdmotion.constraints.attributes import (
    Attribute,
    Relation,
    attribute,
    attributes,
    relation,
    relations,
)
from usdmotion.constraints.center_of_mass import CenterOfMassConstraint
from usdmotion.constraints.constraint import Constraint
from usdmotion.constraints.contact import ContactConstraint
from usdmotion.constraints.distance import DistanceConstraint
from usdmotion.constraints.goal import Goal
from usdmotion.constraints.orientation import OrientationConstraint
from usdmotion.constraints.position import PositionConstraint
from usdmotion.constraints.region import Region, RegionConstraint
from usdmotion.constraints.sampling import during
from usdmotion.constraints.space import Space
from usdmotion.constraints.trajectory import TrajectoryConstraint

__all__ = [
    "AimConstraint",
    "Attribute",
    "CenterOfMassConstraint",
    "Constraint",
    "ContactConstraint",
    "DistanceConstraint",
    "Goal",
    "OrientationConstraint",
    "PositionConstraint",
    "Region",
    "RegionConstraint",
    "Relation",
    "Space",
    "TrajectoryConstraint",
    "altered",
    "attribute",
    "attributes",
    "built_in",
    "during",
    "relation",
    "relations",
    "sound",
]


def built_in() -> tuple[type[Constraint], ...]:
    """Return every constraint kind of this package, in the order of their schema names."""
    modules = [import_module(f"{__name__}.{module.name}") for module in iter_modules(__path__)]
    kinds = {
        kind
        for module in modules
        for kind in vars(module).values()
        if isinstance(kind, type) and issubclass(kind, Constraint) and kind is not Constraint
    }
    return tuple(sorted(kinds, key=lambda kind: kind.schema))
