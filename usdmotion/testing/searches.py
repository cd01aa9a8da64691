"""Small searches for checks: an object that rests, one that steps, one that flies."""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.detecting import Search
from usdmotion.kernels import from_vector

STANDS = ((0, 29), (60, 119), (150, 209))
"""First and last frame of each rest of the object of `stepping_search`."""
_RATE = 60.0


def resting_search(kinds: tuple[str, ...] = ("space",)) -> Search:
    """Return a search on an object that does not move at all."""
    count = 120
    turned = from_vector(np.array([0.1, 0.5, -0.2]))
    places, rotations = np.tile([1.0, 0.0, -2.0], (count, 1)), np.tile(turned, (count, 1))
    return _search("a stone", places, rotations, kinds)


def stepping_search() -> Search:
    """Return a search on an object that stands still on the ground three times, as a foot does.

    In between it swings by 0.6 m, 0.1 m high, and turns.
    """
    places, vectors = np.zeros((210, 3)), np.zeros((210, 3))
    for index, (first, last) in enumerate(STANDS):
        places[first : last + 1, 2] = 0.6 * index
        if index == 0:
            continue
        before = STANDS[index - 1][1]
        s = np.linspace(0.0, 1.0, first - before + 1)
        places[before : first + 1, 2] = 0.6 * (index - 1 + s**2 * (3.0 - 2.0 * s))
        places[before : first + 1, 1] = 0.1 * np.sin(np.pi * s) ** 2
        vectors[before : first + 1, 0] = 0.9 * np.sin(2.0 * np.pi * s) * np.sin(np.pi * s)
    rotations = np.asarray(from_vector(vectors))
    return _search("a foot", places, rotations, ("space",))


def flying_search(turns: float) -> Search:
    """Return a search on an object that is thrown, and tumbles at some speed [rad/s]."""
    times = np.arange(90) / _RATE
    places = np.outer(times, [5.0, 9.0, 1.0])
    places[:, 1] += 2.0 - 0.5 * 9.81 * times**2
    rotations = np.asarray(from_vector(np.outer(times, turns * np.array([0.48, 0.6, 0.64]))))
    return _search("a ball", places, rotations, ("space",))


def _search(name: str, places: Floats, rotations: Floats, kinds: tuple[str, ...]) -> Search:
    return Search(
        name=name,
        times=np.arange(len(places)) / _RATE,
        translations=places,
        rotations=rotations,
        points=np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.2]]),
        ground=0.0,
        kinds=kinds,
    )
