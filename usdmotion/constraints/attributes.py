"""Fields of a constraint that are attributes of its schema class, under the same name."""

import dataclasses
from dataclasses import dataclass
from typing import Any, Literal

Unit = Literal["", "length", "time"]


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
    """In whose frame lengths are given: "" the stage's, "space" the relation `space`, "edit" the
    MotionEdit's; else the field with the token of the joint, or with the tokens, a point each."""

    @property
    def name(self) -> str:
        """Name of the USD attribute, for example `usdmotion:freeAxis`."""
        return property_name(self.field)


def property_name(field: str) -> str:
    """Return the name of the USD property of a field, for example `usdmotion:freeAxis`."""
    first, *rest = field.split("_")
    return "usdmotion:" + first + "".join(word.capitalize() for word in rest)


def attribute(default: Any, *, unit: Unit = "", animated: bool = False, frame: str = "") -> Any:
    """Declare a dataclass field that is read from, and written to, an attribute of the schema."""
    details = {"unit": unit, "animated": animated, "frame": frame}
    if isinstance(default, (tuple, str, int, float)):
        return dataclasses.field(default=default, metadata={"attribute": details})
    return dataclasses.field(default_factory=default, metadata={"attribute": details})


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
