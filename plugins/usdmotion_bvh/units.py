"""How long a unit of a file is."""

import math

UNITS = {
    "a metre": 1.0,
    "a decimetre": 0.1,
    "a centimetre": 0.01,
    "a millimetre": 0.001,
    "an inch": 0.0254,
    # 1 / 0.45 inches: the scale of the skeletons of the CMU database.
    "5.644 cm (CMU)": 0.0254 / 0.45,
}
_PLAUSIBLE = (1.0, 2.2)
_COMMON = (1.4, 2.1)
_TYPICAL = 1.7
_FEWEST_JOINTS = 10


def decide_unit(height: float, joint_count: int, wished: float) -> tuple[float, list[str]]:
    """Return metres per unit, such that the body stands about as tall as people do.

    Args:
        height: About how tall the body stands, in units.
        joint_count: With few joints it is no whole body, whose height would tell nothing.
        wished: Overrules the data where it is above 0.
    """
    if wished > 0.0:
        return wished, []
    heights = {
        name: height * metres
        for name, metres in UNITS.items()
        if _PLAUSIBLE[0] <= height * metres <= _PLAUSIBLE[1]
    }
    if joint_count < _FEWEST_JOINTS or not heights:
        why = "nothing tells how long a unit is"
        return 0.01, [f"{why}: a centimetre is assumed; the option unit gives the metres"]
    name = min(heights, key=lambda each: abs(math.log(heights[each] / _TYPICAL)))
    note = f"a unit is read as {name}: the body then stands about {heights[name]:.2f} m tall"
    if not _COMMON[0] <= heights[name] <= _COMMON[1]:
        note += ", which is unusual; the option unit gives the metres"
    return UNITS[name], [note]
