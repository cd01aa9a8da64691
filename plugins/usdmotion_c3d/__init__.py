"""Reads C3D files: markers, force plates, events."""

from collections.abc import Iterable

from usdmotion import Reader, hookimpl


@hookimpl
def register_readers() -> Iterable[type[Reader]]:
    """Return the reader."""
    return []
