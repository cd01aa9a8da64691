"""Motions and scenes that are noisy in known ways."""

from collections.abc import Callable

import numpy as np
import pytest

from usdmotion.arrays import Floats
from usdmotion.cast import Character
from usdmotion.demos.gait import Walk, walk
from usdmotion.humanoid import PartMap
from usdmotion.kernels import from_vector, multiply
from usdmotion.motion import Motion, Placement
from usdmotion.scene import Edit, Scene

Smooth = Callable[..., Motion]
Noisy = Callable[..., Motion]
AsScene = Callable[..., Scene]


@pytest.fixture(scope="session")
def smooth() -> Smooth:
    """Return what makes a motion of four joints whose waves are no faster than 1.2 Hz."""

    def make(rate: float = 120.0, seconds: float = 4.0, seed: int = 0) -> Motion:
        random = np.random.default_rng(seed)
        times = np.arange(round(seconds * rate) + 1) / rate
        phase = 2.0 * np.pi * random.uniform(0.2, 1.2, (2, 4, 3)) * times[:, None, None, None]
        waves = np.sin(phase + random.uniform(0.0, 6.0, (2, 4, 3)))
        turns = multiply(from_vector(random.normal(size=(1, 4, 3))), from_vector(0.3 * waves[:, 0]))
        return Motion(times, 0.1 * waves[:, 1], turns)

    return make


@pytest.fixture(scope="session")
def noisy() -> Noisy:
    """Return what turns every joint on every frame by independent errors [degrees]."""

    def make(motion: Motion, sigma: float, seed: int = 0) -> Motion:
        errors = np.random.default_rng(seed).normal(
            0.0, np.radians(sigma), (*motion.rotations.shape[:2], 3)
        )
        turned = multiply(motion.rotations, from_vector(errors))
        return Motion(motion.times, motion.translations, turned)

    return make


@pytest.fixture(scope="session")
def walker() -> Walk:
    """Return a walk that is as clean as can be, at 120 per second."""
    return walk(3.0, 120.0)


@pytest.fixture(scope="session")
def as_scene() -> AsScene:
    """Return what puts a walker with some motion into a scene whose edit cleans its input."""

    def make(
        walker: Walk,
        motion: Motion | None = None,
        cutoff: float = 10.0,
    ) -> Scene:
        motion = motion or walker.motion
        frames = motion.frame_count
        place = Placement.identity(frames)
        character = Character(
            "/Walker",
            walker.skeleton,
            walker.body,
            motion,
            place,
            root=0,
            parts=PartMap(walker.parts),
        )
        edit = Edit("/Walker/Edit", "/Walker", (), cleaning=cutoff)
        up = np.array([0.0, 1.0, 0.0])
        return Scene((character,), (edit,), np.arange(1.0, frames + 1.0), up)

    return make


@pytest.fixture(scope="session")
def apart() -> Callable[[Motion, Motion], Floats]:
    """Return what tells by how much the joints of two motions are turned apart [degrees]."""

    def tell(one: Motion, other: Motion) -> Floats:
        dots = np.abs(np.einsum("fji,fji->fj", one.rotations, other.rotations))
        return np.degrees(2.0 * np.arccos(np.minimum(dots, 1.0)))

    return tell
