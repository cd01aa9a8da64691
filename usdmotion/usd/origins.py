"""From which motion an edit starts, and what was made from what."""

from pxr import Usd

from usdmotion.errors import SceneError
from usdmotion.usd.relations import bound_animation, target


def source_of(edit: Usd.Prim, skeleton: Usd.Prim) -> Usd.Prim:
    """Return the SkelAnimation that an edit starts from.

    It is the one that it names; else the one that is bound or, where that depends on the edit
    itself, the first on the way back through the results that does not.

    Raises:
        SceneError: There is none.
    """
    named = target(edit, "usdmotion:source")
    if named is not None:
        if depends_on(named, edit):
            raise SceneError(
                f"<{edit.GetPath()}> starts from <{named.GetPath()}>, which is made from its own "
                "result; clear usdmotion:source, or name another"
            )
        return named
    source = bound_animation(skeleton)
    while source is not None and depends_on(source, edit):
        behind = target(source, "usdmotion:result:source")
        if behind is None:
            raise SceneError(
                f"<{source.GetPath()}> is a result of <{edit.GetPath()}> and does not say from "
                "what; name the motion to start from in usdmotion:source"
            )
        source = behind
    if source is None:
        raise SceneError(
            f"<{edit.GetPath()}> has no motion to start from; bind a SkelAnimation to "
            f"<{skeleton.GetPath()}>, or name one in usdmotion:source"
        )
    return source


def depends_on(animation: Usd.Prim, edit: Usd.Prim) -> bool:
    """Tell whether an animation is a result of an edit, or was made from one."""
    seen = set()
    step: Usd.Prim | None = animation
    while step is not None and step.GetPath() not in seen:
        seen.add(step.GetPath())
        relationship = step.GetRelationship("usdmotion:result:edit")
        if relationship and edit.GetPath() in relationship.GetTargets():
            return True
        step = target(step, "usdmotion:result:source")
    return False
