"""Which results are shown: a Skeleton is bound to the result of an edit, or to its source."""

from pxr import Sdf, Usd

from usdmotion.errors import SceneError
from usdmotion.usd.bindings import holder_of
from usdmotion.usd.edits import animation_to_bind
from usdmotion.usd.layers import apply_schema, over, relate
from usdmotion.usd.origins import depends_on, source_of
from usdmotion.usd.relations import bound_animation, edit_of, skeleton_of


def is_shown(stage: Usd.Stage, path: str) -> bool:
    """Tell whether a Skeleton is bound to the result of its edit, or to what was made from it.

    Args:
        stage: The stage.
        path: Path of a MotionEdit, or of a prim in one.

    Raises:
        SceneError: It is none, or solves no Skeleton.
    """
    edit, skeleton = _edit_and_skeleton(stage, path)
    bound = bound_animation(skeleton)
    return bound is not None and depends_on(bound, edit)


def author_shown(layer: Sdf.Layer, stage: Usd.Stage, path: str, on: bool) -> None:
    """Bind a Skeleton to the result of its edit, or to what that was made from.

    Where the result of another edit is stacked on it, that one is shown, or hidden too.

    Args:
        layer: Where to write it.
        stage: The stage.
        path: Path of the MotionEdit, or of a prim in it.
        on: Whether the result is to be shown.

    Raises:
        SceneError: It has no result, or nothing can be bound to its Skeleton.
    """
    edit, skeleton = _edit_and_skeleton(stage, path)
    source = str(source_of(edit, skeleton).GetPath())
    animation = animation_to_bind(edit, skeleton) if on else source
    if not stage.GetPrimAtPath(animation):
        raise SceneError(f"<{edit.GetPath()}> has no result; solve it first")
    if is_shown(stage, path) != on:
        author_binding(layer, holder_of(skeleton), animation)


def author_binding(layer: Sdf.Layer, holder: str, animation: str) -> None:
    """Bind an animation, in a layer, on the prim of which a Skeleton has what it is bound to."""
    prim = over(layer, holder)
    apply_schema(prim, "SkelBindingAPI")
    relate(prim, "skel:animationSource", animation)


def _edit_and_skeleton(stage: Usd.Stage, path: str) -> tuple[Usd.Prim, Usd.Prim]:
    edit = edit_of(stage.GetPrimAtPath(path))
    if edit is None:
        raise SceneError(f"<{path}> is in no MotionEdit; name one")
    skeleton = skeleton_of(edit)
    if skeleton is None:
        raise SceneError(f"<{edit.GetPath()}> solves no Skeleton; set usdmotion:skeleton")
    return edit, skeleton
