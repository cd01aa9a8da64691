"""Finds which markers are on one rigid thing, and where that is on every frame."""

from collections.abc import Sequence
from itertools import combinations, takewhile

import numpy as np
from scipy.cluster.hierarchy import fcluster, linkage
from scipy.spatial.distance import squareform
from scipy.spatial.transform import Rotation, Slerp

from usdmotion.arrays import Bools, Floats, Ints
from usdmotion.capture import Cluster, Markers
from usdmotion.marker_sets import plain, segments_of

_RIGID = 0.004
"""Distances between markers of one rigid thing vary by less than this [m]."""
_SOFT = 0.025
"""A segment that its labels tell is rigid as long as they fit it this well [m]: skin moves."""
_REACH = 0.7
"""Markers farther from each other than this are on no rigid thing [m]."""
_FEWEST = 10
"""Frames on which two markers must be seen together before anything is said about them."""
_FLAT = 0.01
"""Markers that are on a line to this [m] do not tell how it turns about the line."""
_ROUNDS = 3


def find_clusters(markers: Markers) -> tuple[tuple[Cluster, ...], tuple[str, ...]]:
    """Return the rigid clusters among markers, and a sentence about what could not be told.

    Segments that the labels tell come first (feet, shanks, pelvis, head, …), then whatever among
    the other markers keeps its mutual distances throughout.
    """
    found, taken = [], set()
    for name, riding in segments_of(markers.labels).items():
        members = np.array([markers.labels.index(label) for label in riding])
        cluster = _cluster(name, members, markers)
        if cluster is not None and cluster.residual < _SOFT:
            found.append(cluster)
            taken |= set(members.tolist())
    free = np.array([each for each in range(len(markers.labels)) if each not in taken], dtype=int)
    spreads = _spreads(markers, free)
    pairs = spreads[np.triu_indices(len(free), 1)]
    if len(pairs) and np.median(pairs) < _RIGID and len(free) > 3:
        still = "the markers hardly move, so that nothing tells which are rigid to each other"
        return tuple(found), (still,)
    names = {cluster.name for cluster in found}
    for members in _groups(spreads):
        labels = [markers.labels[each] for each in free[members]]
        name = _name(labels, markers.labels, names)
        cluster = _cluster(name, free[members], markers)
        if cluster is not None and cluster.residual < _RIGID:
            found.append(cluster)
            names.add(cluster.name)
    return tuple(found), ()


def _spreads(markers: Markers, free: Ints) -> Floats:
    """Return how much each distance varies [m], inf where nothing says, (count, count)."""
    spreads = np.full((len(free), len(free)), np.inf)
    np.fill_diagonal(spreads, 0.0)
    for one, other in combinations(range(len(free)), 2):
        both = markers.seen[:, free[one]] & markers.seen[:, free[other]]
        if both.sum() < _FEWEST:
            continue
        apart = markers.positions[both, free[one]] - markers.positions[both, free[other]]
        low, middle, high = np.percentile(np.linalg.norm(apart, axis=1), (5, 50, 95))
        if middle < _REACH:
            spreads[one, other] = spreads[other, one] = 0.5 * (high - low)
    return spreads


def _groups(spreads: Floats) -> list[Ints]:
    """Return the members of each group of three or more in which every distance is kept."""
    if len(spreads) < 3:
        return []
    # Complete linkage: no pair of a group varies by more than the height at which it is cut.
    tree = linkage(squareform(np.minimum(spreads, 1.0), checks=False), method="complete")
    numbers = fcluster(tree, _RIGID, criterion="distance")
    groups = [np.flatnonzero(numbers == number) for number in dict.fromkeys(numbers.tolist())]
    return [group for group in groups if len(group) >= 3]


def _name(labels: Sequence[str], every: Sequence[str], taken: set[str]) -> str:
    """Return what only a group's labels have in common, or a number where there is nothing."""
    words = sorted(plain(label) for label in labels)
    common = "".join(
        letter for letter, _ in takewhile(_alike, zip(words[0], words[-1], strict=False))
    )
    alone = sum(plain(label).startswith(common) for label in every) == len(labels)
    common = common.rstrip("0123456789_")
    if alone and len(common) >= 2 and common.isidentifier() and common not in taken:
        return common
    number = 1
    while f"Cluster{number}" in taken:
        number += 1
    return f"Cluster{number}"


def _alike(letters: tuple[str, str]) -> bool:
    return letters[0] == letters[1]


