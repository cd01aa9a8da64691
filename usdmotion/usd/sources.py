"""What a source holds beside the transforms of its joints, kept for its result."""

from pxr import Sdf, Usd

from usdmotion.usd.relations import ARRAYS

SOURCE = Sdf.Path("/source")
"""The prim of a layer of extras."""
_WRITTEN = ("joints", *ARRAYS)
_RESULT = "usdmotion:result:"
_RESULT_API = "MotionResultAPI"


def read_extras(animation: Usd.Prim) -> str:
    """Return blend shapes and custom properties of an animation, composed, as text of a layer."""
    stage = Usd.Stage.CreateInMemory(".usda")
    stage.SetTimeCodesPerSecond(animation.GetStage().GetTimeCodesPerSecond())
    kept = stage.OverridePrim(SOURCE)
    for each in animation.GetAuthoredProperties():
        name = each.GetName()
        if name not in _WRITTEN and not name.startswith(_RESULT):
            each.FlattenTo(kept)
            _keep_spline(each, kept)
    applied = [name for name in animation.GetAppliedSchemas() if name != _RESULT_API]
    for name in applied:
        kept.AddAppliedSchema(name)
    return str(stage.GetRootLayer().ExportToString())


def _keep_spline(each: Usd.Property, kept: Usd.Prim) -> None:
    # Before 26 flattening leaves splines behind.
    if isinstance(each, Usd.Attribute) and each.HasSpline():
        copy = kept.GetAttribute(each.GetName())
        if not copy.HasSpline():
            copy.SetSpline(each.GetSpline())
