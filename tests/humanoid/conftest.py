"""Skeletons from names."""

from collections.abc import Callable, Mapping

import numpy as np
import pytest

from usdmotion.humanoid import PartMap
from usdmotion.motion import Skeleton

Tree = dict[str, str]
"""The name of each joint, and the name of the joint above it."""


@pytest.fixture
def skeleton_of() -> Callable[..., Skeleton]:
    """Return what makes a skeleton of a hierarchy, with segments of 0.2 m or as told."""

    def build(tree: Tree, lengths: Mapping[str, float] | None = None) -> Skeleton:
        names = list(tree)
        parents = [names.index(above) if above else -1 for above in tree.values()]
        tokens: list[str] = []
        for name, parent in zip(names, parents, strict=True):
            tokens.append(f"{tokens[parent]}/{name}" if parent >= 0 else name)
        offsets = [(0.0, (lengths or {}).get(name, 0.2), 0.0) for name in names]
        upright = np.tile((0.0, 0.0, 0.0, 1.0), (len(names), 1))
        return Skeleton(tuple(tokens), np.array(parents), np.array(offsets), upright)

    return build


@pytest.fixture
def told() -> Callable[[Tree, PartMap], dict[str, str]]:
    """Return what tells the part of each joint that is one, by the joint's name."""

    def tell(tree: Tree, found: PartMap) -> dict[str, str]:
        return {name: part for name, part in zip(tree, found.parts, strict=True) if part}

    return tell


@pytest.fixture
def body() -> Tree:
    """Return a body with the names that most motion capture has."""
    tree = {"Hips": "", "Spine": "Hips", "Chest": "Spine", "Neck": "Chest", "Head": "Neck"}
    for side in ("Left", "Right"):
        arm = [f"{side}{part}" for part in ("Shoulder", "Arm", "ForeArm", "Hand")]
        leg = [f"{side}{part}" for part in ("UpLeg", "Leg", "Foot", "ToeBase")]
        tree |= dict(zip(arm, ("Chest", *arm), strict=False))
        tree |= dict(zip(leg, ("Hips", *leg), strict=False))
    return tree
