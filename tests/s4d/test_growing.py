"""A body whose segments change their lengths from frame to frame."""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.kernels import forward
from usdmotion.motion import Motion, Placement
from usdmotion.s4d import Morphology, restore

from .conftest import UP, built, moving, put, steps, taken

FRAMES = 121


def grown(body: Morphology, scales: Floats) -> Motion:
    """Return a motion on a body of so many times the size on each frame."""
    sizes = scales[:, None, None] * body.skeleton.rest_translations
    normalized = taken(moving(body, frames=FRAMES), body)
    return restore(normalized, body, Placement.identity(FRAMES), up=UP, translations=sizes)


def jerks(body: Morphology, motion: Motion) -> float:
    """Return the largest change of the velocity of any joint between frames [m]."""
    places, _ = forward(body.skeleton.parents, motion.translations, motion.rotations)
    return float(np.abs(np.diff(places, n=2, axis=0)).max())


def test_lengths_that_stay_are_a_body_of_that_size(body: Morphology) -> None:
    motion, expected = grown(body, np.full(FRAMES, 1.3)), built(1.3 * 1.7)
    other = put(taken(moving(body, frames=FRAMES), body), expected)
    assert np.abs(motion.translations - other.translations).max() < 1e-9
    assert np.abs(motion.rotations - other.rotations).max() < 1e-9


def test_nothing_jumps_where_it_grows_and_shrinks(body: Morphology) -> None:
    steady = grown(body, np.ones(FRAMES))
    growing = grown(body, 1.0 + 0.4 * np.sin(np.linspace(0.0, 6.0, FRAMES)))
    assert jerks(body, growing) < 2.0 * jerks(body, steady)
    assert steps(growing.rotations).max() < 1.1 * steps(steady.rotations).max()


def test_who_grows_far_away_does_not_slide_off(body: Morphology) -> None:
    """Somebody who stands still a hundred metres away stands still as he grows."""
    still = moving(body, frames=1, size=0.0)
    places = np.repeat(still.translations, FRAMES, axis=0)
    places[:, 0] += (100.0, 0.0, 50.0)
    motion = Motion(np.arange(FRAMES) / 30.0, places, np.repeat(still.rotations, FRAMES, axis=0))
    sizes = np.linspace(1.0, 1.5, FRAMES)[:, None, None] * body.skeleton.rest_translations
    grown_there = restore(
        taken(motion, body), body, Placement.identity(FRAMES), up=UP, translations=sizes
    )
    root = grown_there.translations[:, 0]
    assert np.abs(root[:, (0, 2)] - root[0, (0, 2)]).max() < 1e-9
    positions, _ = forward(body.skeleton.parents, grown_there.translations, grown_there.rotations)
    ankles = positions[:, [body.limbs[1].end, body.limbs[3].end], 1]
    heights = np.linspace(1.0, 1.5, FRAMES) * body.standing_heights[0]
    assert np.allclose(ankles, heights[:, None], atol=1e-6)
