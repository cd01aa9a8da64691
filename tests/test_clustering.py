"""Rigid clusters among markers."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from usdmotion.capture import Markers
from usdmotion.clustering import find_clusters
from usdmotion.kernels import rotate

FRAMES = 60
BOX = np.array([(0.1, 0.0, 0.0), (-0.1, 0.05, 0.0), (0.0, -0.05, 0.1), (0.0, 0.0, -0.12)])


@pytest.fixture
def path():
    """Return how a thing moves: rotations and translations of every frame."""
    random = np.random.default_rng(4)
    turns = Rotation.from_rotvec(np.cumsum(random.normal(0.0, 0.08, (FRAMES, 3)), axis=0))
    return turns, np.cumsum(random.normal(0.0, 0.03, (FRAMES, 3)), axis=0)


def carried(points, path):
    turns, shifts = path
    return np.einsum("fij,kj->fki", turns.as_matrix(), points) + shifts[:, None]


def loose(count=3):
    """Return markers that keep no distance to anything."""
    random = np.random.default_rng(5)
    return np.cumsum(random.normal(0.0, 0.05, (FRAMES, count, 3)), axis=0)


def capture(positions, labels=None, seen=None):
    labels = labels or [f"M{each}" for each in "ABCDEFGHIJK"[: positions.shape[1]]]
    seen = np.ones(positions.shape[:2], dtype=bool) if seen is None else seen
    return Markers(tuple(labels), positions, seen)


def test_what_keeps_its_distances_is_one_cluster_that_goes_along(path) -> None:
    markers = capture(np.concatenate([carried(BOX, path), loose()], axis=1))
    (cluster,), notes = find_clusters(markers)
    assert not notes
    assert cluster.labels == ("MA", "MB", "MC", "MD")
    assert cluster.residual < 1e-9
    assert cluster.placed.all()
    turns, _ = path
    relative = Rotation.from_quat(cluster.rotations).inv() * turns
    # Its axes are the world's on the first frame, and it turns as the thing does.
    np.testing.assert_allclose(cluster.rotations[0], (0.0, 0.0, 0.0, 1.0), atol=1e-9)
    np.testing.assert_allclose(relative.as_matrix(), relative[:1].as_matrix().repeat(60, 0))
    for point, label in zip(cluster.points, cluster.labels, strict=True):
        world = cluster.translations + rotate(cluster.rotations, np.tile(point, (FRAMES, 1)))
        want = markers.positions[:, markers.labels.index(label)]
        np.testing.assert_allclose(world, want, atol=1e-9)


def test_a_missing_marker_does_not_move_the_cluster(path) -> None:
    positions = np.concatenate([carried(BOX, path), loose()], axis=1)
    (whole,), _ = find_clusters(capture(positions))
    seen = np.ones(positions.shape[:2], dtype=bool)
    seen[10:20, 0] = seen[15:40, 3] = False
    hidden = np.where(seen[..., None], positions, 99.0)
    (cluster,), _ = find_clusters(capture(hidden, seen=seen))
    np.testing.assert_array_equal(cluster.placed, seen[:, :4].sum(axis=1) >= 3)
    placed = cluster.placed
    np.testing.assert_allclose(cluster.translations[placed], whole.translations[placed], atol=1e-9)
    np.testing.assert_allclose(cluster.rotations[placed], whole.rotations[placed], atol=1e-7)
    # In the gap it goes evenly, and does not stand.
    gap = np.flatnonzero(~placed)
    steps = np.diff(cluster.translations[gap[0] - 1 : gap[-1] + 2], axis=0)
    np.testing.assert_allclose(steps, steps[:1].repeat(len(steps), 0), atol=1e-12)


def test_where_the_world_is_does_not_matter(path) -> None:
    positions = np.concatenate([carried(BOX, path), loose()], axis=1)
    turn = Rotation.from_rotvec((0.4, -2.0, 1.0))
    moved = positions @ turn.as_matrix().T + (5.0, -3.0, 100.0)
    (one,), _ = find_clusters(capture(positions))
    (other,), _ = find_clusters(capture(moved))
    assert one.labels == other.labels
    wanted = one.translations @ turn.as_matrix().T + (5.0, -3.0, 100.0)
    np.testing.assert_allclose(other.translations, wanted, atol=1e-9)


def test_three_on_a_line_tell_no_turn(path) -> None:
    line = np.outer((0.0, 0.1, 0.25), (1.0, 0.0, 0.0))
    clusters, _ = find_clusters(capture(np.concatenate([carried(line, path), loose()], axis=1)))
    assert not clusters


def test_segments_are_known_by_their_labels_though_skin_moves(path) -> None:
    skin = np.random.default_rng(6).normal(0.0, 0.006, (FRAMES, 4, 3))
    labels = ["Matt:LASI", "Matt:RASI", "Matt:LPSI", "Matt:RPSI", "A", "B", "C"]
    positions = np.concatenate([carried(BOX, path) + skin, loose()], axis=1)
    (cluster,), _ = find_clusters(capture(positions, labels))
    assert cluster.name == "Pelvis"
    assert 0.002 < cluster.residual < 0.02


def test_two_subjects_have_clusters_of_their_own(path) -> None:
    turns, shifts = path
    other = carried(BOX, (turns.inv(), shifts + np.array((1.5, 0.0, 0.0))))
    labels = [
        f"{name}:{mark}" for name in ("Matt", "Ann") for mark in ("LASI", "RASI", "LPSI", "RPSI")
    ]
    clusters, _ = find_clusters(
        capture(np.concatenate([carried(BOX, path), other], axis=1), labels)
    )
    assert [each.name for each in clusters] == ["Pelvis", "Ann_Pelvis"]
    assert all(label.startswith("Ann:") for label in clusters[1].labels)


def test_labels_that_lie_are_not_believed(path) -> None:
    clusters, _ = find_clusters(capture(loose(4), ["LASI", "RASI", "LPSI", "RPSI"]))
    assert not clusters


def test_numbers_of_one_stem_are_a_segment(path) -> None:
    positions = np.concatenate([carried(BOX, path), loose()], axis=1)
    labels = ["RFT1", "RFT2", "RFT3", "rft4", "A", "B", "C"]
    (cluster,), _ = find_clusters(capture(positions, labels))
    assert cluster.name == "RFT"


def test_markers_that_stand_still_tell_nothing() -> None:
    positions = np.random.default_rng(7).uniform(0.0, 0.6, (1, 6, 3)).repeat(FRAMES, axis=0)
    clusters, notes = find_clusters(capture(positions))
    assert not clusters
    assert "hardly move" in notes[0]
