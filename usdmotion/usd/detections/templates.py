"""A contact that is an example: the next detection learns from it."""

from pxr import Sdf, Usd

from usdmotion.errors import SceneError
from usdmotion.usd.layers import over, set_value
from usdmotion.usd.relations import is_a, nearest


def author_template(layer: Sdf.Layer, stage: Usd.Stage, path: str) -> None:
    """Make a contact a template.

    Args:
        layer: Where to write it.
        stage: The stage.
        path: Path of the contact, or of a prim below it.

    Raises:
        SceneError: It is no contact, or one that no detection learns from.
    """
    prim = stage.GetPrimAtPath(path)
    contact = nearest(prim, "UsdMotionContactConstraint")
    if contact is None:
        kind = f"a {prim.GetTypeName()}" if prim and prim.GetTypeName() else "no prim of a type"
        raise SceneError(f"<{path}> is {kind}, and no contact; name a MotionContactConstraint")
    if not is_a(contact.GetParent(), "UsdMotionDetection"):
        raise SceneError(
            f"<{contact.GetPath()}> is in no MotionDetection, so that nothing learns from it; move "
            "it into that of its joint or prim"
        )
    spec = over(layer, str(contact.GetPath()))
    set_value(spec, "usdmotion:template", Sdf.ValueTypeNames.Bool, True)
