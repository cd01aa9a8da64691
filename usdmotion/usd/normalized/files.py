"""Files of normalized motions."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Usd, Vt

from usdmotion.constraints import Constraint
from usdmotion.errors import SceneError
from usdmotion.travelling import Left, Luggage
from usdmotion.usd.clips import SLACK
from usdmotion.usd.concerns import concerns
from usdmotion.usd.layers import new_layer, require_writable, save
from usdmotion.usd.normalized.motions import author_normalized, read_normalized
from usdmotion.usd.normalized.settings import author_settings, read_settings
from usdmotion.usd.normalized.travellers import author_travellers, read_travellers
from usdmotion.usd.provenance import own_version
from usdmotion.usd.relations import is_a
from usdmotion.usd.shot import Facts
from usdmotion.usd.stages import read_facts, refuse

_MEMORY = "usdmotion"
"""Where a prim keeps what nobody but ourselves needs to know."""


def write_normalized(
    luggage: Sequence[Luggage], output: Path, *, rate: float, notes: Sequence[str] = ()
) -> None:
    """Write a stage of normalized motions, one prim each at the top.

    Args:
        luggage: The motions, with what travels with them.
        output: The layer to write.
        rate: Time codes and frames per second.
        notes: What whoever made them had to say.

    Raises:
        FileError: It cannot be written there.
    """
    require_writable(output, frozenset())
    ends = [each.codes(rate)[[0, -1]] for each in luggage]
    facts = Facts(
        meters_per_unit=1.0,
        up_axis="Y",
        time_codes_per_second=rate,
        frames_per_second=rate,
        start=float(np.min(ends)),
        end=float(np.max(ends)),
        default_prim=luggage[0].name,
    )
    stage = Usd.Stage.Open(new_layer(facts))
    for each in luggage:
        _author(stage, each, facts)
    stage.SetDefaultPrim(stage.GetPrimAtPath(luggage[0].prim))
    stage.WriteFallbackPrimTypes()
    told: dict[str, Any] = {"version": own_version()}
    told |= {"notes": Vt.StringArray(list(notes))} if notes else {}
    stage.GetRootLayer().customLayerData = {_MEMORY: told}
    save(stage.GetRootLayer(), output)


def normalized_prims(stage: Usd.Stage) -> list[Usd.Prim]:
    """Return the MotionNormalized prims of a stage."""
    prims = Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies())
    return [prim for prim in prims if is_a(prim, "UsdMotionNormalized")]


def read_luggage(
    stage: Usd.Stage,
    named: str,
    frames: tuple[float, float] | None,
    kinds: Sequence[type[Constraint]],
) -> Luggage:
    """Return a normalized motion of a stage, with what travels with it.

    Args:
        stage: The stage.
        named: Path of the MotionNormalized; "" is the only one.
        frames: First and last time code; None is all of it.
        kinds: What prims can be read as.

    Raises:
        SceneError: There are several, or not the named one, or it is not whole.
    """
    prim, facts = _prim(stage, named), read_facts(stage)
    refuse(concerns(prim))
    motion, codes = read_normalized(prim, facts)
    if frames is not None:
        codes = codes[(codes >= frames[0] - SLACK) & (codes <= frames[1] + SLACK)]
        if not len(codes):
            raise SceneError(
                f"<{prim.GetPath()}> has no sample from {frames[0]:g} to {frames[1]:g}; name "
                "others with --frames"
            )
        motion, codes = read_normalized(prim, facts, codes)
    travellers, unknown = read_travellers(prim, kinds, codes, facts)
    memory = prim.GetCustomDataByKey(_MEMORY) or {}
    left = (Left(name, f"nothing installed here knows a {kind}") for name, kind in unknown)
    return Luggage(
        name=prim.GetName(),
        motion=motion,
        first=float(codes[0]) / facts.time_codes_per_second,
        travellers=travellers,
        left=tuple(left),
        settings=read_settings(prim, codes, facts),
        found=tuple(memory.get("found", ())),
        body=str(memory.get("body", "")),
        source=str(prim.GetPath()),
    )


def _author(stage: Usd.Stage, luggage: Luggage, facts: Facts) -> None:
    path, codes = luggage.prim, luggage.codes(facts.time_codes_per_second)
    author_normalized(stage, path, luggage.motion, time_codes=codes, source=luggage.source)
    prim = stage.GetPrimAtPath(path)
    author_settings(prim, luggage.settings, codes, facts)
    author_travellers(stage, path, luggage.travellers, codes)
    memory = {"body": luggage.body} | (
        {"found": Vt.StringArray(list(luggage.found))} if luggage.found else {}
    )
    prim.SetCustomDataByKey(_MEMORY, memory)


def _prim(stage: Usd.Stage, named: str) -> Usd.Prim:
    prims = {str(prim.GetPath()): prim for prim in normalized_prims(stage)}
    known = ", ".join(prims)
    if named and named not in prims:
        raise SceneError(f"<{named}> is no MotionNormalized; there are: {known}")
    if not named and len(prims) > 1:
        raise SceneError(f"there are several normalized motions, {known}; name one with --source")
    return prims[named] if named else next(iter(prims.values()))
