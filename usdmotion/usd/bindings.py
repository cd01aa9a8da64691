"""Where the binding of an animation has to be written so that it counts."""

from pxr import Usd, UsdSkel

from usdmotion.errors import SceneError
from usdmotion.usd.drawn import without_guides
from usdmotion.usd.relations import is_a


def holder_of(skeleton: Usd.Prim) -> str:
    """Return the path of the prim on which an animation can be bound to a skeleton.

    It is the skeleton itself. Nothing can be written inside an instance, so there it is the
    instance, from which the skeleton inherits what it is bound to.

    Raises:
        SceneError: A binding on the instance would not reach this skeleton alone.
    """
    if not skeleton.IsInstanceProxy():
        return str(skeleton.GetPath())
    instance = skeleton
    while instance.IsInstanceProxy():
        if _binds(instance):
            raise SceneError(
                f"<{skeleton.GetPath()}> is inside an instance and <{instance.GetPath()}> binds "
                "its animation there, out of reach; bind it on the instance itself, or make the "
                "instance not instanceable"
            )
        instance = instance.GetParent()
    inside = without_guides(Usd.PrimRange(instance, Usd.TraverseInstanceProxies()))
    for other in inside:
        if is_a(other, "UsdSkelSkeleton") and other != skeleton and _inherits(other, instance):
            raise SceneError(
                f"<{skeleton.GetPath()}> is inside an instance with <{other.GetPath()}>, and an "
                "animation can only be bound to both; make the instance not instanceable"
            )
    return str(instance.GetPath())


def _binds(prim: Usd.Prim) -> bool:
    relationship = UsdSkel.BindingAPI(prim).GetAnimationSourceRel()
    return bool(relationship) and relationship.HasAuthoredTargets()


def _inherits(skeleton: Usd.Prim, instance: Usd.Prim) -> bool:
    step = skeleton
    while step != instance:
        if _binds(step):
            return False
        step = step.GetParent()
    return True
