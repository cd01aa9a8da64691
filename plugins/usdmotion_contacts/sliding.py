"""Contacts that slide: an object's origin stays on a plane or on a line while it moves.

The paper leaves them out (2006, section 3.1), because no displacement tells of them: one place
after the other is on a line with the next. So they are looked for in the trajectory itself, as its
longest pieces that are flat, or straight, within ε_max. So are short pieces of any smooth curve;
but those bend, and noise does not. This is geometry, and does not say why: a ball that is thrown
stays on a plane as well, and a limb that swings about one axis does.
"""

import math
from typing import NamedTuple

import numpy as np

from usdmotion import Contact, Floats, Search, Template
from usdmotion.kernels import kernel, shared
from usdmotion_contacts.displacements import SLACK, Displacements
from usdmotion_contacts.eigen import eigen
from usdmotion_contacts.merging import Tolerances, tolerances
from usdmotion_contacts.tolerance import frame_tolerance

WIDE = 10.0
"""A plane is known where the trajectory is so many times as wide on it as ε_max."""

UPRIGHT = 1e-3
"""A plane is upright where up is along it but for so much: then it has the sense of the motion."""

PARTS = 5
"""A piece that bends is seen by the means of so many parts of it."""
BENT = 0.25
"""Such a mean is more than this share of ε_max off. A parabola, or a cubic, that is as long as it
can be within ε_max has one of at least 0.4; noise is that far in one frame, not in the mean of
many."""


class _Path(NamedTuple):
    """A trajectory, and room for what is fitted to a piece of it."""

    times: Floats
    places: Floats
    """From where the object was at first [m], shape (frame_count, 3)."""
    epsilon: Floats
    """ε_max of each frame [m]."""
    limits: Tolerances
    flat: bool
    """Whether to look for planes, and not for lines."""
    length: float
    """How long a piece has to be, from end to end [m]."""
    width: float
    """How wide one on a plane has to be [m]."""
    sums: Floats
    """Of 1, the places, and their products, shape (10,)."""
    center: Floats
    values: Floats
    vectors: Floats
    """Across a plane, along it, and the longest way last, by columns, shape (3, 3)."""
    work: Floats
    parts: Floats
    """Of each part of its length: frames, Σ ε_max, and sums across it, shape (PARTS, 4)."""


class _Found(NamedTuple):
    """Pieces, shapes (piece_count, …)."""

    frames: Floats
    """First and last frame."""
    centers: Floats
    axes: Floats
    strays: Floats
    """Largest distance from the plane or line [m]."""


def slides(search: Search, moves: Displacements, kind: str, epsilon: Floats) -> list[Contact]:
    """Return the contacts of kind `plane` or `slide`.

    A piece has to be as long as d_max: what moves less is at one place. One on a plane has to be
    as wide as dist_max as well, for else nothing tells which plane it is. And it has to have two
    frames on each part of its length, with which it can be told from a piece of a curve.

    Args:
        search: The motion.
        moves: Its displacements, which know how far apart samples are.
        kind: `plane` or `slide`.
        epsilon: ε_max of each frame [m], shape (frame_count,).
    """
    frames = len(search.times)
    path = _Path(
        times=search.times, places=search.translations - search.translations[0],
        epsilon=epsilon, limits=tolerances(search, moves), flat=kind == "plane",
        length=search.gap_distance, width=search.merge_distance, sums=np.zeros(10),
        center=np.zeros(3), values=np.zeros(3), vectors=np.zeros((3, 3)), work=np.zeros((3, 3)),
        parts=np.zeros((PARTS, 4)),
    )  # fmt: skip
    found = _Found(*(np.zeros((frames, n)) for n in (2, 3, 3, 1)))
    count = _find(path, found) if frames > 2 else 0
    return [
        _contact(search, kind, *(each[i] for each in found))
        for i in range(count)
        if np.diff(search.times[found.frames[i].astype(int)])[0] >= search.minimum - SLACK
    ]


def strays(search: Search, template: Template) -> Floats:
    """Return how far an object is from the plane or line that a template says it stays on [m]."""
    inside = search.times >= template.start - SLACK
    inside &= search.times <= template.end + SLACK
    places = search.translations[inside]
    around = places - places[0]
    around -= around.mean(axis=0)
    axes = np.linalg.svd(around, full_matrices=False)[2]
    across = axes[2:] if template.kind == "plane" else axes[1:]
    return np.asarray(np.linalg.norm(around @ across.T, axis=1))


def _contact(
    search: Search, kind: str, frames: Floats, center: Floats, axis: Floats, stray: Floats
) -> Contact:
    """Return a piece as a contact, its axis along the motion, or to where up is of a plane."""
    start, end = (int(frame) for frame in frames)
    way = search.translations[start : end + 1]
    if kind == "slide":
        sense = axis @ (way[-1] - way[0])
    else:
        sense = axis @ search.up
        if abs(sense) < UPRIGHT:
            around = way - way.mean(axis=0)
            sense = axis @ np.cross(around[:-1], around[1:]).sum(axis=0)
    return Contact(
        kind=kind,
        start=float(search.times[start]),
        end=float(search.times[end]),
        point=np.zeros(3),
        location=center + search.translations[0],
        orientation=search.rotations[start],
        axis=-axis if sense < 0.0 else axis,
        residual=float(stray[0]),
    )


