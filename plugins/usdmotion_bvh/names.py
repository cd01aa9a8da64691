"""Names of a file made into names that USD allows."""

from collections import Counter

from usdmotion_bvh.hierarchy import Joint


def valid_name(name: str) -> str:
    """Return a name with every character that USD does not allow in one replaced by `_`."""
    cleaned = "".join(letter if f"a{letter}".isidentifier() else "_" for letter in name)
    return cleaned if cleaned.isidentifier() else f"_{cleaned}"


def joint_tokens(joints: tuple[Joint, ...]) -> tuple[str, ...]:
    """Return the path of each joint, of valid names; namesakes below one parent are numbered."""
    taken: Counter[str] = Counter()
    tokens: list[str] = []
    for joint in joints:
        above = f"{tokens[joint.parent]}/" if joint.parent >= 0 else ""
        token = wanted = above + valid_name(joint.name)
        while taken[token]:
            taken[wanted] += 1
            token = f"{wanted}_{taken[wanted]}"
        taken[token] += 1
        tokens.append(token)
    return tuple(tokens)
