"""The writer: results become one layer to be put over the shot."""

import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TypeAlias

from pxr import Sdf, Usd

from usdmotion.errors import SceneError
from usdmotion.usd.layers import (
    apply_schema,
    new_layer,
    over,
    relate,
    relative,
    require_writable,
    save,
    set_value,
    write_animation,
)
from usdmotion.usd.provenance import KEY, input_hash, own_version, provenance
from usdmotion.usd.results import result_of
from usdmotion.usd.shot import Facts, Result, Shot, Take
from usdmotion.usd.shown_results import author_binding
from usdmotion.usd.sources import SOURCE, extras_for

Draw: TypeAlias = Callable[[Usd.Stage], object]
"""Draws what there is to see of a stage, in its edit target."""


def write(
    shot: Shot,
    results: Sequence[Result],
    output: Path,
    *,
    notes: Sequence[str] = (),
    draw: Draw | None = None,
) -> None:
    """Write the layer that puts results over the shot they were made from.

    Args:
        shot: What was read.
        results: One for each edit that was solved.
        output: The layer to write.
        notes: What whoever made them had to say; a report of the layer says it again.
        draw: Draws what there is to see of it into the edit target of a stage; None draws nothing.

    Raises:
        FileError: It cannot be written there, or is a layer that was read.
        SceneError: A result does not fit its edit.
    """
    require_writable(output, shot.layers)
    layer = new_layer(shot.facts)
    layer.customLayerData = {KEY: put(layer, shot, results, output.parent, notes)}
    if draw is not None:
        root = composed(shot.facts, [layer.identifier, os.path.realpath(shot.path)])
        stage = Usd.Stage.Open(root)
        stage.SetEditTarget(layer)
        draw(stage)
    save(layer, output)


def put(
    layer: Sdf.Layer,
    shot: Shot,
    results: Sequence[Result],
    folder: Path | None,
    notes: Sequence[str],
) -> dict[str, object]:
    """Put results and their bindings into a layer, over what is there.

    Args:
        layer: Where.
        shot: What was read.
        results: One for each edit that was solved.
        folder: Where the layer will lie; None where it lies in none.
        notes: What whoever made them had to say.

    Returns:
        What the layer is to say of itself.

    Raises:
        SceneError: A result does not fit its edit.
    """
    takes = {take.edit: take for take in shot.takes}
    for result in results:
        if result.edit not in takes:
            raise SceneError(
                f"there is a result of <{result.edit}>, which was not read to be solved"
            )
    hashes = {result.edit: input_hash(shot, takes[result.edit]) for result in results}
    with Sdf.ChangeBlock():
        for result in results:
            take = takes[result.edit]
            extras = extras_for(take.extras, take.folder, str(folder or ""))
            _write_result(layer, shot, take, result, extras, hashes[result.edit])
            author_binding(layer, take.holder, take.bound)
    return provenance(shot, results, hashes, notes)


def compose(shot: Shot, edit_layer: Path, output: Path) -> None:
    """Write a tiny layer that shows a result over its shot.

    Args:
        shot: What was read.
        edit_layer: The layer that `write` wrote.
        output: The layer to write.

    Raises:
        FileError: It cannot be written there, or is a layer that was read.
    """
    require_composable(shot, edit_layer, output)
    paths = [relative(path, output.parent) for path in (edit_layer, shot.path)]
    layer = composed(shot.facts, paths)
    name_fallbacks(layer)
    save(layer, output)


def require_composable(shot: Shot, edit_layer: Path, output: Path) -> None:
    """Raise if a stage that shows a result over its shot cannot be written to a place.

    Raises:
        FileError: It cannot be written there, or is a layer that was read, or the result.
    """
    require_writable(output, shot.layers | {os.path.realpath(edit_layer)})


def name_fallbacks(layer: Sdf.Layer) -> None:
    """Let a stage whose root a layer is show something where the schema is not known."""
    known = Usd.Stage.CreateInMemory()
    known.WriteFallbackPrimTypes()
    fallbacks = known.GetRootLayer().pseudoRoot.GetInfo("fallbackPrimTypes")
    layer.pseudoRoot.SetInfo("fallbackPrimTypes", fallbacks)


def composed(facts: Facts, paths: Sequence[str]) -> Sdf.Layer:
    """Return a layer that is read like a stage with those facts and shows some layers."""
    layer = new_layer(facts)
    if facts.default_prim:
        layer.defaultPrim = facts.default_prim
    layer.subLayerPaths[:] = list(paths)
    return layer


def _write_result(
    layer: Sdf.Layer, shot: Shot, take: Take, result: Result, extras: Sdf.Layer, digest: str
) -> None:
    scene = shot.scene(take.edit)
    edit = next(edit for edit in scene.edits if edit.path == take.edit)
    character = scene.character(edit.skeleton)
    if result.motion.rotations.shape != character.motion.rotations.shape:
        raise SceneError(
            f"the result of <{take.edit}> has {result.motion.rotations.shape[:2]} frames and "
            f"joints instead of {character.motion.rotations.shape[:2]}"
        )
    prim = over(layer, take.result)
    Sdf.CopySpec(extras, SOURCE, layer, prim.path)
    joints, samples = result_of(take, character.motion, result.motion, character.skeleton.joints)
    write_animation(prim, joints, samples)
    apply_schema(prim, "MotionResultAPI")
    relate(prim, "usdmotion:result:edit", take.edit)
    relate(prim, "usdmotion:result:source", take.source)
    set_value(prim, "usdmotion:result:solver", Sdf.ValueTypeNames.Token, result.solver)
    set_value(prim, "usdmotion:result:version", Sdf.ValueTypeNames.String, own_version())
    set_value(prim, "usdmotion:result:inputHash", Sdf.ValueTypeNames.String, digest)
