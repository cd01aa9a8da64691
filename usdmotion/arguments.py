"""What the words of a command line say: options, times, frequencies, names, examples."""

import math
import re
from collections.abc import Sequence
from pathlib import Path

from usdmotion.asking import Example, Span
from usdmotion.errors import OptionError


def options_of(pairs: Sequence[str] | None) -> dict[str, object]:
    """Return options from NAME=VALUE.

    Raises:
        OptionError: One says no value.
    """
    values: dict[str, object] = {}
    for pair in pairs or ():
        name, equals, value = pair.partition("=")
        if not equals:
            raise OptionError(f"--option {pair} says no value; write --option {pair}=VALUE")
        values[name] = value
    return values


def frames_of(text: str | None) -> tuple[float, float] | None:
    """Return time codes from A:B.

    Raises:
        OptionError: It is no range.
    """
    if text is None:
        return None
    first, _, last = text.rpartition(":")
    try:
        frames = float(first), float(last)
    except ValueError:
        raise OptionError(f"--frames {text} is no range; write --frames A:B, as 1:48") from None
    if not frames[0] <= frames[1]:
        raise OptionError(f"--frames {text} ends before it starts; write the earlier time first")
    return frames


def moments_of(text: str | None) -> Span | tuple[float, ...] | None:
    """Return the frames of a picture from A:B, A:B:STEP or A,B,…

    Raises:
        OptionError: They are none.
    """
    if text is None:
        return None
    parts = text.split(":")
    if not all(_is_number(each) for part in parts for each in part.split(",")) or len(parts) > 3:
        raise OptionError(
            f"--frames {text} names no frames; write 1:48, 1:48:8, or 1,24,48 in time codes"
        )
    if len(parts) == 1:
        return tuple(float(each) for each in text.split(","))
    if any("," in part for part in parts):
        raise OptionError(f"--frames {text} is a range and a list; write one of them")
    first, last, *steps = (float(part) for part in parts)
    if first > last:
        raise OptionError(f"--frames {text} ends before it starts; write the earlier time first")
    if steps and not steps[0] > 0.0:
        raise OptionError(f"--frames {text} does not get on; write a step above 0")
    return Span(first, last, *steps)


def cutoff_of(clean: float | None, flag: str = "--clean") -> float | None:
    """Return the cutoff of a filter [Hz], 0 for none.

    Args:
        clean: What was written.
        flag: The option that it was written for.

    Raises:
        OptionError: It is no frequency.
    """
    if clean is not None and not 0.0 <= clean < float("inf"):
        raise OptionError(f"{flag} {clean:g} is no cutoff; give hertz, such as 10, or 0 for none")
    return clean


def duration_of(seconds: float | None, flag: str) -> float | None:
    """Return a length of time [s].

    Args:
        seconds: What was written.
        flag: The option that it was written for.

    Raises:
        OptionError: It is none.
    """
    if seconds is not None and not 0.0 <= seconds < float("inf"):
        raise OptionError(f"{flag} {seconds:g} is no length of time; give seconds, such as 0.1")
    return seconds


def names_of(texts: Sequence[str] | None) -> tuple[str, ...]:
    """Return names that are separated by commas, or said one after another.

    Who names nothing in so many words gets the name "", which nothing has: whatever looks for it
    tells which names there are.
    """
    parts = (part.strip() for text in texts or () for part in text.split(","))
    return tuple(part for part in parts if part) or (("",) if texts else ())


def template_of(text: str) -> Example:
    """Return an example from JOINT:START:END[:KIND], read from the right.

    So a joint's name may hold colons.

    Raises:
        OptionError: It is none.
    """
    parts = text.split(":")
    kind = parts.pop() if not _is_number(parts[-1]) else "space"
    name = ":".join(parts[:-2])
    if len(parts) < 3 or not name or not all(_is_number(part) for part in parts[-2:]):
        raise OptionError(
            f"--template {text} is no example; write --template JOINT:START:END or "
            "JOINT:START:END:KIND, as LeftFoot:10:24:space"
        )
    return Example(name, float(parts[-2]), float(parts[-1]), kind)


def beside(shot: Path, word: str) -> Path:
    """Return where a layer over a shot goes when nobody says: never onto the shot itself.

    Args:
        shot: The shot, or a layer of this sort.
        word: What it is called after, as in `walk.contacts.usda` and `walk.contacts2.usda`.
    """
    found = re.fullmatch(rf"(.*?)(\.{word}(\d*))?", shot.stem)
    assert found is not None
    name, _, number = found.groups()
    again = "" if number is None else str(int(number or 1) + 1)
    return shot.with_name(f"{name}.{word}{again}.usda")


def _is_number(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False
