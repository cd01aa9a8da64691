"""What lets a large kernel be compiled in parts, in a fraction of the time.

Numba compiles a function together with all that it calls, and then once more inside whatever calls
it. So what is large is handed to a kernel as an argument, and is compiled once; and what would be
hundreds of values in every call, a tuple of arrays, is passed on as one address.
"""

from collections.abc import Callable, Sequence
from functools import cache
from inspect import signature
from typing import Any, TypeAlias, TypeVar, cast, get_origin, get_type_hints

import numba
import numpy as np
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from usdmotion.kernels.compiling import OPTIONS, cached_beside

_Function = TypeVar("_Function", bound=Callable[..., Any])
_Value = TypeVar("_Value")
_NUMBERS = {bool: types.boolean, int: types.int64, float: types.float64, type(None): types.void}

Reference: TypeAlias = Sequence[_Value]
"""The address of a value inside a kernel; the value is its only item."""


@intrinsic  # type: ignore[untyped-decorator]
def reference(typing_context: Any, value: Any) -> Any:
    """Return a `Reference` to a value, good until the function that made it returns."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return cgutils.alloca_once_value(builder, arguments[0])

    return types.CPointer(value)(value), build


def apart(function: _Function, **examples: Any) -> _Function:
    """Compile a function by itself, to be handed to kernels as an argument.

    Args:
        function: Numbers are what its annotations say.
        examples: Of those of its arguments that are none: what else was compiled apart, what a
            reference refers to, and all of this for the fields of a named tuple.
    """
    # To ask Numba for the types takes as long as to solve ten frames, so that is done once.
    known = (function, *((name, _form(example)) for name, example in examples.items()))
    if known not in _APART:
        hints = get_type_hints(function)
        arguments = [
            _type(hints[name], examples[name]) if name in examples else _NUMBERS[hints[name]]
            for name in signature(function).parameters
        ]
        _APART[known] = _compiled(function, _NUMBERS[hints["return"]](*arguments))
    return cast(_Function, _APART[known])


_APART: dict[Any, Any] = {}
"""What was compiled, by the function and the forms of its examples."""


def _form(example: Any) -> Any:
    """Return what decides on the type that an example has for Numba."""
    if isinstance(example, tuple):
        return (type(example), *map(_form, example))
    if isinstance(example, np.ndarray):
        flags = example.flags
        order = flags.c_contiguous, flags.f_contiguous
        return example.dtype.char, example.ndim, *order, flags.writeable
    return example if callable(example) else type(example)


@cache
def _compiled(function: Callable[..., Any], signature: Any) -> Any:
    with cached_beside(function):
        return numba.cfunc(signature, cache=True, **OPTIONS)(function)


def _type(hint: Any, example: Any) -> Any:
    """Return the type of an argument."""
    if hasattr(hint, "_fields"):
        hints = get_type_hints(hint)
        each = [
            _type(hints[name], value) for name, value in zip(hint._fields, example, strict=True)
        ]
        return types.NamedTuple(each, hint)
    known = numba.typeof(example)
    return types.CPointer(known) if get_origin(hint) is Sequence else known
