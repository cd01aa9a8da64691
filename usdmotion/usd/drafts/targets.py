"""Where on an open stage something can be written, and what is stronger there."""

from dataclasses import dataclass

from pxr import Sdf, Usd

from usdmotion.errors import SceneError


@dataclass(frozen=True, eq=False)
class Target:
    """A layer of a stage that is written to."""

    layer: Sdf.Layer
    offset: Sdf.LayerOffset
    """From its time codes to those of the stage."""
    stronger: tuple[Sdf.Layer, ...]
    """The layers whose opinions win over those of this one, the strongest first."""
    stage: Usd.Stage


def target_of(stage: Usd.Stage) -> Target:
    """Return where the edits of a stage go.

    Times are those of the layer as the stage has it, whether the edit target says so or not.

    Raises:
        SceneError: It is none of the stage's own layers, or one that cannot be written to.
    """
    chosen = stage.GetEditTarget()
    layer = chosen.GetLayer()
    if not chosen.IsValid() or not layer:
        raise SceneError("there is no edit target; choose one of the stage's layers")
    name = called(layer, stage)
    if stage.IsLayerMuted(layer.identifier):
        raise SceneError(f"the edit target {name} is muted; unmute it, or choose another layer")
    layers = stage.GetLayerStack()
    if layer not in layers or not chosen.GetMapFunction().isIdentityPathMapping:
        raise SceneError(
            f"the edit target is inside a variant or behind a reference to {name}; choose one of "
            "the stage's own layers, such as its root or its session layer"
        )
    if not layer.permissionToEdit:
        raise SceneError(f"the edit target {name} must not be edited; choose another layer")
    return Target(layer, offset_of(stage, layer), tuple(layers[: layers.index(layer)]), stage)


def called(layer: Sdf.Layer, stage: Usd.Stage) -> str:
    """Return how people call a layer of a stage."""
    if layer == stage.GetSessionLayer():
        return "the session layer"
    return str(layer.GetDisplayName() or layer.identifier)


def offset_of(stage: Usd.Stage, layer: Sdf.Layer) -> Sdf.LayerOffset:
    """Return what takes time codes of a stage's own layer to those of the stage."""
    return stage.GetEditTargetForLocalLayer(layer).GetMapFunction().timeOffset
