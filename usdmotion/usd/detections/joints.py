"""Which joint of a skeleton somebody means."""

from collections.abc import Sequence

from usdmotion.errors import SceneError
from usdmotion.humanoid import FEET, PartMap
from usdmotion.usd.relations import suggestion


def leaf_of(token: str) -> str:
    """Return the last name of a joint's token."""
    return token.rsplit("/", 1)[-1]


def find_joint(name: str, tokens: Sequence[str], path: str) -> str | None:
    """Return the token of the joint that a name means, None where it means none.

    Args:
        name: A token, or the last name of just one.
        tokens: The joints of the skeleton.
        path: Path of the Skeleton, for the error.

    Raises:
        SceneError: Several joints have the name.
    """
    if name in tokens:
        return name
    same = [token for token in tokens if leaf_of(token) == name]
    if len(same) > 1:
        raise SceneError(
            f"<{path}> has {len(same)} joints called '{name}'; write one of {', '.join(same)}"
        )
    return same[0] if same else None


def unknown_joint(name: str, tokens: Sequence[str], paths: Sequence[str]) -> SceneError:
    """Return the error that a name means no joint of some skeletons.

    Args:
        name: The name.
        tokens: The joints of the first of them.
        paths: Paths of the skeletons.
    """
    if name.startswith("/"):
        return SceneError(f"'{name}' is no joint; name prims with --prims")
    where = " or ".join(f"<{path}>" for path in paths)
    leaves = tuple(dict.fromkeys(leaf_of(token) for token in tokens))
    return SceneError(f"there is no joint '{name}' on {where}; {suggestion(name, leaves)}")


def feet_of(tokens: Sequence[str], parts: PartMap) -> tuple[str, ...]:
    """Return the ankles and balls of the feet, none where nobody knows which they are."""
    joints = [parts.joint(part) for part in FEET]
    return tuple(tokens[joint] for joint in joints if joint is not None)
