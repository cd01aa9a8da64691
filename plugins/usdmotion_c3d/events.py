"""The events of a file."""

import numpy as np

from usdmotion import Event
from usdmotion_c3d.trials import Trial


def read_events(trial: Trial) -> tuple[Event, ...]:
    """Return the events in the order of their times.

    A file counts them from the start of its recording, of which it may hold a later part only.
    """
    # Minutes and seconds by turns.
    flat = trial.numbers("EVENT", "TIMES").ravel(order="F")
    times = flat[: len(flat) // 2 * 2].reshape(-1, 2)
    labels = trial.texts("EVENT", "LABELS")
    contexts = trial.texts("EVENT", "CONTEXTS")
    seconds = 60.0 * times[:, 0] + times[:, 1] - (trial.first - 1) / trial.rate
    used = trial.numbers("EVENT", "USED").ravel()
    count = min(len(seconds), len(labels), int(used[0]) if len(used) else len(seconds))
    contexts += [""] * count
    events = [
        Event(labels[each] or "Event", float(seconds[each]), contexts[each])
        for each in range(count)
        if np.isfinite(seconds[each])
    ]
    return tuple(sorted(events, key=lambda event: event.time))
