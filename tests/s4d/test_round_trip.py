"""What is normalized, written and restored on the same skeleton is the same motion."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from usdmotion_bvh import BvhReader

from usdmotion.arrays import Floats
from usdmotion.demos.body import humanoid
from usdmotion.humanoid import PartMap, guess
from usdmotion.kernels import from_vector
from usdmotion.motion import Motion, Placement, Skeleton
from usdmotion.s4d import Morphology, NormalizedMotion, normalize, restore

from .conftest import apart

UP = {"Y": np.array((0.0, 1.0, 0.0)), "Z": np.array((0.0, 0.0, 1.0))}
CLIPS = ("cmu/mb/*", "cmu/daz/*", "cmu/daz_hands/*", "cmu/iclone/*", "other/*")


ROUNDED = (
    "limb_frames",
    "segment_rotations",
    "spine",
    "root_position",
    "root_heading",
    "root_orientation",
    "extra_rotations",
    "offsets",
)
"""What is written in single precision."""


def written(normalized: NormalizedMotion) -> NormalizedMotion:
    """Return a motion as a file keeps it."""
    own = {name: getattr(normalized, name).astype(np.float32) for name in ROUNDED}
    return replace(normalized, **own)


def there_and_back(
    skeleton: Skeleton, parts: PartMap, motion: Motion, placement: Placement, up: Floats
) -> Motion:
    body = Morphology.of(skeleton, parts, poses=motion)
    normalized = normalize(motion, placement, body, up=up)
    return restore(written(normalized), body, placement, up=up)


@pytest.mark.parametrize("axis", UP)
def test_any_postures_of_any_placement_come_back(axis: str) -> None:
    skeleton, _, parts = humanoid()
    generator = np.random.default_rng(5)
    rotations = from_vector(generator.normal(size=(40, len(parts), 3)))
    places = np.broadcast_to(skeleton.rest_translations, (40, len(parts), 3))
    shaken = places + 0.01 * generator.normal(size=places.shape)
    motion = Motion(np.arange(40) / 30.0, shaken, rotations)
    turns = from_vector(generator.normal(size=(40, 3)))
    placement = Placement(generator.normal(size=(40, 3)), turns)
    back = there_and_back(skeleton, PartMap(parts), motion, placement, UP[axis])
    metres, degrees = apart(skeleton, motion, back)
    assert metres < 5e-6
    assert degrees < 1e-3


@pytest.mark.parametrize("pattern", CLIPS)
def test_captured_motion_comes_back(mocap: Path, pattern: str) -> None:
    for path in sorted(mocap.glob(f"{pattern}.bvh")):
        clip = BvhReader().read(path)
        parts = guess(clip.skeleton, names=clip.original_names)
        placement = Placement.identity(clip.motion.frame_count)
        back = there_and_back(clip.skeleton, parts, clip.motion, placement, UP[clip.up])
        metres, degrees = apart(clip.skeleton, clip.motion, back)
        assert metres <= 1e-4, path
        assert degrees <= 0.1, path
