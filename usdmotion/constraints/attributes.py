"""Fields of a constraint that are properties of its schema class, under the same name."""

import dataclasses
from dataclasses import dataclass
from typing import Any, Literal

Unit = Literal["", "length", "time"]
Target = Literal["skeleton", "region"]


@dataclass(frozen=True, slots=True)
class Attribute:
    """One attribute of a constraint kind, as a generic reader or writer needs to know it."""

    field: str
    """Name of the dataclass field, for example `free_axis`."""
    default: Any
    unit: Unit
    """"length" is metres here and stage units there, "time" seconds here and time codes there."""
    animated: bool
    """Whether it may change over time: the field then holds a value, or one for each frame."""
    frame: str = ""
    """In whose frame it is given: "" the stage's, "space" the relation `space`, "edit" the
    MotionEdit's, "goals" that of its goals; else the field with the token of the joint, or with the
    tokens, a point each."""
    skeleton: str = "skeleton"
    """The field with the path of the Skeleton whose joint that is, the edit's where it is empty."""
    of: str = ""
    """Of an orientation, the field with the token of the joint that has it; "" is no joint's."""

    @property
    def name(self) -> str:
        """Name of the USD attribute, for example `usdmotion:freeAxis`."""
        return property_name(self.field)


@dataclass(frozen=True, slots=True)
class Relation:
    """One relationship of a constraint kind, as a generic reader or writer needs to know it."""

    field: str
    """Name of the dataclass field, for example `other_skeleton`."""
    target: Target
    """What it names: a "skeleton" is its path, a "region" a `Region`."""

    @property
    def name(self) -> str:
        """Name of the USD relationship, for example `usdmotion:otherSkeleton`."""
        return property_name(self.field)


def property_name(field: str) -> str:
    """Return the name of the USD property of a field, for example `usdmotion:freeAxis`."""
    first, *rest = field.split("_")
    return "usdmotion:" + first + "".join(word.capitalize() for word in rest)


def attribute(
    default: Any,
    *,
    unit: Unit = "",
    animated: bool = False,
    frame: str = "",
    skeleton: str = "skeleton",
    of: str = "",
) -> Any:
    """Declare a dataclass field that is read from, and written to, an attribute of the schema."""
    details = {
        "unit": unit,
        "animated": animated,
        "frame": frame,
        "skeleton": skeleton,
        "of": of,
    }
    if isinstance(default, (tuple, str, int, float)):
        return dataclasses.field(default=default, metadata={"attribute": details})
    return dataclasses.field(default_factory=default, metadata={"attribute": details})


def relation(target: Target) -> Any:
    """Declare a dataclass field that is read from, and written to, a relationship of the schema.

    Where it names nothing, a skeleton is "" and a region None.
    """
    default = "" if target == "skeleton" else None
    return dataclasses.field(default=default, metadata={"relation": target})


def attributes(kind: type) -> tuple[Attribute, ...]:
    """Return the attributes of a constraint kind, those that all kinds share first."""
    return tuple(
        Attribute(
            field.name,
            field.default
            if field.default_factory is dataclasses.MISSING
            else field.default_factory(),
            **field.metadata["attribute"],
        )
        for field in dataclasses.fields(kind)
        if "attribute" in field.metadata
    )


def relations(kind: type) -> tuple[Relation, ...]:
    """Return the relationships of a constraint kind."""
    return tuple(
        Relation(field.name, field.metadata["relation"])
        for field in dataclasses.fields(kind)
        if "relation" in field.metadata
    )
