"""Motions of which it is known what they obey."""

from collections.abc import Callable

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from usdmotion_contacts import ContactDetector
from usdmotion_contacts.pattern import constant

from usdmotion import Detected, Search, Template, configured

RATE = 120.0


@pytest.fixture(scope="session")
def detect() -> Callable[..., Detected]:
    """Return what runs the detector with some options."""
    return lambda search, **options: configured(ContactDetector, options).detect(search)


@pytest.fixture(scope="session")
def two_stances() -> Callable[..., Search]:
    """Return what makes a second of rest, a step of some length [m], and a second of rest."""

    def make(
        *, length: float = 0.6, swing: float = 0.4, rate: float = RATE, noise: float = 0.0, seed=0,
        **fields: object,
    ) -> Search:  # fmt: skip
        times = np.arange(round((2.0 + swing) * rate) + 1) / rate
        share = np.clip((times - 1.0) / swing, 0.0, 1.0)
        share = share * share * (3.0 - 2.0 * share)
        lift = 0.2 * np.sin(np.pi * share) ** 2
        way = np.stack([length * share, lift, 0.0 * share], axis=1)
        random = np.random.default_rng(seed)
        way += random.normal(scale=1.0, size=way.shape) * noise
        turns = np.stack([0.0 * share, 0.0 * share, 0.8 * lift], axis=1)
        turns += random.normal(scale=5.0, size=way.shape) * noise
        template = (Template("space", 0.1, 0.8),)
        return Search(**{
            "name": "foot",
            "times": times,
            "translations": way,
            "rotations": Rotation.from_rotvec(turns).as_quat(),
            "templates": template,
            **fields,
        })  # fmt: skip

    return make


@pytest.fixture(scope="session")
def held() -> Callable[..., Search]:
    """Return what makes an object that turns, a point of it [m] staying where it is [m]."""

    def make(
        turns: Rotation, *, point=(0.1, 0.2, 0.0), place=(1.0, 2.0, 3.0), rate: float = 60.0,
        noise: float = 0.0, **fields: object,
    ) -> Search:  # fmt: skip
        random = np.random.default_rng(3)
        translations = np.array(place) - turns.apply(np.array(point))
        noisy = turns * Rotation.from_rotvec(random.normal(size=(len(turns), 3)) * 3.0 * noise)
        return Search(**{
            "name": "door",
            "times": np.arange(len(turns)) / rate,
            "translations": translations + random.normal(size=(len(turns), 3)) * noise,
            "rotations": noisy.as_quat(),
            "kinds": ("space", "line", "point"),
            "pattern": constant(1e-5, 1e-5),
            **fields,
        })  # fmt: skip

    return make
