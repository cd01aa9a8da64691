"""Which frames of a clip are drawn."""

from collections.abc import Sequence

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.asking import Span
from usdmotion.errors import OptionError
from usdmotion.showing.telling import USUAL, Clip

MOST = 12
"""More panels than this beside each other are too small to see anything."""
_FEWER = {0: 4, 1: USUAL, 2: USUAL, 3: 5, 4: 4}
_FEWEST = 3
"""The same by how many bodies are in each; a crowd needs room, and so do things that fly about."""
_SLACK = 1e-6


def asked_for(asked: Span | Sequence[float], clip: Clip) -> Floats:
    """Return the time codes that somebody asks for, ascending, each once.

    Args:
        asked: A span, or time codes.
        clip: When there is something to be seen.

    Raises:
        OptionError: One is outside of the clip, there is none, or there are too many.
    """
    codes = _of_span(asked, clip) if isinstance(asked, Span) else np.unique(np.array(asked, float))
    if not len(codes):
        raise OptionError("--frames names no frame; write time codes with commas, as 1,24,48")
    _require_seen(codes, len(codes), clip)
    return codes


def _require_seen(codes: Floats, count: float, clip: Clip) -> None:
    """Raise unless so many frames, of which some are known, are in the clip and fit on a page."""
    outside = codes[(codes < clip.first - _SLACK) | (codes > clip.last + _SLACK)]
    if len(outside):
        raise OptionError(
            f"--frames names {outside[0]:g}, which is outside of the clip; it goes from "
            f"{clip.first:g} to {clip.last:g}"
        )
    if count > MOST:
        wide = (codes[-1] - codes[0]) / (MOST - 1)
        step = max(clip.step * np.ceil(wide / clip.step - _SLACK), clip.step)
        raise OptionError(
            f"--frames names {count:.0f} frames, of which {MOST} fit beside each other; write "
            f"--frames {codes[0]:g}:{codes[-1]:g}:{step:g}"
        )


def usual(body_count: int) -> int:
    """Return how many frames are drawn of some bodies where nobody says."""
    return _FEWER.get(body_count, _FEWEST)


def _of_span(span: Span, clip: Clip) -> Floats:
    if span.step is None:
        count = min(USUAL, int((span.last - span.first) / clip.step + _SLACK) + 1)
        even = np.linspace(span.first, span.last, count)
        inner = span.first + clip.step * np.round((even - span.first) / clip.step)
        return np.unique(np.minimum(inner, span.last))
    steps = float(np.floor((span.last - span.first) / span.step + _SLACK))
    ends = np.array((span.first, span.first + span.step * steps))
    # Before they are made: a small step names more than there is room for in memory.
    _require_seen(ends, steps + 1.0, clip)
    return np.asarray(span.first + span.step * np.arange(int(steps) + 1), dtype=np.float64)