@kernel
def _find(path: _Path, found: _Found) -> int:
    """Write the longest pieces, one after the other, and return how many there are."""
    count, free, start = 0, 0, 0
    while start < path.times.shape[0] - 2:
        end, begin = _grow(path, start), start
        while begin > free and _off(path, begin - 1) <= path.epsilon[begin - 1]:
            begin -= 1
        if not (_is_wide(path, begin, end) and _is_even(path, begin, end)):
            start += max(1, (end - start) // 2)
            continue
        start = begin
        found.frames[count, 0], found.frames[count, 1] = start, end
        for i in range(3):
            found.centers[count, i] = path.center[i]
            found.axes[count, i] = path.vectors[i, 0 if path.flat else 2]
        for frame in range(start, end + 1):
            found.strays[count, 0] = max(found.strays[count, 0], _off(path, frame))
        count += 1
        free = start = end + 1
    return count


@shared
def _grow(path: _Path, start: int) -> int:
    """Fit the longest piece from a frame on, and return the last frame of it.

    A frame that is off is left out, and the piece goes on if it soon is back, and not far away.
    """
    path.sums[:] = 0.0
    last = start
    for frame in range(start, path.times.shape[0]):
        apart = (path.times[frame] - path.times[last]) / path.limits.interval
        if frame - last > 1:
            if apart > path.limits.frames + SLACK:
                break
            way = math.sqrt(_square(path, frame, last))
            if apart > frame_tolerance(way, path.limits.frames, path.limits.farthest) + SLACK:
                continue
        _add(path, frame, 1.0)
        if path.sums[0] > 2.0 and not _fits(path, frame):
            _add(path, frame, -1.0)
            continue
        last = frame
    _fit(path)
    return last


@shared
def _square(path: _Path, frame: int, other: int) -> float:
    """Return the squared distance between the places on two frames [m²]."""
    square = 0.0
    for i in range(3):
        square += (path.places[frame, i] - path.places[other, i]) ** 2
    return square


@shared
def _add(path: _Path, frame: int, sign: float) -> None:
    """Count the place of a frame in, or out."""
    place = path.places[frame]
    path.sums[0] += sign
    column = 4
    for i in range(3):
        path.sums[1 + i] += sign * place[i]
        for j in range(i, 3):
            path.sums[column] += sign * place[i] * place[j]
            column += 1


@shared
def _fit(path: _Path) -> None:
    """Find the middle and the main axes of what was counted in."""
    count, column = path.sums[0], 4
    for i in range(3):
        path.center[i] = path.sums[1 + i] / count
    for i in range(3):
        for j in range(i, 3):
            spread = path.sums[column] / count - path.center[i] * path.center[j]
            path.work[i, j] = path.work[j, i] = spread
            column += 1
    eigen(path.work, path.values, path.vectors)


@shared
def _fits(path: _Path, frame: int) -> bool:
    """Return whether all that was counted in, and a frame by itself, is flat or straight."""
    _fit(path)
    square = path.values[0] if path.flat else path.values[0] + path.values[1]
    epsilon = path.epsilon[frame]
    return bool(square <= epsilon**2 and _off(path, frame) <= epsilon)


@shared
def _off(path: _Path, frame: int) -> float:
    """Return how far a frame is from the plane or line [m]."""
    square = 0.0
    for axis in range(1 if path.flat else 2):
        square += _from(path, frame, axis) ** 2
    return math.sqrt(square)


@shared
def _is_wide(path: _Path, start: int, end: int) -> bool:
    """Return whether a piece is as long, and on a plane as wide, as it has to be."""
    low, high = _span(path, start, end, 2)
    if high - low < path.length:
        return False
    least = max(path.width, WIDE * path.epsilon[start])
    narrow, wide = _span(path, start, end, 1)
    return not path.flat or wide - narrow >= least


@shared
def _is_even(path: _Path, start: int, end: int) -> bool:
    """Return whether a piece does not bend: no part of its length is off as a whole."""
    low, high = _span(path, start, end, 2)
    path.parts[:] = 0.0
    for frame in range(start, end + 1):
        if _off(path, frame) > path.epsilon[frame]:
            continue
        share = (_from(path, frame, 2) - low) / (high - low)
        sums = path.parts[min(PARTS - 1, int(PARTS * share))]
        sums[0] += 1.0
        sums[1] += path.epsilon[frame]
        sums[2] += _from(path, frame, 0)
        sums[3] += 0.0 if path.flat else _from(path, frame, 1)
    for part in range(PARTS):
        count, epsilon, across, along = path.parts[part]
        if count < 2.0 or math.sqrt(across**2 + along**2) > BENT * epsilon:
            return False
    return True


@shared
def _from(path: _Path, frame: int, axis: int) -> float:
    """Return how far a frame is from the middle, along one of the main axes [m]."""
    along = 0.0
    for i in range(3):
        along += path.vectors[i, axis] * (path.places[frame, i] - path.center[i])
    return along


@shared
def _span(path: _Path, start: int, end: int, axis: int) -> tuple[float, float]:
    """Return from where to where a piece goes along a main axis, without what is off [m]."""
    low, high = 0.0, 0.0
    for frame in range(start, end + 1):
        if _off(path, frame) <= path.epsilon[frame]:
            along = _from(path, frame, axis)
            low, high = min(low, along), max(high, along)
    return low, high
