"""Stages that begin empty, and are on disk once they are whole."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Literal

from pxr import Usd

from usdmotion.usd.layers import new_layer, require_writable, save
from usdmotion.usd.shot import Facts

CENTIMETRE = 0.01


@contextmanager
def new_stage(
    output: Path,
    *,
    frame_rate: float,
    first: float,
    last: float,
    up: Literal["Y", "Z"] = "Y",
    root: str,
) -> Iterator[Usd.Stage]:
    """Give an empty stage in centimetres, and write it when everything is on it.

    Args:
        output: The layer to write.
        frame_rate: Time codes and frames per second.
        first: Time code at which it starts.
        last: Time code at which it ends.
        up: The axis that points up, "Y" or "Z".
        root: Name of the default prim, which is made a component.

    Raises:
        FileError: It cannot be written there.
    """
    require_writable(output, frozenset())
    facts = Facts(
        meters_per_unit=CENTIMETRE,
        up_axis=up,
        time_codes_per_second=frame_rate,
        frames_per_second=frame_rate,
        start=first,
        end=last,
        default_prim=root,
    )
    stage = Usd.Stage.Open(new_layer(facts))
    yield stage
    prim = stage.GetPrimAtPath(f"/{root}")
    stage.SetDefaultPrim(prim)
    Usd.ModelAPI(prim).SetKind("component")
    stage.WriteFallbackPrimTypes()
    save(stage.GetRootLayer(), output)
