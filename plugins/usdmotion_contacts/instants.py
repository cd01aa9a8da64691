"""Instantaneous contacts: what each displacement leaves where it was (2006, section 5)."""

import numpy as np

from usdmotion import Bools, Floats, NoisePattern, Search
from usdmotion_contacts.displacements import SLACK
from usdmotion_contacts.projection import SigmaEpsilon


def at_rest(search: Search, points: SigmaEpsilon, pattern: NoisePattern) -> Bools:
    """Return which displacements leave all of space where it was: σ3 ≤ σ_max and ε3 ≤ ε_max."""
    still, epsilon = _thresholds(points, pattern)
    return still & (points.epsilon_3 <= epsilon) & _short(search, points)


def turning(search: Search, points: SigmaEpsilon, pattern: NoisePattern) -> Bools:
    """Return which leave a line where it was: σ3 > σ_max and ε1 ≤ ε_max.

    One with σ3 ≤ σ_max and ε3 > ε_max leaves nothing: its solution is not acceptable.
    """
    still, epsilon = _thresholds(points, pattern)
    return ~still & (points.epsilon_1 <= epsilon) & _short(search, points)


def _thresholds(points: SigmaEpsilon, pattern: NoisePattern) -> tuple[Bools, Floats]:
    """Return which displacements hardly turn, and the ε_max of each."""
    times = points.displacements.times
    return np.asarray(points.sigma_3 <= pattern.sigma.at(times)), pattern.epsilon.at(times)


def _short(search: Search, points: SigmaEpsilon) -> Bools:
    """Return which are no longer than a step and what may be bridged: others miss their samples."""
    moves = points.displacements
    took = search.times[moves.last] - search.times[moves.first]
    return np.asarray(took <= moves.step + max(search.gap, moves.interval) + SLACK)
