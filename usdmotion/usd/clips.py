"""The samples of a SkelAnimation, at its own times or at others, as UsdSkel interpolates them."""

from collections.abc import Iterable

import numpy as np
from pxr import Usd

from usdmotion.arrays import Floats
from usdmotion.errors import SceneError
from usdmotion.usd.faults.skeletons import find_unreadable_animations
from usdmotion.usd.relations import ARRAYS, clip_joints
from usdmotion.usd.shot import Samples
from usdmotion.usd.stages import refuse

_WIDTHS = {"translations": 3, "rotations": 4, "scales": 3}
_TYPES = {"translations": np.float32, "rotations": np.float32, "scales": np.float16}
SLACK = 1e-6
"""Time codes closer than this are the same one: offsets of layers round them."""


def own_times(animation: Usd.Prim | None) -> Floats:
    """Return the time codes at which an animation has samples of its joints' transforms."""
    if not clip_joints(animation):
        return np.zeros(0)
    attributes = [animation.GetAttribute(name) for name in ARRAYS]  # type: ignore[union-attr]
    return merged([Usd.Attribute.GetUnionedTimeSamples(attributes)])


def merged(times: Iterable[Iterable[float]]) -> Floats:
    """Return times in order, each once."""
    ordered = np.unique(np.concatenate([np.asarray(each, dtype=np.float64) for each in times]))
    return ordered[np.diff(ordered, prepend=-np.inf) > SLACK]


def sample(animation: Usd.Prim | None, time_codes: Floats) -> Samples:
    """Return the arrays of an animation at some times; of no joint where it shows the rest pose.

    Raises:
        SceneError: An array has not one value for each joint.
    """
    count = len(clip_joints(animation))
    found = {name: _array(animation, name, time_codes, count) for name in ARRAYS}
    return Samples(time_codes, **found)


def resample(own: Samples, animation: Usd.Prim | None, time_codes: Floats) -> Samples:
    """Return the arrays of an animation at other times than its own, which are read already."""
    if np.array_equal(own.time_codes, time_codes):
        return own
    if not np.isin(time_codes, own.time_codes).all():
        return sample(animation, time_codes)
    rows = np.searchsorted(own.time_codes, time_codes)
    return Samples(time_codes, own.translations[rows], own.rotations[rows], own.scales[rows])


def _array(animation: Usd.Prim | None, name: str, time_codes: Floats, count: int) -> np.ndarray:
    shape = (len(time_codes), count, _WIDTHS[name])
    if animation is None or count == 0:
        return np.zeros(shape, _TYPES[name])
    query = Usd.AttributeQuery(animation.GetAttribute(name))
    moves = query.ValueMightBeTimeVarying()
    codes = time_codes.tolist() if moves else [Usd.TimeCode.EarliestTime()]
    values = [query.Get(code) for code in codes]
    if any(value is None or len(value) != count for value in values):
        refuse(list(find_unreadable_animations(animation)))
        raise SceneError(f"<{animation.GetPath()}> has no {name} at some time; author them")
    # All values have one length, so that their buffers put together are the array.
    found = np.frombuffer(b"".join(values), _TYPES[name]).reshape(len(codes), *shape[1:])
    return np.broadcast_to(found, shape)
