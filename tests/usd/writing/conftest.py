"""What several tests of writing need."""

import numpy as np
import pytest
from pxr import Usd

from usdmotion import usd
from usdmotion.kernels import from_vector, multiply
from usdmotion.motion import Motion


def bend(shot, joint="hip/knee", *, angle=0.3, move=0.0, frames=slice(None)):
    """Return a result in which one joint of the first edit is turned, and moved."""
    scene = shot.scenes[0]
    character = scene.character(scene.edits[0].skeleton)
    index = character.skeleton.index[joint]
    motion = character.motion
    translations, rotations = motion.translations.copy(), motion.rotations.copy()
    turn = from_vector(np.array((angle, 0.0, 0.0)))
    rotations[frames, index] = multiply(rotations[frames, index], turn)
    translations[frames, index] += move
    return usd.Result(
        scene.edits[0].path,
        Motion(motion.times, translations, rotations),
        "bender",
        {"angle": angle},
    )


@pytest.fixture(scope="session")
def bent():
    """Return a function that makes a result in which one joint is turned, and moved."""
    return bend


@pytest.fixture
def shot(text, save, read):
    return read(save(text.man()))


@pytest.fixture
def solved(tmp_path):
    """Return a function that writes results over a shot and opens the stage that shows them."""

    def run(shot, *results, suffix=".usda"):
        layer, composed = tmp_path / f"edit{suffix}", tmp_path / "composed.usda"
        usd.write(shot, results, layer)
        usd.compose(shot, layer, composed)
        return Usd.Stage.Open(str(composed))

    return run
