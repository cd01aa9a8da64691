"""When there is something to be seen on a stage."""

import numpy as np
from pxr import Usd

from usdmotion.usd.clips import own_times
from usdmotion.usd.relations import bound_animation, is_a
from usdmotion.usd.shot import Facts


def span_of(stage: Usd.Stage, facts: Facts) -> tuple[float, float]:
    """Return the first and the last time code of a stage.

    It is its own range and that of the motions of its skeletons together; where nobody says, that
    of all that changes, else time code 0.
    """
    found = [code for code in (facts.start, facts.end) if code is not None]
    for prim in Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies()):
        if is_a(prim, "UsdSkelSkeleton"):
            times = own_times(bound_animation(prim))
            found += [float(times[0]), float(times[-1])] if len(times) else []
    if not found:
        found = [
            code
            for prim in stage.Traverse()
            for attribute in prim.GetAuthoredAttributes()
            for code in attribute.GetTimeSamples()
        ]
    codes = np.array(found or [0.0])
    return float(codes.min()), float(codes.max())
