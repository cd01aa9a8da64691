"""2006, figures 3 to 6: what is held still moves; how much, is learnt from an example."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.demos.plots.reading import Steps, search_of
from usdmotion.detecting import Detected, NoisePattern, Search, Template
from usdmotion.drawing.style import AFTER, BEFORE, GOAL, MISSED, SUPPORT, figure
from usdmotion.plugins import host

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

JOINT = "LeftToeBase"
EXAMPLES = ((5.0, 14.0), (30.0, 40.0))
"""In which it stands, in time codes: of both the noise pattern is made."""
SLOPPY = (1.0, 15.0)
"""An example that begins while the foot still comes down."""
RATE, FIRST = 24.0, 1.0


def pattern(stage: Path) -> "Figure":
    """Return the steps of a foot in the plane of σ and ε, and their ε over time (figures 3, 6)."""
    search = search_of(stage, JOINT)
    steps, found = Steps.of(search), _found(search, EXAMPLES)
    assert found.pattern is not None
    drawn = figure(2.9, 7.4)
    plane, over_time = drawn.subplots(1, 2, width_ratios=(1.0, 1.6))
    sigma, epsilon = _limits(found.pattern, search)
    held = (steps.sigma <= sigma) & (steps.local <= epsilon)
    for chosen, color, label in ((~held, BEFORE, "moves"), (held, AFTER, "is held")):
        plane.scatter(steps.sigma[chosen], 1e3 * steps.local[chosen], 9.0, color, label=label)
    plane.set(title="a point for each step", xlabel="σ₃", ylabel="ε₃ [mm]")
    plane.set(yscale="log")
    plane.legend(loc="lower right")
    codes = _codes(search)[:-1]
    over_time.plot(codes, 1e3 * steps.local, color=BEFORE, label="ε₃")
    over_time.plot(codes, 1e3 * epsilon, color=AFTER, label="ε_max")
    _spans(over_time, EXAMPLES, GOAL, "examples")
    _spans(over_time, _contacts(found), SUPPORT, "contacts")
    over_time.set(title="over time", xlabel="time code", ylabel="mm", yscale="log")
    over_time.margins(y=0.25)
    over_time.legend(loc="upper right", ncols=2)
    return drawn


def outliers(stage: Path) -> "Figure":
    """Return what an example with outliers teaches, by its maximum and without them (4, 5)."""
    search = search_of(stage, JOINT)
    steps, found = Steps.of(search), _found(search, (SLOPPY,))
    assert found.pattern is not None
    codes = _codes(search)[:-1]
    shown = (codes >= SLOPPY[0]) & (codes < SLOPPY[1])
    naive = float(steps.local[shown].max())
    _, epsilon = _limits(found.pattern, search)
    drawn = figure(2.7, 7.4)
    axes = drawn.subplots()
    axes.plot(codes, 1e3 * steps.local, color=BEFORE, label="ε₃")
    axes.axhline(1e3 * naive, color=MISSED, label="largest of the example")
    axes.plot(codes, 1e3 * epsilon, color=AFTER, label="least median of squares")
    _spans(axes, (SLOPPY,), GOAL, "example")
    _spans(axes, _contacts(found), SUPPORT, "contacts")
    axes.set(xlabel="time code", ylabel="mm", yscale="log")
    axes.margins(y=0.3)
    axes.legend(loc="upper right", ncols=3)
    return drawn


def _found(search: Search, examples: tuple[tuple[float, float], ...]) -> Detected:
    seconds = [((start - FIRST) / RATE, (end - FIRST) / RATE) for start, end in examples]
    templates = tuple(Template("space", *each) for each in seconds)
    return host().detector("contacts")().detect(replace(search, templates=templates))


def _limits(pattern: NoisePattern, search: Search) -> tuple[Floats, Floats]:
    """Return σ_max and ε_max of each step."""
    times = search.times[:-1]
    return pattern.sigma.at(times), pattern.epsilon.at(times)


def _contacts(found: Detected) -> tuple[tuple[float, float], ...]:
    return tuple((FIRST + RATE * each.start, FIRST + RATE * each.end) for each in found.contacts)


def _codes(search: Search) -> Floats:
    return np.asarray(FIRST + RATE * search.times)


def _spans(axes: "Axes", spans: tuple[tuple[float, float], ...], color: str, label: str) -> None:
    """Mark some spans along the bottom of a plot."""
    height = 0.03 if label == "contacts" else 0.07
    for number, (start, end) in enumerate(spans):
        axes.axvspan(
            start, end, height - 0.03, height, color=color, label=label if number == 0 else None
        )
