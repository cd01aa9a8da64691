"""A noise pattern from the motion itself, where nobody shows an example."""

import math

import numpy as np

from usdmotion import Bools, Floats, NoisePattern, Search
from usdmotion_contacts.calm import SLOW, SQUARES
from usdmotion_contacts.noise import NUMERICAL_EPSILON, NUMERICAL_SIGMA, largest_noise
from usdmotion_contacts.pattern import constant
from usdmotion_contacts.projection import SigmaEpsilon

CREEPING = 0.125
"""Which share of its usual speed an object that rests may drift by at most."""
FAR = math.sqrt(SQUARES)
"""So many standard deviations of noise are still rest: every other step is within, which is enough,
as steps overlap; more would hold what is setting down."""
NUMERICAL = 10.0
"""So many of numerical noise are still nothing."""
_LOW = 0.126
"""What a tenth of normal numbers is nearer to 0 than, in standard deviations."""


def estimate(search: Search, projected: SigmaEpsilon) -> NoisePattern:
    """Return how much an object seems to move in a step while it rests.

    What it assumes:

    * The object rests now and then for a fifth of a second and is four times as fast in between;
      or else it rests where it is slower than 0.1 m/s, if anywhere. `Calm` tells which. That is the
      only absolute speed, and one of something as large as a person.
    * Noise is independent from frame to frame and the same all the time, but for single outliers,
      if they are few. What rests without any is noiseless: then only numerical noise is left.

    ε_max is what a drift that is still rest makes of a step, and noise on top. σ_max is the least
    median of squares of the steps within that, as if they were a template: a foot that rolls over
    its ball is not at rest. Where an object never rests, only noise is known, so that it is still
    found where it turns about a line, if it moves clear of that noise.

    When it fails: for an object that always creeps, or that is carried; where rests are shorter
    than a fifth of a second, or so few that they are no mode of their own; with noise that comes
    and goes, or that was smoothed and is no longer independent. A template is what helps then.

    Args:
        search: The object.
        projected: Its steps.

    Returns:
        A pattern that is the same all the time.
    """
    moves = projected.displacements
    calm = moves.calm
    resting = calm.rests[moves.first] & calm.rests[moves.last]
    if not moves.count:
        return _numerical(0.0)
    took = float(np.median(search.times[moves.last] - search.times[moves.first]))
    if not resting.any():
        return _numerical(_slide_of_noise(projected, calm.noise) if calm.clear <= took else 0.0)
    if np.median(projected.epsilon_3[resting]) <= NUMERICAL * NUMERICAL_EPSILON:
        return _numerical(0.0)
    slow = min(calm.slow, max(CREEPING * calm.usual, SLOW))
    epsilon = math.hypot(slow * took, FAR * math.sqrt(2.0) * calm.noise)
    within = resting & (projected.epsilon_3 <= epsilon)
    return constant(_turn_of(projected, within), epsilon)


def _numerical(epsilon: float) -> NoisePattern:
    return constant(NUMERICAL * NUMERICAL_SIGMA, max(epsilon, NUMERICAL * NUMERICAL_EPSILON))


def _slide_of_noise(projected: SigmaEpsilon, noise: float) -> float:
    """Return what noise makes of the slide along the axis of a step [m].

    Motion only adds to the noise that is seen. So of two ways to see it the lesser one counts: what
    differs from frame to frame, and the least slides of all.
    """
    slides: Floats = projected.epsilon_1
    least = float(np.quantile(slides, 0.1)) / _LOW if len(slides) else 0.0
    return FAR * min(math.sqrt(2.0) * noise, least)


def _turn_of(projected: SigmaEpsilon, within: Bools) -> float:
    turns = projected.sigma_3[within]
    return max(largest_noise(turns, NUMERICAL_SIGMA), NUMERICAL * NUMERICAL_SIGMA)
