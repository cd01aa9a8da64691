"""Calls of what was compiled, for who makes many: a microsecond each, and nothing allocated."""

import ctypes
from collections.abc import Callable
from functools import cache
from types import FunctionType
from typing import Any

import numba
import numpy as np
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic
from numba.np.arrayobj import make_array

from usdmotion.arrays import Bools
from usdmotion.kernels.compiling import OPTIONS, cached_beside


class Prepared:
    """A function that was compiled apart, with what its first argument refers to.

    A kernel looks at all its arrays anew whenever it is called, which takes it longer than many a
    character; this looks at them once. Other threads go on meanwhile.
    """

    def __init__(self, function: Any, value: Any) -> None:
        """Take a function, and what it works on, which may be written to in between.

        Args:
            function: Compiled by `apart`; a reference comes first, the rest are whole numbers.
            value: What the reference refers to.
        """
        self._value = value
        keep = _keeping(function.__wrapped__)
        self._memory = np.zeros(keep(value, np.zeros(0, dtype=np.bool_)), dtype=np.bool_)
        keep(value, self._memory)
        self._address = self._memory.ctypes.data
        numbers = len(function._sig.args) - 1
        kind = ctypes.CFUNCTYPE(None, ctypes.c_void_p, *numbers * [ctypes.c_int64])
        self._call = kind(function.address)

    def __call__(self, *numbers: int) -> None:
        """Call it."""
        self._call(self._address, *numbers)


@cache
def _keeping(owner: Callable[..., Any]) -> Any:
    """Return `_keep`, compiled for the types of the module of a function.

    What is on disk says for which types it is, and cannot be read where their module is not known.
    So each module has its own.
    """
    own = FunctionType(_keep.__code__, _keep.__globals__, _keep.__name__)
    own.__qualname__ = f"{_keep.__name__}_{owner.__module__.replace('.', '_')}"
    with cached_beside(owner):
        return numba.njit(cache=True, no_cfunc_wrapper=True, **OPTIONS)(own)


def _keep(value: Any, memory: Bools) -> int:
    """Write a value to memory, (S,), as kernels have it, if there is room; return its size."""
    size: int = _size(value)
    if memory.shape[0] >= size:
        _store(value, memory.ctypes.data)
    return size


@intrinsic  # type: ignore[untyped-decorator]
def _size(typing_context: Any, value: Any) -> Any:
    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        size = context.get_abi_sizeof(context.get_value_type(value))
        return context.get_constant(types.int64, size)

    return types.int64(value), build


@intrinsic  # type: ignore[untyped-decorator]
def _store(typing_context: Any, value: Any, address: Any) -> Any:
    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        kept = _unowned(context, builder, value, arguments[0])
        place = builder.inttoptr(arguments[1], context.get_value_type(value).as_pointer())
        builder.store(kept, place)
        return context.get_dummy_value()

    return types.void(value, address), build


def _unowned(context: Any, builder: Any, kind: Any, value: Any) -> Any:
    """Return a value whose arrays belong to nobody: whoever calls keeps them alive."""
    if isinstance(kind, types.Array):
        array = make_array(kind)(context, builder, value)
        array.meminfo = cgutils.get_null_value(array.meminfo.type)
        array.parent = cgutils.get_null_value(array.parent.type)
        return array._getvalue()
    if isinstance(kind, types.BaseTuple):
        for place, each in enumerate(kind.types):
            part = _unowned(context, builder, each, builder.extract_value(value, place))
            value = builder.insert_value(value, part, place)
    return value
