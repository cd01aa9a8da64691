"""The groups of a body and its limbs: from its parts where they are known, else from its shape."""

from collections.abc import Sequence
from enum import IntEnum
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from usdmotion import Cast, Floats, Ints
from usdmotion.kernels import conjugate, multiply, rotate

MAJOR = 0.25
"""A branch so long, against the longest one, is a limb; what carries two is the trunk."""
ALIKE = 0.4
"""The two segments of a limb are no more different than this."""
STRAIGHT = 0.05
"""Sine of the angle below which a limb says nothing of how it bends."""


class Group(IntEnum):
    """The groups of a body, in the order in which they are adapted (2005, figure 10)."""

    LEGS = 0
    HEAD = 1
    ARMS = 2
    TRUNK = 3


class Limb(NamedTuple):
    """Two segments that are moved as one."""

    node: int
    """Where it starts: a hip, a shoulder."""
    middle: int
    """A knee, an elbow."""
    end: int
    """An ankle, a wrist."""
    hinge: Floats
    """Axis about which it bends, in the frame of its first joint, shape (3,)."""


class Anatomy(NamedTuple):
    """What there is to know of the joints of a cast."""

    groups: Ints
    """A `Group` for each node, shape (node_count,)."""
    depths: Ints
    """How many joints carry each node, shape (node_count,)."""
    limbs: tuple[Limb, ...]


_LEG = ("hip", "knee", "talocrural")
_ARM = ("shoulder", "elbow", "radiocarpal")


def anatomy(cast: Cast) -> Anatomy:
    """Return the groups and the limbs of every character of a cast."""
    parents = cast.parents.tolist()
    depths = np.zeros(len(parents), dtype=np.int64)
    for node, parent in enumerate(parents):
        depths[node] = depths[parent] + 1 if parent >= 0 else 0
    groups = np.full(len(parents), int(Group.TRUNK), dtype=np.int64)
    limbs: list[Limb] = []
    spaces = [*np.flatnonzero(cast.parents < 0).tolist(), len(parents)]
    for first, last in pairwise(spaces):
        named = {cast.parts[node]: node for node in range(first, last) if cast.parts[node]}
        if named:
            _group_by_parts(named, parents, groups, last)
            limbs += _named_limbs(cast, named)
        else:
            limbs += _group_by_shape(cast, groups, first, last)
    return Anatomy(groups, depths, tuple(limbs))


def _group_by_parts(named: dict[str, int], parents: Sequence[int], groups: Ints, last: int) -> None:
    """Write the groups of a character whose joints have names."""
    tops: dict[int, Group] = {}
    for side in "lr":
        arm = [f"{side}_{part}" for part in ("sternoclavicular", "acromioclavicular", "shoulder")]
        known = [named[part] for part in arm if part in named]
        if known:
            tops[known[0]] = Group.ARMS
        if f"{side}_hip" in named:
            tops[named[f"{side}_hip"]] = Group.LEGS
    neck = [node for part, node in named.items() if part.startswith("vc") or part == "skullbase"]
    if neck:
        tops[min(neck)] = Group.HEAD
    for node in range(min(named.values()), last):
        if node in tops:
            groups[node] = tops[node]
        elif parents[node] >= 0:
            groups[node] = groups[parents[node]]


def _named_limbs(cast: Cast, named: dict[str, int]) -> list[Limb]:
    limbs = []
    forward = _forward(cast, named)
    for side in "lr":
        for chain, way in ((_LEG, -forward), (_ARM, forward)):
            node, middle, end = (named.get(f"{side}_{part}", -1) for part in chain)
            if min(node, middle, end) >= 0:
                limbs.append(Limb(node, middle, end, _hinge(cast, node, middle, end, way)))
    return limbs


