"""Forward kinematics, with plain matrices beside it."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from usdmotion.kernels import compose, forward, relative, world_points
from usdmotion.testing import humanoid_scene

CAST = humanoid_scene(frame_count=3).cast


def matrix(translation: np.ndarray, rotation: np.ndarray) -> np.ndarray:
    out = np.eye(4)
    out[:3, :3] = Rotation.from_quat(rotation).as_matrix()
    out[:3, 3] = translation
    return out


def test_world_transforms_are_the_product_of_the_matrices_above() -> None:
    positions, orientations = forward(CAST.parents, CAST.translations, CAST.rotations)
    for frame in range(CAST.frame_count):
        worlds: list[np.ndarray] = []
        for node, parent in enumerate(CAST.parents):
            local = matrix(CAST.translations[frame, node], CAST.rotations[frame, node])
            worlds.append(worlds[parent] @ local if parent >= 0 else local)
            found = matrix(positions[frame, node], orientations[frame, node])
            np.testing.assert_allclose(found, worlds[node], atol=1e-12)


@given(st.integers(0, 2**32 - 1))
def test_a_long_chain_keeps_unit_quaternions(seed: int) -> None:
    random = np.random.default_rng(seed)
    count = 60
    parents = np.arange(-1, count - 1)
    translations = random.normal(size=(1, count, 3))
    rotations = Rotation.random(count, rng=random).as_quat()[None]
    _, orientations = forward(parents, translations, rotations)
    np.testing.assert_allclose(np.linalg.norm(orientations, axis=-1), 1.0, atol=1e-14)


def test_a_frame_seen_from_another_is_put_back_by_composing() -> None:
    a, b = CAST.index["/Humanoid", "pelvis"], CAST.index["/Humanoid", "pelvis/spine/chest/head"]
    positions, orientations = CAST.positions, CAST.orientations
    seen = relative(positions[:, a], orientations[:, a], positions[:, b], orientations[:, b])
    back = compose(positions[:, a], orientations[:, a], *seen)
    np.testing.assert_allclose(back[0], positions[:, b], atol=1e-12)
    np.testing.assert_allclose(back[1], orientations[:, b], atol=1e-12)


def test_points_are_carried_by_their_joints() -> None:
    point = np.array([0.1, 0.2, 0.3])
    found = world_points(CAST.positions, CAST.orientations, point)
    node = 7
    wanted = matrix(CAST.positions[1, node], CAST.orientations[1, node]) @ np.append(point, 1.0)
    np.testing.assert_allclose(found[1, node], wanted[:3], atol=1e-12)
