"""Frames per second from a Frame Time that was rounded when it was written."""

import math

from usdmotion_bvh.rows import Rows
from usdmotion_bvh.source import Source

_WHOLE_RATES = (15, 24, 25, 30, 48, 50, 60, 72, 75, 90, 100, 120, 144, 150, 180, 200, 240, 250, 300)
_KNOWN_RATES = (
    *map(float, _WHOLE_RATES),
    *(rate * 1000 / 1001 for rate in (24, 30, 48, 60, 120, 240)),
)
_PLAUSIBLE = (10.0, 1000.0)
_SHORTEST, _LONGEST = 1e-6, 1e3


def decide_rate(source: Source, rows: Rows, wanted: float) -> tuple[float, list[str]]:
    """Return samples per second and what there is to say about them.

    Args:
        source: The file, to refuse it.
        rows: The motion, with what the file says of its Frame Time.
        wanted: Overrules the file; 0 leaves it to the file.

    Raises:
        FileError: The file gives no rate and nobody else does.
    """
    if wanted > 0.0:
        said = f"Frame Time is {rows.frame_time or 'missing'}"
        return wanted, [f"{said}: overruled by {wanted:g} samples per second"]
    try:
        seconds = float(rows.frame_time)
    except ValueError:
        seconds = math.nan
    if not _SHORTEST < seconds < _LONGEST:
        wrong = f"'{rows.frame_time}' is no Frame Time in seconds"
        says = wrong if rows.frame_time else "there is no Frame Time"
        cure = "the option rate gives the samples per second"
        raise source.refusal(rows.frame_time_line, f"{says}; {cure}")
    rate = _meant(seconds, rows.frame_time)
    if not _PLAUSIBLE[0] <= rate <= _PLAUSIBLE[1]:
        says = f"Frame Time {rows.frame_time} s is not plausible: {rate:g} samples per second"
        return rate, [f"{says}; the option rate overrules it"]
    return rate, []


def _meant(seconds: float, text: str) -> float:
    """Return the known rate that rounds to the digits that were written, or 1 / seconds."""
    exact = 1.0 / seconds
    if abs(exact - round(exact)) < 1e-9 * exact:
        return float(round(exact))
    mantissa, _, exponent = text.lower().partition("e")
    digits = len(mantissa.partition(".")[2].rstrip("0")) - int(exponent or 0)
    step = 0.5000001 * 10.0**-digits
    nearest = min(_KNOWN_RATES, key=lambda rate: abs(1.0 / rate - seconds))
    return nearest if abs(1.0 / nearest - seconds) <= step else exact
