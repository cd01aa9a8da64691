"""Fingers and toes, which a body may do without."""

import re
from collections.abc import Callable, Sequence

import numpy as np

from usdmotion.humanoid.names import Name
from usdmotion.humanoid.words import DIGITS, PALM
from usdmotion.motion import Skeleton

_DIGIT = re.compile("|".join(sorted(DIGITS, key=len, reverse=True)))


def find_digits(
    skeleton: Skeleton,
    names: Sequence[Name],
    base: int,
    joints_of: Callable[[int], tuple[str, ...]],
) -> dict[str, int]:
    """Return the joints of the fingers of a hand, or of the toes of a foot.

    Args:
        skeleton: Its joints.
        names: What their names say.
        base: The wrist or the ankle.
        joints_of: Names of the joints of a digit by its number, from the base on.
    """
    digits = _digits(skeleton, names, base)
    found: dict[str, int] = {}
    for digit in sorted(set(digits.values())):
        row = [joint for joint in sorted(digits) if digits[joint] == digit]
        row = [joint for joint in row if _has_length(skeleton, joint)]
        if not row or not set(row) <= set(skeleton.chain(row[-1])):
            continue  # it branches, so nobody can tell
        in_palm = digit == 1 or _is_in_palm([names[joint] for joint in row])
        parts = joints_of(digit)[0 if in_palm and "carpo" in joints_of(digit)[0] else 1 :]
        found |= dict(zip(parts, row, strict=False))
    return found


def _digits(skeleton: Skeleton, names: Sequence[Name], base: int) -> dict[int, int]:
    """Return which digit each joint below a wrist or an ankle belongs to."""
    digits: dict[int, int] = {}
    below = {base}
    for joint in range(base + 1, len(skeleton.joints)):
        parent = int(skeleton.parents[joint])
        if parent not in below:
            continue
        below.add(joint)
        own = _own_digit(names[joint])
        # `Mid` below a thumb is its middle joint.
        vague = names[joint].words == ("mid",) and parent in digits
        digit = digits.get(parent) if own is None or vague else own
        if digit is not None:
            digits[joint] = digit
    return digits


def _own_digit(name: Name) -> int | None:
    named = _DIGIT.search("".join(name.words))
    if named:
        return DIGITS[named[0]]
    return name.numbers[0] if name.is_digit and 1 <= name.numbers[0] <= 5 else None


def _is_in_palm(row: Sequence[Name]) -> bool:
    """Return whether the first joint of a finger is in the palm and not at the knuckle."""
    first = row[0]
    unnumbered = not first.numbers and len(row) > 1 and bool(row[1].numbers)
    return unnumbered or bool(PALM & set(first.words))


def _has_length(skeleton: Skeleton, joint: int) -> bool:
    """Return whether a joint is anywhere else than its parent, or carries anything."""
    return bool(np.any(skeleton.rest_translations[joint])) or joint in skeleton.parents
