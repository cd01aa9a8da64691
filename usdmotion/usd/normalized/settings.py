"""What an edit says beside its constraints, on the edit or on the motion that it travels with."""

from typing import Any

from pxr import Usd

from usdmotion.arrays import Floats
from usdmotion.travelling import Settings
from usdmotion.usd.attribute_authoring import time_code_array
from usdmotion.usd.attributes import seconds
from usdmotion.usd.authoring import author_options
from usdmotion.usd.edits import options_of
from usdmotion.usd.relations import floats, value
from usdmotion.usd.shot import Facts

_NUMBERS = ("cleaning", "smoothing")


def read_settings(prim: Usd.Prim, time_codes: Floats, facts: Facts) -> Settings:
    """Return the settings of a MotionEdit, or of a MotionNormalized.

    Args:
        prim: The prim.
        time_codes: Time code of each frame; the first is where seconds start.
        facts: Rates of the stage.
    """
    span = seconds(floats(value(prim, "usdmotion:range", ())), time_codes, facts)
    options: Any = options_of(prim)
    ground = prim.GetRelationship("usdmotion:ground")
    return Settings(
        solver=str(value(prim, "usdmotion:solver", "")),
        span=(span[0], span[1]) if len(span) == 2 else None,
        cleaning=float(value(prim, "usdmotion:cleaning", 0.0)),
        smoothing=float(value(prim, "usdmotion:smoothing", 0.0)),
        passes=int(value(prim, "usdmotion:passes", 1)),
        ground=tuple(map(str, ground.GetTargets())) if ground else (),
        options=options,
    )


def author_settings(prim: Usd.Prim, settings: Settings, time_codes: Floats, facts: Facts) -> None:
    """Give a MotionEdit, or a MotionNormalized, the settings that are not at their defaults."""
    if settings.solver:
        prim.GetAttribute("usdmotion:solver").Set(settings.solver)
    if settings.span is not None:
        codes = [time_codes[0] + each * facts.time_codes_per_second for each in settings.span]
        prim.GetAttribute("usdmotion:range").Set(time_code_array(codes))
    for name in _NUMBERS:
        number = float(getattr(settings, name))
        if number:
            prim.GetAttribute(f"usdmotion:{name}").Set(number)
    if settings.passes != 1:
        prim.GetAttribute("usdmotion:passes").Set(settings.passes)
    if settings.ground:
        prim.GetRelationship("usdmotion:ground").SetTargets(list(settings.ground))
    author_options(prim, settings.options)
