"""What carries what in a body, told by the names of the parts alone."""

from collections.abc import Sequence

from usdmotion.humanoid import NECK, SPINE
from usdmotion.humanoid.parts import ARM, LEG, finger, toe

ROOT = "humanoid_root"
LIMBS = tuple(
    (f"{side}_{chain[0]}", f"{side}_{chain[1]}", f"{side}_{chain[2]}")
    for side in "lr"
    for chain in (ARM[1:], LEG[:3])
)
"""Top, middle and end of each limb: left arm and leg, right arm and leg."""
TOPS = tuple(limb[0] for limb in LIMBS)
MIDDLES = tuple(limb[1] for limb in LIMBS)
ENDS = tuple(limb[2] for limb in LIMBS)
FINGERS = tuple(
    tuple(f"{side}_{joint}" for joint in finger(digit)) for side in "lr" for digit in range(1, 6)
)
TOES = tuple(
    tuple(f"{side}_{joint}" for joint in toe(digit)) for side in "lr" for digit in range(1, 6)
)
_FEET = tuple(
    tuple(
        f"{side}_{joint}"
        for joint in ("tarsometatarsal", "metatarsophalangeal", "tarsal_interphalangeal")
    )
    for side in "lr"
)
_ROWS = (*FINGERS, *TOES, *_FEET)


def carrier(part: str, present: Sequence[str]) -> str:
    """Return what carries a part: another part, or for hands and feet the top of their limb.

    Args:
        part: A part with a rotation of its own, or the top of a limb.
        present: The parts that there are.
    """
    return next((above for above in _above(part) if above in present), ROOT)


def _above(part: str) -> list[str]:
    """Return what may carry a part, the nearest first."""
    side, _, own = part.partition("_")
    if part in SPINE:
        return list(reversed(SPINE[: SPINE.index(part)]))
    if part in NECK:
        return [*reversed(NECK[: NECK.index(part)]), *reversed(SPINE)]
    if part == "skullbase":
        return [*reversed(NECK), *reversed(SPINE)]
    if part == "sacroiliac":
        return [ROOT]
    if own == "hip":
        return ["sacroiliac", ROOT]
    girdle = (ARM[0], "acromioclavicular", ARM[1])
    if own in girdle:
        before = [f"{side}_{each}" for each in girdle[: girdle.index(own)]]
        return [*reversed(before), *reversed(SPINE)]
    if part in ENDS:
        return [TOPS[ENDS.index(part)]]
    row = next((row for row in _ROWS if part in row), (part,))
    return [*reversed(row[: row.index(part)]), *_base(side, own)]


def _base(side: str, own: str) -> list[str]:
    """Return what carries the first joint of a digit, a joint of palm or instep, or a face."""
    if "tars" in own or own.startswith(("cuneo", "calcaneus", "talocalcaneo")):
        return [f"{side}_{LEG[2]}"]
    if "carp" in own:
        return [f"{side}_{ARM[3]}"]
    return ["skullbase"]
