"""When an edit is solved."""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.errors import SceneError
from usdmotion.usd.clips import SLACK
from usdmotion.usd.shot import Facts


def solved_times(
    own: Floats, span: tuple[float, float] | None, rate: float, facts: Facts, name: str
) -> Floats:
    """Return the time codes at which an edit is solved.

    They are the source's own, or even ones where a rate is asked for. A source that does not move
    is solved on the frames of the stage.

    Args:
        own: Time codes of the source's samples.
        span: First and last time code wanted; None is the source's own.
        rate: Samples per second; 0 is the source's own times.
        facts: Rates and range of the stage.
        name: The edit, for the error.

    Raises:
        SceneError: No sample is in the range, or the range ends before it starts.
    """
    if span is not None and span[0] > span[1]:
        raise SceneError(f"{name} is solved from {span[0]:g} to {span[1]:g}; swap the two")
    still = len(own) < 2
    if rate > 0.0 or still:
        first, last = span or (_of_stage(own, facts) if still else (own[0], own[-1]))
        step = facts.time_codes_per_second / (rate or facts.frames_per_second)
        return _even(first, last, step)
    if span is None:
        return own
    times = own[(own >= span[0] - SLACK) & (own <= span[1] + SLACK)]
    if len(times) == 0:
        raise SceneError(
            f"{name} has no sample of its source from {span[0]:g} to {span[1]:g}; there are some "
            f"from {own[0]:g} to {own[-1]:g}, or set usdmotion:sampleRate"
        )
    return times


def _of_stage(own: Floats, facts: Facts) -> tuple[float, float]:
    if facts.start is not None and facts.end is not None:
        return facts.start, max(facts.start, facts.end)
    only = float(own[0]) if len(own) else 0.0
    return only, only


def _even(first: float, last: float, step: float) -> Floats:
    count = int((last - first) / step + SLACK) + 1
    times = first + step * np.arange(count)
    # What is solved ends where it was asked to end, be the last interval a shorter one.
    if last - times[-1] > SLACK:
        times = np.append(times, last)
    return np.asarray(times, dtype=np.float64)
