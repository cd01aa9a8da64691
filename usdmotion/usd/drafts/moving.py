"""What one layer of an open stage says goes to another of its layers."""

from pxr import Sdf, Usd

from usdmotion.usd.drafts.merging import merge, whole_or_not
from usdmotion.usd.drafts.retiming import retime
from usdmotion.usd.drafts.targets import offset_of
from usdmotion.usd.provenance import KEY, joined, recorded


def move_prims(stage: Usd.Stage, source: Sdf.Layer, layer: Sdf.Layer) -> None:
    """Move what a layer of a stage says of prims to a weaker one, over what is said there.

    Args:
        stage: The stage.
        source: The layer that is left without prims.
        layer: The layer that says it from now on, in its own time codes.
    """
    moved = Sdf.Layer.CreateAnonymous()
    moved.TransferContent(source)
    retime(moved, offset_of(stage, layer).GetInverse() * offset_of(stage, source))
    with whole_or_not(source), whole_or_not(layer), Sdf.ChangeBlock():
        merge(moved, layer, ())
        for prim in list(source.rootPrims):
            del source.rootPrims[prim.name]
        if said := recorded(source):
            layer.customLayerData |= {KEY: joined(recorded(layer), said)}
            source.customLayerData = {
                key: value for key, value in source.customLayerData.items() if key != KEY
            }
