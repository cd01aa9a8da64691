"""Copies of a stage that ask for something else."""

from collections.abc import Iterable
from pathlib import Path

from pxr import Usd, UsdGeom

from usdmotion.errors import SceneError
from usdmotion.usd.stages import open_stage


def vary(
    shot: Path,
    output: Path,
    *,
    variant: str = "",
    without: Iterable[str] = (),
    hidden: Iterable[str] = (),
) -> None:
    """Write a copy of a stage in which less is asked, something else, or less is to be seen.

    Args:
        shot: The stage, in a file of its own.
        output: The copy.
        variant: Selected in each variant set that knows it; "" selects none.
        without: Names of the prims that are switched off.
        hidden: Names of the prims that are made invisible.

    Raises:
        FileError: The stage cannot be read.
        SceneError: It has no such variant, or no such prim.
    """
    stage = open_stage(shot)
    stage.GetRootLayer().Export(str(output))
    stage = open_stage(output)
    if variant and not _select(stage, variant):
        raise SceneError(f"{shot}: no prim has a variant {variant}")
    for prim in _named(stage, shot, without):
        prim.SetActive(False)
    for prim in _named(stage, shot, hidden):
        UsdGeom.Imageable(prim).MakeInvisible()
    stage.Save()


def _named(stage: Usd.Stage, shot: Path, names: Iterable[str]) -> list[Usd.Prim]:
    """Return the prims that have one of some names."""
    found = {name: [each for each in stage.Traverse() if each.GetName() == name] for name in names}
    for name, prims in found.items():
        if not prims:
            raise SceneError(f"{shot}: no prim is named {name}")
    return [prim for prims in found.values() for prim in prims]


def _select(stage: Usd.Stage, variant: str) -> bool:
    """Select a variant wherever it is known, and return whether it is anywhere."""
    sets = (
        (prim.GetVariantSets(), name)
        for prim in stage.Traverse()
        for name in prim.GetVariantSets().GetNames()
    )
    known = [each for each in sets if variant in each[0].GetVariantSet(each[1]).GetVariantNames()]
    for variants, name in known:
        variants.SetSelection(name, variant)
    return bool(known)
