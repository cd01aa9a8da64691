"""Reads C3D files: markers, force plates, events."""

from collections.abc import Iterable

from usdmotion import Reader, hookimpl
from usdmotion_c3d.reader import C3dReader

__all__ = ["C3dReader"]


@hookimpl
def register_readers() -> Iterable[type[Reader]]:
    """Return the reader."""
    return [C3dReader]
