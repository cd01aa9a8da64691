"""Goals: a prim's transform, in the frame that it is given in."""

from collections.abc import Mapping

from pxr import Usd

from usdmotion.arrays import Floats
from usdmotion.constraints import Goal
from usdmotion.errors import SceneError
from usdmotion.kernels import conjugate, multiply
from usdmotion.usd.attributes import collapse, read_fields
from usdmotion.usd.characters import Sitting
from usdmotion.usd.relations import is_a, target, value
from usdmotion.usd.shot import Facts
from usdmotion.usd.transforms import local_matrices, parent_matrices, rigid, world_matrices


def space_skeleton(goal: Usd.Prim) -> Usd.Prim | None:
    """Return the Skeleton of the joint in whose frame a prim gives places; None for no joint.

    Raises:
        SceneError: It names a joint, but of no Skeleton.
    """
    if not value(goal, "usdmotion:spaceJoint", ""):
        return None
    space = target(goal, "usdmotion:space")
    if not is_a(space, "UsdSkelSkeleton"):
        raise SceneError(
            f"<{goal.GetPath()}> has a usdmotion:spaceJoint of no Skeleton; name one in "
            "usdmotion:space"
        )
    return space


def read_goal(
    prim: Usd.Prim, sittings: Mapping[str, Sitting], time_codes: Floats, facts: Facts
) -> Goal:
    """Return a goal, in the world or in the frame of a joint.

    Args:
        prim: The MotionGoal.
        sittings: The characters of the scene by the paths of their skeletons.
        time_codes: The frames.
        facts: Units and rates of the stage.

    Raises:
        SceneError: Its space has no rotation, or is a joint that is not there.
    """
    fields = read_fields(prim, Goal, time_codes, facts) | {"path": str(prim.GetPath())}
    skeleton = space_skeleton(prim)
    if skeleton is not None:
        return _in_joint(prim, sittings[str(skeleton.GetPath())], time_codes, fields)
    return _in_world(prim, time_codes, facts, fields)


def _in_joint(
    prim: Usd.Prim, sitting: Sitting, time_codes: Floats, fields: dict[str, object]
) -> Goal:
    token = str(value(prim, "usdmotion:spaceJoint"))
    index = sitting.character.skeleton.index.get(token)
    if index is None:
        raise SceneError(
            f"<{prim.GetPath()}> is in the frame of the joint '{token}', which "
            f"<{sitting.character.path}> does not have; name one of its joints"
        )
    local = local_matrices(prim, time_codes)
    translations, rotations, _ = rigid(local, f"<{prim.GetPath()}>")
    return Goal(
        **fields,  # type: ignore[arg-type]
        translation=collapse(translations * sitting.scaling.of_joints[:, index]),
        rotation=collapse(rotations),
        joint=(sitting.character.path, token),
    )


def _in_world(prim: Usd.Prim, time_codes: Floats, facts: Facts, fields: dict[str, object]) -> Goal:
    named = target(prim, "usdmotion:space")
    if named is None:
        space = parent_matrices(prim, time_codes)
        space_name = f"<{prim.GetPath()}>"
    else:
        space = world_matrices(named, time_codes)
        space_name = f"<{named.GetPath()}>, the space of <{prim.GetPath()}>,"
    local = local_matrices(prim, time_codes)
    _, axes, _ = rigid(space, space_name)
    if fields.get("mode") == "offset":
        # A vector is turned by its space, and so is a rotation: it is told in other axes.
        translations = (local[:, 3:, :3] @ space[:, :3, :3])[:, 0]
        turns = rigid(local, f"<{prim.GetPath()}>")[1]
        rotations = multiply(multiply(axes, turns), conjugate(axes))
    else:
        translations, rotations, _ = rigid(local @ space, f"<{prim.GetPath()}>")
    return Goal(
        **fields,  # type: ignore[arg-type]
        translation=collapse(translations * facts.meters_per_unit),
        rotation=collapse(rotations),
        axes=collapse(axes),
    )
