"""Bodies, postures and comparisons that tests of normalized motion share."""

import numpy as np
import pytest

from usdmotion.arrays import Floats
from usdmotion.demos.body import USUAL, Proportions, humanoid
from usdmotion.humanoid import PartMap
from usdmotion.kernels import conjugate, forward, from_vector, multiply, to_vector
from usdmotion.motion import Motion, Placement, Skeleton
from usdmotion.s4d import Morphology, NormalizedMotion, normalize, restore

UP = np.array((0.0, 1.0, 0.0))


@pytest.fixture(scope="session")
def body() -> Morphology:
    return built()


def built(height: float = 1.7, proportions: Proportions = USUAL) -> Morphology:
    skeleton, _, parts = humanoid(height, proportions=proportions)
    return Morphology.of(skeleton, PartMap(parts))


def moving(body: Morphology, *, seed: int = 1, frames: int = 61, size: float = 0.4) -> Motion:
    """Return a motion that wanders smoothly through postures, each axis by so much [rad]."""
    generator = np.random.default_rng(seed)
    times = np.arange(frames) / 30.0
    phase, speed = generator.uniform(0.0, 6.0, size=(2, len(body.skeleton.joints), 3))
    turns = size * np.sin(phase + 0.5 * speed * times[:, None, None])
    rotations = multiply(body.skeleton.rest_rotations, from_vector(turns))
    places = np.array(np.broadcast_to(body.skeleton.rest_translations, turns.shape))
    places[:, 0] += np.stack([0.3 * times, 0.05 * np.sin(times), 0.8 * times], axis=1)
    return Motion(times, places, rotations)


def apart(skeleton: Skeleton, a: Motion, b: Motion) -> tuple[float, float]:
    """Return how far joints are apart at most [m] and how much they are turned [degrees]."""
    (places, turns), (others, turned) = (
        forward(skeleton.parents, each.translations, each.rotations) for each in (a, b)
    )
    angles = np.linalg.norm(to_vector(multiply(conjugate(turns), turned)), axis=-1)
    return float(np.linalg.norm(others - places, axis=-1).max()), float(np.degrees(angles.max()))


def taken(motion: Motion, body: Morphology) -> NormalizedMotion:
    return normalize(motion, Placement.identity(motion.frame_count), body, up=UP)


def put(normalized: NormalizedMotion, body: Morphology) -> Motion:
    return restore(normalized, body, Placement.identity(len(normalized.times)), up=UP)


def steps(rotations: Floats) -> Floats:
    """Return how far joints turn from frame to frame, (F − 1, J) [degrees]."""
    turns = multiply(conjugate(rotations[:-1]), rotations[1:])
    return np.degrees(np.linalg.norm(to_vector(turns), axis=-1))
