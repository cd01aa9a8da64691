"""The arrays of a result: the source's own wherever nothing has changed."""

import numpy as np

from usdmotion.arrays import Floats, Ints
from usdmotion.kernels import conjugate, multiply
from usdmotion.motion import Motion
from usdmotion.usd.clips import SLACK
from usdmotion.usd.shot import Samples, Singles, Take


def result_of(
    take: Take, before: Motion, after: Motion, tokens: tuple[str, ...]
) -> tuple[tuple[str, ...], Samples]:
    """Return the joints and the samples of a result.

    Args:
        take: How the source is stored.
        before: The motion that was read.
        after: What was made of it.
        tokens: Joints of the skeleton.
    """
    moved = (after.translations != before.translations).any(axis=2)
    turned = (after.rotations != before.rotations).any(axis=2)
    changed = (moved | turned).any(axis=0)
    added = np.flatnonzero((take.columns < 0) & (changed | (not take.joints)))
    columns = np.array(take.columns)
    columns[added] = len(take.joints) + np.arange(len(added))
    solved = _with_rest(take, take.solved, added)
    translations = np.array(solved.translations)
    rotations = np.array(solved.rotations)
    for joint in np.flatnonzero(changed):
        slot, at, turns = columns[joint], moved[:, joint], turned[:, joint]
        units = np.broadcast_to(take.units, moved.shape)[:, joint]
        translations[at, slot] = after.translations[at, joint] / units[at, None]
        rotations[turns, slot] = _signed(solved.rotations[:, slot], after.rotations[:, joint])[
            turns
        ]
    result = Samples(solved.time_codes, translations, rotations, solved.scales)
    joints = (*take.joints, *(tokens[joint] for joint in added))
    return joints, _with_outside(_with_rest(take, take.own, added), result)


def _with_rest(take: Take, samples: Samples, added: Ints) -> Samples:
    """Return samples with some more joints, at rest."""
    if len(added) == 0 or take.rest is None:
        return samples

    def widened(values: np.ndarray, rest: Floats) -> np.ndarray:
        shape = (len(values), len(added), values.shape[2])
        return np.concatenate(
            [values, np.broadcast_to(rest[added], shape)], axis=1, dtype=values.dtype
        )

    return Samples(
        samples.time_codes,
        widened(samples.translations, take.rest.translations),
        widened(samples.rotations, take.rest.rotations),
        widened(samples.scales, take.rest.scales),
    )


def _signed(source: Singles, rotations: Floats) -> Floats:
    """Return rotations with the signs that make what they add to the source continuous."""
    added = multiply(rotations, conjugate(source.astype(np.float64)))
    along = np.einsum("fi,fi->f", added[1:], added[:-1])
    flips = np.concatenate([added[:1, 3], along]) < 0.0
    signs = np.where(np.cumsum(flips) % 2, -1.0, 1.0)
    return rotations * signs[:, None]


def _with_outside(own: Samples, solved: Samples) -> Samples:
    """Return solved samples with those that the source has before and after them."""
    first, last = solved.time_codes[0], solved.time_codes[-1]
    before = own.time_codes < first - SLACK
    after = own.time_codes > last + SLACK
    if not (before.any() or after.any()):
        return solved

    def joined(name: str) -> np.ndarray:
        values = getattr(own, name)
        return np.concatenate([values[before], getattr(solved, name), values[after]])

    names = ("time_codes", "translations", "rotations", "scales")
    return Samples(*(joined(name) for name in names))
