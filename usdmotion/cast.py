"""Characters, and all their joints in one numbering, which is what constraints and solvers see."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from usdmotion.arrays import Bools, Floats, Ints, seal
from usdmotion.errors import SceneError
from usdmotion.humanoid import PartMap
from usdmotion.humanoid.parts import LEG
from usdmotion.kernels import beyond_limits, forward, limit_boxes
from usdmotion.motion import Body, Motion, Placement, Skeleton

Joint = tuple[str, str]
"""A joint of a scene: the path of its skeleton, its token."""


@dataclass(frozen=True, eq=False)
class Character:
    """One skeleton of a scene with its body, its input motion and its place in the world."""

    path: str
    """Path of the Skeleton prim."""
    skeleton: Skeleton
    body: Body
    motion: Motion
    """Input motion at the times that are solved."""
    placement: Placement
    """The skeleton's own space in the world at those times."""
    root: int
    """The joint that also translates when a constraint recruits it."""
    masses_from: str = "authored"
    """Where the body's masses are from, as a report says it."""
    parts: PartMap | None = None
    """Which joint is which part of a human body; None where that is not sure."""

    @cached_property
    def leg_length(self) -> float:
        """The length of a leg at rest [m]; without a known leg, half of what the rest spans."""
        skeleton, parts = self.skeleton, self.parts
        hip, ankle = (parts.joint(f"l_{each}") if parts else None for each in (LEG[0], LEG[2]))
        if hip is None or ankle is None:
            spans = np.linalg.norm(skeleton.rest_translations, axis=1)
            chains = [spans[list(skeleton.chain(joint))[:-1]].sum() for joint in range(len(spans))]
            return float(max(0.5 * max(chains), 1e-6))
        chain = skeleton.chain(ankle)
        below = list(chain[: chain.index(hip)])
        return float(np.linalg.norm(skeleton.rest_translations[below], axis=1).sum())

    def during(self, frames: slice) -> "Character":
        """Return the character on some of its frames."""
        motion, placement = self.motion.during(frames), self.placement.during(frames)
        return replace(self, motion=motion, placement=placement)


