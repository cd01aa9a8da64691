"""Where results go: the session layer, the edit target that is set, or a file of their own."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from pxr import Sdf, Tf, Usd

from usdmotion.errors import FileError
from usdmotion.usd.drafts import called, move_prims
from usdmotion.usd.layers import new_layer, require_writable, save, without_false_alarms
from usdmotion.usd.stages import read_facts, reason
from usdmotion.usdview.running import Desk

TO_SESSION, TO_TARGET, TO_LAYER = "to_session", "to_target", "to_layer"


@contextmanager
def destination(stage: Usd.Stage, desk: Desk) -> Iterator[str]:
    """Let the edits inside go where results go, and yield how that place is called.

    A file is on disk afterwards, and over the stage as long as it is open. One that was chosen for
    another stage is not for this one, whose results go to the session layer again.

    Raises:
        FileError: It cannot be read or written.
    """
    if desk.destination == TO_TARGET:
        yield called(stage.GetEditTarget().GetLayer(), stage)
        return
    if desk.shot != stage.GetRootLayer().identifier:
        desk.destination = TO_SESSION
    own = desk.destination == TO_LAYER
    layer = put_over(stage, desk.layer) if own else stage.GetSessionLayer()
    with Usd.EditContext(stage, stage.GetEditTargetForLocalLayer(layer)):
        yield layer.realPath if own else "the session layer"
    if own:
        _save(layer)


def choose(stage: Usd.Stage, desk: Desk, path: str) -> Sdf.Layer:
    """Let results of a stage go to the layer of a file from now on, and return that.

    Raises:
        FileError: As `put_over` says.
    """
    layer = put_over(stage, path)
    desk.destination, desk.layer, desk.shot = TO_LAYER, path, stage.GetRootLayer().identifier
    return layer


def take_along(stage: Usd.Stage, layer: Sdf.Layer) -> None:
    """Move what the session layer says of prims to a layer that results go to, and save that.

    Raises:
        FileError: It cannot be written.
    """
    move_prims(stage, stage.GetSessionLayer(), layer)
    _save(layer)


def put_over(stage: Usd.Stage, path: str) -> Sdf.Layer:
    """Return the layer of a file, made where it is missing, once it is over a stage.

    It is a sublayer of the session layer, so that no other file is changed.

    Raises:
        FileError: It cannot be read or made, or the stage is made of it in another way.
    """
    layer = _opened(stage, path)
    if layer == stage.GetRootLayer():
        raise FileError(
            f"{path}: this is the stage itself; choose another file, or make it the edit target "
            "and let results go there"
        )
    if layer not in stage.GetLayerStack():
        if layer in stage.GetUsedLayers():
            raise FileError(f"{path}: the stage refers to it; choose another file")
        stage.GetSessionLayer().subLayerPaths.insert(0, layer.identifier)
    return layer


def _opened(stage: Usd.Stage, path: str) -> Sdf.Layer:
    file = Path(path)
    require_writable(file, frozenset())
    if not file.is_file():
        save(new_layer(read_facts(stage)), file)
    try:
        layer = Sdf.Layer.FindOrOpen(os.path.realpath(file))
    except Tf.ErrorException as error:
        raise FileError(f"{path}: USD cannot read it: {reason(error)}") from error
    if not (layer.permissionToEdit and layer.permissionToSave):
        raise FileError(f"{path}: it must not be written to; choose another file")
    return layer


def _save(layer: Sdf.Layer) -> None:
    try:
        with without_false_alarms():
            saved = layer.Save()
    except Tf.ErrorException as error:
        raise FileError(f"{layer.realPath}: cannot be written: {reason(error)}") from error
    if not saved:
        raise FileError(f"{layer.realPath}: USD cannot write it")
