"""A map from the parts of a human body to the joints of a skeleton."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from usdmotion.errors import SceneError
from usdmotion.humanoid.parts import NECK, NEEDED, PARTS, SPINE


@dataclass(frozen=True)
class PartMap:
    """Which part of a body each joint of a skeleton is."""

    parts: tuple[str, ...]
    """H-Anim name of each joint, "" for none, parallel to the skeleton's joints."""

    @classmethod
    def given(
        cls, parts: Sequence[str], joint_count: int, *, who: str = "the skeleton"
    ) -> "PartMap":
        """Return the map that a skeleton says itself; an empty one where it says nothing.

        Raises:
            SceneError: It is not parallel to the joints, or names no part, or one of them twice.
        """
        if not len(parts):
            return cls(("",) * joint_count)
        if len(parts) != joint_count:
            raise SceneError(
                f"usdmotion:parts of {who} has {len(parts)} names for {joint_count} joints; it "
                'needs one for each joint, "" for none'
            )
        named = [part for part in map(str, parts) if part]
        for part in named:
            if part not in PARTS:
                raise SceneError(
                    f"usdmotion:parts of {who} names '{part}', which is no part of a body; the "
                    "names are those of H-Anim, such as humanoid_root, l_hip or skullbase"
                )
            if named.count(part) > 1:
                raise SceneError(
                    f"usdmotion:parts of {who} names '{part}' twice; a part is one joint"
                )
        return cls(tuple(map(str, parts)))

    @cached_property
    def _joints(self) -> dict[str, int]:
        return {part: joint for joint, part in enumerate(self.parts) if part}

    def joint(self, part: str) -> int | None:
        """Return the joint that is a part, None where there is none."""
        return self._joints.get(part)

    @property
    def pelvis(self) -> int | None:
        """The joint that carries legs and trunk."""
        root = self.joint("humanoid_root")
        return self.joint("sacroiliac") if root is None else root

    @property
    def spine(self) -> tuple[int, ...]:
        """The joints of the back, from the pelvis up."""
        return tuple(self._joints[part] for part in SPINE if part in self._joints)

    @property
    def neck(self) -> tuple[int, ...]:
        """The joints of the neck, from the chest up."""
        return tuple(self._joints[part] for part in NECK if part in self._joints)

    @property
    def missing(self) -> tuple[str, ...]:
        """The parts that a human body needs and that no joint is."""
        parts = [part for part in NEEDED if part not in self._joints]
        return tuple(parts if self.spine else [*parts, SPINE[0]])
