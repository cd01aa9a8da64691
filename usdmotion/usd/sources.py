"""What a source holds beside the transforms of its joints, kept for its result."""

from os.path import dirname, isabs, join, realpath

from pxr import Sdf, Usd, UsdUtils

from usdmotion.usd.layers import relative
from usdmotion.usd.relations import ARRAYS

SOURCE = Sdf.Path("/source")
"""The prim of a layer of extras."""
_WRITTEN = ("joints", *ARRAYS)
_RESULT = "usdmotion:result:"
_RESULT_API = "MotionResultAPI"
_ASSET = Sdf.ValueTypeNames.Asset
_ANCHORED = ("./", "../")
"""How paths begin that are relative to the layer they stand in."""


def read_extras(animation: Usd.Prim) -> str:
    """Return blend shapes and custom properties of an animation, composed, as text of a layer.

    Paths of assets are relative to the animation's own folder, wherever that is.
    """
    stage = Usd.Stage.CreateInMemory(".usda")
    stage.SetTimeCodesPerSecond(animation.GetStage().GetTimeCodesPerSecond())
    kept = stage.OverridePrim(SOURCE)
    absolute: set[str] = set()
    for each in animation.GetAuthoredProperties():
        name = each.GetName()
        if name not in _WRITTEN and not name.startswith(_RESULT):
            each.FlattenTo(kept)
            _keep_spline(each, kept)
            absolute |= _absolute_paths(each)
    applied = [name for name in animation.GetAppliedSchemas() if name != _RESULT_API]
    for name in applied:
        kept.AddAppliedSchema(name)
    layer, folder = stage.GetRootLayer(), folder_of(animation)
    # Flattening makes all paths absolute, and those of a machine are nobody else's business.
    UsdUtils.ModifyAssetPaths(
        layer,
        lambda path: (
            relative(path, folder) if folder and isabs(path) and path not in absolute else path
        ),
    )
    return str(layer.ExportToString())


def folder_of(animation: Usd.Prim) -> str:
    """Return the folder of the file in which an animation is written, "" where it is in none."""
    layer = animation.GetPrimStack()[0].layer
    file = Sdf.Layer.SplitIdentifier(layer.realPath)[0].split("[")[0]
    return str(dirname(realpath(file))) if file else ""


def extras_for(text: str, old_folder: str, new_folder: str) -> Sdf.Layer:
    """Return extras as a layer whose paths of assets lead to the same files from a new folder.

    Either is "" where there is none: nothing is relative to what is in no file.
    """
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(text)

    def led(path: str) -> str:
        if not path.startswith(_ANCHORED) or not old_folder:
            return path
        file = join(old_folder, path)
        return relative(file, new_folder) if new_folder else realpath(file)

    UsdUtils.ModifyAssetPaths(layer, led)
    return layer


def _absolute_paths(each: Usd.Property) -> set[str]:
    """Return the paths of assets that are authored as absolute ones, and stay so."""
    if not isinstance(each, Usd.Attribute) or each.GetTypeName().scalarType != _ASSET:
        return set()
    values = [each.Get(code) for code in (Usd.TimeCode.Default(), *each.GetTimeSamples())]
    paths = [
        path
        for value in values
        for path in ([value] if isinstance(value, Sdf.AssetPath) else value or ())
    ]
    return {str(path.path) for path in paths if isabs(path.path)}


def _keep_spline(each: Usd.Property, kept: Usd.Prim) -> None:
    # Before 26 flattening leaves splines behind.
    if isinstance(each, Usd.Attribute) and each.HasSpline():
        copy = kept.GetAttribute(each.GetName())
        if not copy.HasSpline():
            copy.SetSpline(each.GetSpline())
