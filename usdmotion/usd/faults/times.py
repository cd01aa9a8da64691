"""Key times that do not come in order, or not in the right number."""

from collections.abc import Iterator
from itertools import pairwise

from pxr import Usd

from usdmotion.usd.faults.fault import Fault, error
from usdmotion.usd.relations import floats, value


def find_wrong_key_times(prim: Usd.Prim) -> Iterator[Fault]:
    """Find easings of a constraint or goal that are not 0, 2 or 4 ascending times."""
    yield from _find(prim, "usdmotion:times", (0, 2, 4), "none, two, or t0 t1 t2 t3")


def find_wrong_ranges(prim: Usd.Prim) -> Iterator[Fault]:
    """Find ranges of an edit that are not a first and a last time."""
    yield from _find(prim, "usdmotion:range", (0, 2), "none, or a first and a last")


def find_wrong_trajectories(prim: Usd.Prim) -> Iterator[Fault]:
    """Find keys and releases of a trajectory that do not follow each other within its times."""
    times = floats(value(prim, "usdmotion:times"))
    keys = floats(value(prim, "usdmotion:keys"))
    releases = floats(value(prim, "usdmotion:releases"))
    if not times:
        yield error(
            prim,
            "KeyTimesCount",
            "has no usdmotion:times; give it the times at which it leaves the input trajectory and "
            "rejoins it",
        )
    elif keys and not (min(times) <= min(keys) and max(keys) <= max(times)):
        yield error(
            prim,
            "KeyOutside",
            f"has keys from {min(keys):g} to {max(keys):g}, outside usdmotion:times, "
            f"{min(times):g} to {max(times):g}; widen the times or move the keys",
        )
    if any(after <= before for before, after in pairwise(keys)):
        yield error(
            prim,
            "KeyTimesOrder",
            f"has usdmotion:keys {_list(keys)}; each must be later than the last",
        )
    if len(releases) == len(keys):
        yield from _find_wrong_releases(prim, keys, releases)


def _find_wrong_releases(
    prim: Usd.Prim, keys: list[float], releases: list[float]
) -> Iterator[Fault]:
    ends = [*keys, float("inf")][1:]
    for key, release, end in zip(keys, releases, ends, strict=True):
        if not key <= release <= end:
            what = f"the key {key:g} and the next one" if end < float("inf") else f"the key {key:g}"
            yield error(
                prim,
                "KeyTimesOrder",
                f"releases its point of {key:g} at {release:g}; a release is not before its key "
                f"nor after the next, so move {what} or the release",
            )


def _find(prim: Usd.Prim, name: str, counts: tuple[int, ...], meant: str) -> Iterator[Fault]:
    times = floats(value(prim, name))
    if len(times) not in counts:
        yield error(
            prim, "KeyTimesCount", f"has {len(times)} times in {name}, {_list(times)}; give {meant}"
        )
    elif times != sorted(times):
        yield error(
            prim,
            "KeyTimesOrder",
            f"has the times {_list(times)} in {name}; sort them, the earliest first",
        )


def _list(times: list[float]) -> str:
    return "[" + ", ".join(f"{time:g}" for time in times) + "]"
