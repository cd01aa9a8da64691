"""The noise pattern over time, from templates (2006, section 6)."""

from dataclasses import dataclass, replace

import numpy as np

from usdmotion import Detected, NoisePattern, Search, Spline, Template
from usdmotion_contacts.displacements import SLACK
from usdmotion_contacts.noise import (
    NUMERICAL_EPSILON,
    NUMERICAL_SIGMA,
    largest_noise,
    without_outliers,
)
from usdmotion_contacts.projection import SigmaEpsilon
from usdmotion_contacts.sliding import strays

LEAST = 0.1
"""What was found and lasts for less is no example [s]."""
BELOW = 0.99
"""What turns, turns more than σ_max: σ_max is at most this share of the smallest σ3 of it."""

Knots = dict[float, float]


@dataclass(frozen=True)
class Noise:
    """What one template says."""

    times: tuple[float, float]
    """Its first and its last sample [s]."""
    sigma: float | None
    """σ_max that it asks for; None of a line or point, whose σ1 is always 0."""
    ceiling: float
    """What σ_max has to stay below."""
    epsilon: float
    """ε_max that it asks for [m]."""


def taught(search: Search, points: SigmaEpsilon) -> tuple[list[Noise], dict[Template, str]]:
    """Return what templates say, and those that say nothing, with the reason."""
    noises, left_out = [], {}
    for template in search.templates:
        noise = _noise(search, points, template)
        if noise is not None:
            noises.append(noise)
        else:
            left_out[template] = f"it holds no step of {points.displacements.step:g} s"
    return noises, left_out


def taught_by(search: Search, found: Detected) -> Search:
    """Return a search that has what was found in it as examples, on top of its own (section 3.2).

    What is a moment only, such as a foot that turns back, shows nothing.
    """
    shown = tuple(
        Template(each.kind, each.start, each.end)
        for each in found.contacts
        if each.end - each.start >= LEAST
    )
    examples = sorted((*search.templates, *shown), key=lambda each: (each.start, each.end))
    return replace(search, templates=tuple(examples))


def pattern_of(noises: list[Noise], otherwise: NoisePattern | None) -> NoisePattern:
    """Return splines through two knots for every template, at its first and its last time.

    Args:
        noises: What the templates say, at least one of them.
        otherwise: Where σ_max comes from if no template sets it; None if one does.
    """
    sigma = _knots([(each.times, each.sigma) for each in noises if each.sigma is not None])
    epsilon = _knots([(each.times, each.epsilon) for each in noises])
    if otherwise is not None:
        sigma = dict(zip(otherwise.sigma.times, otherwise.sigma.values, strict=True))
    return NoisePattern(_spline(_capped(sigma, noises)), _spline(epsilon))


def _noise(search: Search, points: SigmaEpsilon, template: Template) -> Noise | None:
    moves = points.displacements
    inside = search.times[moves.first] >= template.start - SLACK
    inside &= search.times[moves.last] <= template.end + SLACK
    if not inside.any():
        return None
    times = (
        float(search.times[moves.first][inside][0]),
        float(search.times[moves.last][inside][-1]),
    )
    sigma = points.sigma_3[inside]
    kept = without_outliers(sigma, NUMERICAL_SIGMA)
    if template.kind == "space":
        # What turned too much is wrongly labelled, and says nothing of ε either.
        epsilon = largest_noise(points.epsilon_3[inside][kept], NUMERICAL_EPSILON)
        return Noise(times, largest_noise(sigma, NUMERICAL_SIGMA), np.inf, epsilon)
    if template.kind in ("plane", "slide"):
        epsilon = largest_noise(strays(search, template), NUMERICAL_EPSILON)
        return Noise(times, None, np.inf, epsilon)
    ceiling = BELOW * float(sigma[kept].min())
    epsilon = largest_noise(points.epsilon_1[inside], NUMERICAL_EPSILON)
    return Noise(times, None, ceiling, epsilon)


def _knots(values: list[tuple[tuple[float, float], float]]) -> Knots:
    """Return two knots for each value; of those at one time the largest."""
    knots: Knots = {}
    for times, value in values:
        for time in times:
            knots[time] = max(value, knots.get(time, value))
    return knots


def _capped(knots: Knots, noises: list[Noise]) -> Knots:
    """Return knots that stay below the ceilings of the lines and points that were shown."""
    turning = [each for each in noises if np.isfinite(each.ceiling)]
    if not turning:
        return knots
    spline, capped = _spline(knots), dict(knots)
    for each in turning:
        start, end = each.times
        for time in (start, end, *(time for time in knots if start < time < end)):
            before = capped.get(time, float(spline.at(np.array(time))))
            capped[time] = min(before, each.ceiling)
    return capped


def _spline(knots: Knots) -> Spline:
    times = np.array(sorted(knots))
    return Spline.through(times, np.array([knots[time] for time in times]))


def is_taught(noises: list[Noise]) -> bool:
    """Return whether some template sets σ_max."""
    return any(each.sigma is not None for each in noises)


def constant(sigma: float, epsilon: float) -> NoisePattern:
    """Return a pattern that is the same at all times."""
    return NoisePattern(_spline({0.0: sigma}), _spline({0.0: epsilon}))
