"""The whole plugin API.

A plugin is a module with some of these functions, each marked with `hookimpl`, declared by one
entry point in the group `usdmotion`.
"""

from collections.abc import Iterable
from pathlib import Path

import pluggy

from usdmotion.constraints import Constraint
from usdmotion.detecting import Detector
from usdmotion.recording import Reader
from usdmotion.solving import Solver

hookspec = pluggy.HookspecMarker("usdmotion")
hookimpl = pluggy.HookimplMarker("usdmotion")


@hookspec
def register_solvers() -> Iterable[type[Solver]]:  # type: ignore[empty-body]
    """Return classes whose instances solve whole clips."""


@hookspec
def register_detectors() -> Iterable[type[Detector]]:  # type: ignore[empty-body]
    """Return classes whose instances find what a motion already obeys."""


@hookspec
def register_readers() -> Iterable[type[Reader]]:  # type: ignore[empty-body]
    """Return classes whose instances read files of motion."""


@hookspec
def register_constraints() -> Iterable[type[Constraint]]:  # type: ignore[empty-body]
    """Return constraint kinds; their schema classes come through `register_schemas`."""


@hookspec
def register_schemas() -> Iterable[Path]:  # type: ignore[empty-body]
    """Return folders that hold a plugInfo.json."""
