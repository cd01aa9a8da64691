"""Grounds that a program tells, over what the edits of a stage say."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeAlias

from usdmotion.arrays import Floats
from usdmotion.ground import FunctionGround, Ground
from usdmotion.scene import Scene

Height: TypeAlias = Callable[[Floats, Floats], Floats]
"""Returns heights of places at times, as `FunctionGround` has it."""
Told: TypeAlias = Ground | Height
"""A ground that is no prim."""
Asked: TypeAlias = str | Sequence[str] | Told | None
"""A ground as whoever solves asks for it: paths of prims, or told; None takes what edits say."""
PROGRAM = "told by a program"
"""What stands for a ground that is no prim, where a layer says what it was made on."""


def told_by(asked: Asked) -> Told | None:
    """Return the ground that is told, None where it is prims or left to the edits."""
    return None if asked is None or isinstance(asked, str | Sequence) else asked


def prims_of(asked: Asked) -> Sequence[str] | None:
    """Return the paths of prims that are asked for, none where a ground is told instead."""
    if isinstance(asked, str):
        return (asked,)
    return asked if asked is None or isinstance(asked, Sequence) else ()


def standing_on(scene: Scene, told: Told | None) -> Scene:
    """Return a scene whose edits stand on a ground that is told, if one is."""
    if told is None:
        return scene
    ground = told if isinstance(told, Ground) else FunctionGround(told, scene.up)
    return replace(scene, edits=tuple(replace(edit, ground=ground) for edit in scene.edits))