def _rest(cast: Cast, node: int) -> tuple[Floats, Floats]:
    """Return where a node is at rest, and how the rest turns vectors of its frame."""
    place, turn = np.zeros(3), np.array([0.0, 0.0, 0.0, 1.0])
    while cast.parents[node] >= 0:
        own, offset = cast.rest_rotations[node], cast.rest_translations[node]
        place = offset + rotate(own, place)
        turn = multiply(own, turn)
        node = int(cast.parents[node])
    return place, turn


def _forward(cast: Cast, named: dict[str, int]) -> Floats:
    """Return where a body faces at rest: left × up."""
    if not {"l_hip", "r_hip", "skullbase"} <= set(named):
        return np.zeros(3)
    left, right, head = (_rest(cast, named[part])[0] for part in ("l_hip", "r_hip", "skullbase"))
    ahead = np.cross(left - right, head - 0.5 * (left + right))
    return ahead / max(float(np.linalg.norm(ahead)), 1e-12)


def _hinge(cast: Cast, node: int, middle: int, end: int, way: Floats) -> Floats:
    """Return the axis about which a limb bends, in the frame of its first joint.

    It is that of the rest's bend if it has one, else the one that moves its end the given way.
    """
    (start, turn), (knee, _), (tip, _) = (_rest(cast, each) for each in (node, middle, end))
    upper, lower = knee - start, tip - knee
    axis = np.cross(upper, lower)
    if np.linalg.norm(axis) < STRAIGHT * np.linalg.norm(upper) * np.linalg.norm(lower):
        axis = np.cross(upper, way)
    if np.linalg.norm(axis) < 1e-9:
        axis = np.cross(
            upper, [1.0, 0.0, 0.0] if abs(upper[0]) < abs(upper[2]) else [0.0, 0.0, 1.0]
        )
    size = float(np.linalg.norm(axis))
    return rotate(conjugate(turn), axis / size) if size > 0.0 else np.array([1.0, 0.0, 0.0])


def _group_by_shape(cast: Cast, groups: Ints, first: int, last: int) -> list[Limb]:
    """Write the groups of a character without names; return its limbs.

    The trunk is what carries two long branches; a branch that hangs on the root is a leg.
    """
    parents = cast.parents
    lengths = np.linalg.norm(cast.rest_translations, axis=-1)
    reach = np.zeros(last)
    for node in range(last - 1, first, -1):
        parent = parents[node]
        reach[parent] = max(reach[parent], reach[node] + lengths[node])
    roots = [node for node in range(first, last) if cast.translates[node]]
    root = roots[0] if roots else first
    branches: dict[int, list[int]] = {node: [] for node in range(first, last)}
    for node in range(first + 1, last):
        if reach[node] + lengths[node] >= MAJOR * reach[root]:
            branches[int(parents[node])].append(node)
    trunk = {first, root}
    for node in range(last - 1, first, -1):
        carried = [each for each in branches[node] if each in trunk]
        if len(branches[node]) > 1 or carried:
            trunk.add(node)
    limbs = []
    for node in range(first + 1, last):
        parent = int(parents[node])
        if node in trunk:
            continue
        if parent not in trunk:
            groups[node] = groups[parent]
            continue
        groups[node] = Group.LEGS if parent == root else Group.ARMS
        limbs += _limb_of(cast, range(first, last), lengths, node)
    return limbs


def _limb_of(cast: Cast, nodes: range, lengths: Floats, top: int) -> list[Limb]:
    """Return the two longest neighbouring segments of a branch, if they are alike."""
    chain = [top]
    children: dict[int, list[int]] = {}
    for node in nodes:
        children.setdefault(int(cast.parents[node]), []).append(node)
    while len(children.get(chain[-1], [])) == 1:
        chain.append(children[chain[-1]][0])
    best, found = 0.0, []
    for node, middle, end in zip(chain, chain[1:], chain[2:], strict=False):
        short, long = sorted((lengths[middle], lengths[end]))
        if short > max(best, ALIKE * long):
            best, found = short, [(node, middle, end)]
    return [Limb(*each, _hinge(cast, *each, np.zeros(3))) for each in found]
