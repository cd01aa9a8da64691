"""Chains of joints cut at other places: spine, neck and digits with other joint counts."""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.kernels import multiply, rotate
from usdmotion.s4d.turns import IDENTITY, Y, along, swing, unit


def spine_points(lengths: Floats, rotations: Floats) -> Floats:
    """Return the points of a spine without its curvature at rest, over its length.

    Args:
        lengths: From the pelvis to the first vertebra, from one to the next, and from the last one
            to where the neck begins [m], shape (F or 1, N + 1).
        rotations: Of the vertebrae as seen from the pelvis, shape (F, N, 4).

    Returns:
        Points as seen from the pelvis, shape (F, N + 2, 3).
    """
    frames, count = rotations.shape[:2]
    steps = np.empty((frames, count + 1, 3))
    steps[:, 0], steps[:, 1:] = Y, rotate(rotations, Y)
    points = np.zeros((frames, count + 2, 3))
    np.cumsum(steps * shares(lengths)[..., None], axis=1, out=points[:, 1:])
    return points


def shares(lengths: Floats) -> Floats:
    """(…, N) to (…, N): lengths over their sum; even ones where there is no length."""
    whole = lengths.sum(axis=-1, keepdims=True)
    return np.where(
        whole > 0.0, lengths / np.where(whole > 0.0, whole, 1.0), 1.0 / lengths.shape[-1]
    )


def cut_spine(points: Floats, rotations: Floats, lengths: Floats) -> Floats:
    """Return the rotations of the vertebrae of another spine (2005, section 4).

    Each lies along its piece of the spline, turned about it as the spine is there; the last one,
    which carries arms and head, is turned as the last one was.

    Args:
        points: Of the spine, shape (F, N + 2, 3).
        rotations: Of its vertebrae as seen from the pelvis, shape (F, N, 4).
        lengths: Of the other spine, as in `spine_points`, shape (M + 1,).

    Returns:
        Rotations as seen from the pelvis, shape (F, M, 4).
    """
    steps = np.linalg.norm(np.diff(points, axis=1), axis=-1).mean(axis=0)
    own, other = _knots(steps), _knots(lengths)
    first = np.broadcast_to(IDENTITY, (len(points), 1, 4))
    every = np.concatenate([first, rotations], axis=1)
    turned = along(every, _middles(own), _middles(other)[1:])
    chords = np.diff(_spline(own, points, other), axis=1)[:, 1:]
    clear = np.linalg.norm(chords, axis=-1, keepdims=True) > 1e-6
    ahead = rotate(turned, Y)
    cut = multiply(swing(ahead, np.where(clear, unit(chords), ahead)), turned)
    cut[:, -1] = rotations[:, -1]
    return cut


def cut_row(rotations: Floats, count: int) -> Floats:
    """Return the rotations of another number of segments in a row; they are taken for even.

    Args:
        rotations: Of what carries the row and of the segments, shape (F, 1 + N, 4).
        count: How many segments the other row has.

    Returns:
        Rotations, shape (F, count, 4).
    """
    own = rotations.shape[1] - 1
    places = np.concatenate([[0.0], (np.arange(own) + 0.5) / own])
    return along(rotations, places, (np.arange(count) + 0.5) / count)


def cut_neck(rotations: Floats, count: int) -> Floats:
    """Return the rotations of another number of necks between chest and head.

    Args:
        rotations: Of chest, necks and head, shape (F, N + 2, 4).
        count: How many necks the other body has.

    Returns:
        Rotations, shape (F, count, 4).
    """
    places = np.linspace(0.0, 1.0, rotations.shape[1])
    return along(rotations, places, np.arange(1, count + 1) / (count + 1))


def _knots(lengths: Floats) -> Floats:
    return np.concatenate([[0.0], np.cumsum(shares(lengths))])


def _middles(knots: Floats) -> Floats:
    return np.asarray(0.5 * (knots[:-1] + knots[1:]))


def _spline(knots: Floats, points: Floats, wanted: Floats) -> Floats:
    """(P,), (F, P, 3), (M,) to (F, M, 3): on the cubic through points, straight at its ends."""
    kept = np.concatenate([[True], np.diff(knots) > 1e-6])
    knots, points = knots[kept], points[:, kept]
    gaps = np.diff(knots)
    slopes = np.diff(points, axis=1) / gaps[:, None]
    tangents = np.concatenate([slopes[:, :1], slopes[:, -1:]], axis=1)
    if len(gaps) > 1:
        share = (gaps[1:] / (gaps[1:] + gaps[:-1]))[:, None]
        inner = share * slopes[:, :-1] + (1.0 - share) * slopes[:, 1:]
        tangents = np.concatenate([slopes[:, :1], inner, slopes[:, -1:]], axis=1)
    span = np.clip(np.searchsorted(knots, wanted, side="right") - 1, 0, len(gaps) - 1)
    length = gaps[span][:, None]
    s = (wanted - knots[span])[:, None] / length
    return np.asarray(
        (1.0 + s * s * (2.0 * s - 3.0)) * points[:, span]
        + s * s * (3.0 - 2.0 * s) * points[:, span + 1]
        + s * (1.0 - s) ** 2 * length * tangents[:, span]
        + s * s * (s - 1.0) * length * tangents[:, span + 1]
    )