@dataclass(frozen=True, eq=False)
class Cast:
    """The nodes of every character: the skeleton's space first, then its joints.

    Nodes stand parents first. The node of a skeleton's space has the placement as its transform,
    so that a pose of all nodes says where everything is in the world.
    """

    times: Floats
    """Seconds from the first frame, shape (frame_count,)."""
    joints: tuple[Joint, ...]
    """What each node is; the token is "" for a skeleton's space."""
    parents: Ints
    """Index of each node's parent, -1 for none, shape (node_count,)."""
    translations: Floats
    """Input position in the parent's frame [m], shape (frame_count, node_count, 3)."""
    rotations: Floats
    """Input orientation in the parent's frame, xyzw, shape (frame_count, node_count, 4)."""
    translates: Bools
    """Which nodes are a solve's root, with six degrees of freedom, shape (node_count,)."""
    masses: Floats
    """Mass at each node [kg], shape (node_count,)."""
    mass_centers: Floats
    """Its centre in the node's frame [m], shape (node_count, 3)."""
    limits_min: Floats
    """Lower limit of the rotation vector of R_rest⁻¹R [degrees], shape (node_count, 3)."""
    limits_max: Floats
    """Upper limit of the same."""
    rest_translations: Floats
    """Rest position in the parent's frame [m], zero for a space, shape (node_count, 3)."""
    rest_rotations: Floats
    """Rest orientation in the parent's frame, xyzw, shape (node_count, 4)."""
    stiffness: Floats
    """Resistance in 0..1, shape (node_count,)."""
    priorities: Ints
    """Which joint of a chain moves first, the lower number, shape (node_count,)."""
    parts: tuple[str, ...]
    """H-Anim name of each node, "" for none, or where that is not sure."""

    @classmethod
    def of(cls, characters: Sequence[Character]) -> "Cast":
        """Return the cast of some characters.

        Raises:
            SceneError: Their motions are not sampled at the same times.
        """
        times = characters[0].motion.times
        for character in characters:
            if not np.array_equal(character.motion.times, times):
                raise SceneError(f"<{character.path}> is not sampled at the times of the others")
        identity = np.array([(0.0, 0.0, 0.0, 1.0)])
        free = np.full((1, 3), np.inf)
        parents: list[Ints] = []
        joints: list[Joint] = []
        for character in characters:
            start = len(joints)
            joints += [(character.path, token) for token in ("", *character.skeleton.joints)]
            parents += [np.array([-1]), character.skeleton.parents + 1 + start]

        def pile(name: str, space: NDArray[Any]) -> NDArray[Any]:
            each = [(space, getattr(character.body, name)) for character in characters]
            return np.concatenate([part for pair in each for part in pair])

        return cls(
            times=times,
            joints=tuple(joints),
            parents=seal(np.concatenate(parents), None, dtype=np.int64),
            translations=_per_frame(characters, "translations"),
            rotations=_per_frame(characters, "rotations"),
            translates=np.concatenate(
                [np.arange(len(each.skeleton.joints) + 1) == each.root + 1 for each in characters]
            ),
            masses=pile("masses", np.zeros(1)),
            mass_centers=pile("mass_centers", np.zeros((1, 3))),
            limits_min=pile("limits_min", -free),
            limits_max=pile("limits_max", free),
            rest_translations=_at_rest(characters, "rest_translations", np.zeros((1, 3))),
            rest_rotations=_at_rest(characters, "rest_rotations", identity),
            stiffness=pile("stiffness", np.zeros(1)),
            priorities=pile("priorities", np.zeros(1, dtype=np.int64)),
            parts=tuple(part for each in characters for part in ("", *_parts(each))),
        )

    def during(self, frames: slice) -> "Cast":
        """Return the cast on some of its frames."""
        return replace(
            self,
            times=self.times[frames],
            translations=self.translations[frames],
            rotations=self.rotations[frames],
        )

    @property
    def frame_count(self) -> int:
        """Number of frames that are solved."""
        return len(self.times)

    @property
    def node_count(self) -> int:
        """Number of nodes."""
        return len(self.joints)

    @cached_property
    def index(self) -> dict[Joint, int]:
        """Where each joint stands."""
        return {joint: index for index, joint in enumerate(self.joints)}

    @cached_property
    def _world(self) -> tuple[Floats, Floats]:
        return forward(self.parents, self.translations, self.rotations)

    @property
    def positions(self) -> Floats:
        """World positions in the input motion [m], shape (frame_count, node_count, 3)."""
        return self._world[0]

    @property
    def orientations(self) -> Floats:
        """World orientations in the input motion, xyzw, shape (frame_count, node_count, 4)."""
        return self._world[1]

    def node(self, joint: Joint, asked_by: str) -> int:
        """Return the node of a joint.

        Raises:
            SceneError: There is no such joint; the sentence names who asked for it.
        """
        if joint not in self.index:
            skeleton, token = joint
            known = [name for path, name in self.joints if path == skeleton and name]
            raise SceneError(
                f"<{asked_by}> names the joint '{token}', which <{skeleton}> does not have"
                + (f"; it has {', '.join(known[:6])}, …" if known else "")
            )
        return self.index[joint]

    def beyond_limits(self, rotations: Floats) -> Floats:
        """Return how far joints are beyond their limits, shape (frame_count, node_count) [degrees].

        Args:
            rotations: In the parent's frame, xyzw, shape (frame_count, node_count, 4).
        """
        limits = self.limits_min, self.limits_max
        limited = np.flatnonzero(((limits[0] > -180.0) | (limits[1] < 180.0)).any(axis=1))
        beyond = np.zeros(rotations.shape[:2])
        if len(limited):
            boxes = limit_boxes(*(each[limited] for each in limits))
            rest = self.rest_rotations[limited]
            beyond[:, limited] = np.degrees(beyond_limits(rotations[:, limited], rest, *boxes))
        return beyond

    def chain(self, node: int) -> tuple[int, ...]:
        """Return a joint's node and its ancestors up to the solve's root, or to the top joint."""
        chain = []
        while node >= 0 and self.joints[node][1]:
            chain.append(node)
            if self.translates[node]:
                break
            node = int(self.parents[node])
        return tuple(chain)

    def ancestors(self, node: int) -> tuple[int, ...]:
        """Return a joint's node and every joint above it."""
        chain = []
        while node >= 0 and self.joints[node][1]:
            chain.append(node)
            node = int(self.parents[node])
        return tuple(chain)


def _parts(character: Character) -> tuple[str, ...]:
    if character.parts is None:
        return ("",) * len(character.skeleton.joints)
    return character.parts.parts


def _at_rest(characters: Sequence[Character], name: str, space: Floats) -> Floats:
    return np.concatenate(
        [part for each in characters for part in (space, getattr(each.skeleton, name))]
    )


def _per_frame(characters: Sequence[Character], name: str) -> Floats:
    parts = []
    for character in characters:
        parts += [
            getattr(character.placement, name)[:, None],
            getattr(character.motion, name),
        ]
    joined = np.concatenate(parts, axis=1)
    return seal(joined, None, None, joined.shape[2])
