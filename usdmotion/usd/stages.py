"""Opening a stage, and what it says of itself."""

import os
from pathlib import Path
from typing import TypeAlias

from pxr import Sdf, Tf, Usd, UsdGeom

from usdmotion.errors import FileError, SceneError
from usdmotion.usd.faults import Fault
from usdmotion.usd.faults.composition import find_composition_errors
from usdmotion.usd.shot import Facts

Stage: TypeAlias = Usd.Stage
"""A stage that is open, for those who do not know USD."""


def open_stage(path: Path) -> Usd.Stage:
    """Return the stage of a file.

    Raises:
        FileError: USD cannot read it.
    """
    if not path.is_file():
        raise FileError(f"{path}: there is no such file")
    try:
        return Usd.Stage.Open(str(path))
    except Tf.ErrorException as error:
        raise FileError(f"{path}: USD cannot read it: {reason(error)}") from error


def name_of(stage: Stage) -> Path:
    """Return how an open stage is called in a sentence."""
    layer = stage.GetRootLayer()
    return Path(layer.GetDisplayName() or layer.identifier)


def reason(error: Tf.ErrorException) -> str:
    """Return what USD has to say about a failure, in one line."""
    said = [getattr(each, "commentary", str(each)) for each in error.args]
    return " ".join(said[0].split()) if said else "it does not say why"


def read_facts(stage: Usd.Stage) -> Facts:
    """Return the units, axis and rates of a stage."""
    return Facts(
        meters_per_unit=UsdGeom.GetStageMetersPerUnit(stage),
        up_axis=str(UsdGeom.GetStageUpAxis(stage)),  # type: ignore[arg-type]
        time_codes_per_second=stage.GetTimeCodesPerSecond(),
        frames_per_second=stage.GetFramesPerSecond(),
        start=stage.GetStartTimeCode() if stage.HasAuthoredTimeCodeRange() else None,
        end=stage.GetEndTimeCode() if stage.HasAuthoredTimeCodeRange() else None,
        default_prim=stage.GetRootLayer().defaultPrim,
    )


def used_files(stage: Usd.Stage) -> frozenset[str]:
    """Return the real paths of the files that a stage is made of."""
    layers = [layer for layer in stage.GetUsedLayers() if layer.realPath]
    return frozenset(
        os.path.realpath(Sdf.Layer.SplitIdentifier(layer.realPath)[0].split("[")[0])
        for layer in layers
    )


def require_composed(stage: Usd.Stage) -> None:
    """Raise if something of a stage could not be composed.

    Raises:
        SceneError: The first of what could not be.
    """
    refuse(list(find_composition_errors(stage)))


def refuse(faults: list[Fault]) -> None:
    """Raise the first of the errors among some faults, and say how many more there are.

    Raises:
        SceneError: There are any.
    """
    errors = [fault for fault in faults if fault.severity == "error"]
    if errors:
        more = len(errors) - 1
        rest = f" (and {more} more, which `usdmotion inspect` lists)" if more else ""
        raise SceneError(errors[0].sentence + rest)
