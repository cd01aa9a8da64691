"""The decorators of every kernel."""

import hashlib
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any, TypeVar, cast

import numba

_Function = TypeVar("_Function", bound=Callable[..., Any])
OPTIONS = {"nogil": True, "error_model": "numpy"}
"""What every function is compiled with."""
# Without the wrappers that make them callable from Python they compile in half the time.
_INNER = {**OPTIONS, "_nrt": False, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}


def kernel(function: _Function) -> _Function:
    """Compile a function that is called from Python, and keep the result on disk."""
    with cached_beside(function):
        return cast(_Function, numba.njit(cache=True, no_cfunc_wrapper=True, **OPTIONS)(function))


def shared(function: _Function) -> _Function:
    """Compile a function that only kernels call.

    Numba compiles it once more for a literal number (`f(x, 0)`), so pass variables.
    """
    return cast(_Function, numba.njit(**_INNER)(function))


def summing(function: _Function) -> _Function:
    """Like `shared`, and sums may be taken in several lanes: the order is the compiler's."""
    return cast(_Function, numba.njit(fastmath={"reassoc", "contract"}, **_INNER)(function))


@contextmanager
def cached_beside(function: Callable[..., Any]) -> Iterator[None]:
    """Have Numba keep what it compiles in the folder of a function's sources.

    Numba does not notice a change in a function of another file, so the folder of the compiled
    code is named by a hash of every kernel source that the function may call: those of this
    package and those beside the function itself.
    """
    folders = (Path(__file__).parent, Path(function.__code__.co_filename).parent)
    before = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = str(cache_folder(*folders))
    try:
        yield
    finally:
        numba.config.CACHE_DIR = before


def cache_folder(*folders: Path) -> Path:
    """Return where the code compiled from some folders is kept; NUMBA_CACHE_DIR wins."""
    if os.environ.get("NUMBA_CACHE_DIR"):
        return Path(os.environ["NUMBA_CACHE_DIR"])
    return _user_cache() / "usdmotion" / "kernels" / _source_hash(folders)


def _user_cache() -> Path:
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA", Path.home() / "AppData" / "Local"))
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches"
    return Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache"))


@cache
def _source_hash(folders: tuple[Path, ...]) -> str:
    digest = hashlib.sha256()
    for folder in sorted(set(folders)):
        for source in sorted(folder.glob("*.py")):
            digest.update(source.read_bytes())
    return digest.hexdigest()[:16]