def _cluster(name: str, members: Ints, markers: Markers) -> Cluster | None:
    positions, seen = markers.positions[:, members], markers.seen[:, members]
    whole = seen.sum(axis=1) >= 3
    if whole.sum() == 0:
        return None
    points = _shape(positions, seen)
    placed = whole & _wide(points, seen)
    if not placed.any():
        return None
    turns, centers = _place_shape(points, positions[placed], seen[placed])
    away = positions[placed] - (np.einsum("fij,kj->fki", turns, points) + centers[:, None])
    squares = (away**2).sum(axis=2)[seen[placed]]
    # The axes of a cluster are the world's where it is placed first.
    points, turns = points @ turns[0].T, turns @ turns[0].T
    rotations, translations = _filled(turns, centers, placed)
    return Cluster(
        name=name,
        labels=tuple(markers.labels[each] for each in members),
        points=points,
        translations=translations,
        rotations=rotations,
        placed=placed,
        residual=float(np.sqrt(squares.mean())),
    )


def _shape(positions: Floats, seen: Bools) -> Floats:
    """Return the mean shape of a cluster, its mean at the origin, (marker_count, 3).

    A generalized Procrustes mean that starts from the frame on which most of it is seen.
    """
    count = seen.sum(axis=1)
    best = int(count.argmax())
    known = seen[best].copy()
    shape = np.where(known[:, None], positions[best], 0.0)
    for _ in range(_ROUNDS):
        usable = (seen & known).sum(axis=1) >= 3
        turns, centers = _place_shape(shape, positions[usable], seen[usable] & known)
        inside = np.einsum("fji,fkj->fki", turns, positions[usable] - centers[:, None])
        weight = seen[usable].sum(axis=0)
        sums = (inside * seen[usable, :, None]).sum(axis=0)
        shape = np.where(weight[:, None] > 0, sums / np.maximum(weight, 1)[:, None], shape)
        known = weight > 0
    return np.asarray(shape - shape.mean(axis=0))


def _wide(points: Floats, seen: Bools) -> Bools:
    """Tell on which frames what is seen of a shape is not just a line, (frame_count,)."""
    weights = seen / np.maximum(seen.sum(axis=1, keepdims=True), 1)
    off = (points - (weights @ points)[:, None]) * np.sqrt(weights)[..., None]
    return np.asarray(np.linalg.svd(off, compute_uv=False)[:, 1] > _FLAT)


def _place_shape(shape: Floats, positions: Floats, seen: Bools) -> tuple[Floats, Floats]:
    """Return the turns and shifts that lay a shape on what is seen of it, in least squares.

    W. Kabsch, "A solution for the best rotation to relate two sets of vectors", Acta
    Crystallographica A 32 (1976).

    Args:
        shape: Points of the shape, shape (marker_count, 3).
        positions: Where they were, shape (frame_count, marker_count, 3).
        seen: Which of them count, shape (frame_count, marker_count), three a frame at least.

    Returns:
        Rotation matrices (frame_count, 3, 3) and translations (frame_count, 3).
    """
    weights = seen / seen.sum(axis=1, keepdims=True)
    center = weights @ shape
    middle = np.einsum("fk,fki->fi", weights, positions)
    covariance = np.einsum(
        "fki,fkj,fk->fij", positions - middle[:, None], shape - center[:, None], weights
    )
    left, _, right = np.linalg.svd(covariance)
    proper = np.ones((len(positions), 3))
    proper[:, 2] = np.sign(np.linalg.det(left @ right))
    turns = (left * proper[:, None]) @ right
    return turns, middle - np.einsum("fij,fj->fi", turns, center)


def _filled(turns: Floats, centers: Floats, placed: Bools) -> tuple[Floats, Floats]:
    """Return rotations and translations of all frames: between placed ones they go evenly."""
    frames = np.arange(len(placed))
    known = np.flatnonzero(placed)
    translations = np.stack([np.interp(frames, known, each) for each in centers.T], axis=1)
    every = np.clip(frames, known[0], known[-1])
    rotations = Rotation.from_matrix(turns)
    if len(known) > 1:
        rotations = Slerp(known, rotations)(every)
    quaternions = np.broadcast_to(rotations.as_quat(), (len(placed), 4)).copy()
    signs = np.sign((quaternions[1:] * quaternions[:-1]).sum(axis=1))
    quaternions[1:] *= np.cumprod(np.where(signs < 0, -1.0, 1.0))[:, None]
    return quaternions, translations
