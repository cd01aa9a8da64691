"""Reads BVH files of any maker into recordings."""

from usdmotion import Reader, hookimpl
from usdmotion_bvh.reader import BvhReader


@hookimpl
def register_readers() -> list[type[Reader]]:
    """Return the readers of this package."""
    return [BvhReader]
