"""Everything there is to know of a body, to take a motion off it and to put one on."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from usdmotion.arrays import Floats, seal
from usdmotion.errors import SceneError
from usdmotion.humanoid import PartMap
from usdmotion.kernels import conjugate, forward, multiply
from usdmotion.motion import Motion, Skeleton
from usdmotion.s4d.bodies.anatomy import Rest, basis, rest_pose
from usdmotion.s4d.bodies.measures import Measures
from usdmotion.s4d.bodies.places import LIMBS, ROOT, TOPS
from usdmotion.s4d.bodies.resting import Resting

_AS_AT_REST = 1e-4
"""A joint this near to where it is at rest is there [m]."""


@dataclass(frozen=True)
class Limb:
    """An arm or a leg."""

    name: str
    """H-Anim name of its top joint."""
    top: int
    middle: int
    end: int
    upper: float
    """Length from top to middle joint at rest [m]."""
    lower: float
    """Length from middle joint to end at rest [m]."""

    @property
    def length(self) -> float:
        """Length of the limb stretched out [m]."""
        return self.upper + self.lower


@dataclass(frozen=True, eq=False)
class Morphology:
    """A body: its skeleton, its parts, and where the axes of each part are in its joint."""

    skeleton: Skeleton
    """Its joints; at rest it stands, whatever the rest pose is that was given."""
    parts: PartMap
    axes: Floats
    """Orientation of the body at rest in the skeleton's space, x left, y up, z front, (4,)."""
    part_frames: Floats
    """Canonical frame of every joint in the joint's own frame, xyzw, shape (joint_count, 4).

    An orientation in the world times this one is the turn of the part away from a T-pose, the same
    on every skeleton.
    """

    def __post_init__(self) -> None:
        count = len(self.skeleton.joints)
        for name, shape in (
            ("axes", (4,)),
            ("part_frames", (count, 4)),
        ):
            object.__setattr__(self, name, seal(getattr(self, name), *shape, name=name))

    @classmethod
    def of(
        cls,
        skeleton: Skeleton,
        parts: PartMap,
        *,
        poses: Motion | None = None,
        who: str = "the skeleton",
    ) -> "Morphology":
        """Return what is known of a body.

        Args:
            skeleton: Its joints, standing at rest along any axis; arms and legs may be anywhere.
            parts: Which joint is which part.
            poses: How it moves. Its lengths are those that it usually has there, and its posture is
                looked at where its rest pose is none of a body. Without poses, what its motions
                have in other lengths than the rest pose is taken for something that moves.
            who: How to call the skeleton in an error.

        Raises:
            SceneError: Parts are missing, a limb has no length, or its rest pose is no posture of a
                body and there are no poses.
        """
        _refuse(skeleton, parts, who)
        rest = Rest(skeleton, parts)
        if not rest.stands:
            if poses is None or not poses.frame_count:
                raise SceneError(
                    f"{who} is in no posture of a body at rest; give it a rest pose in which it "
                    "stands, or bind a motion to it"
                )
            rest = Rest(skeleton, parts, Resting.seen(skeleton, parts, poses))
        frames = multiply(conjugate(rest.orientations), rest.frames())
        body = cls(rest.skeleton, parts, rest.axes, frames)
        return body if poses is None else body._as_in(poses, who)

    def _as_in(self, poses: Motion, who: str) -> "Morphology":
        """Return the body with the lengths that it usually has in a motion."""
        if not poses.frame_count:
            return self
        shape = self.skeleton
        usual = np.median(poses.translations, axis=0)
        away = np.linalg.norm(usual - shape.rest_translations, axis=-1) > _AS_AT_REST
        away[list(shape.chain(self.joint(ROOT)))] = False  # those carry it from place to place
        if not away.any():
            return self
        built = replace(
            shape, rest_translations=np.where(away[:, None], usual, shape.rest_translations)
        )
        _refuse(built, self.parts, who)
        return replace(self, skeleton=built)

    def joint(self, part: str) -> int:
        """Return the joint that is a part.

        Raises:
            SceneError: No joint is.
        """
        joint = self.parts.joint(part)
        if joint is None:
            raise SceneError(f"no joint of the skeleton is {part}; author usdmotion:parts on it")
        return joint

    def canonical(self, part: str) -> Floats:
        """Return the canonical frame of a part in the frame of its joint, xyzw, shape (4,)."""
        return np.asarray(self.part_frames[self.joint(part)])

    @cached_property
    def limbs(self) -> tuple[Limb, ...]:
        """Left arm and leg, right arm and leg."""
        places = self.rest_positions
        found = []
        for names in LIMBS:
            top, middle, end = map(self.joint, names)
            upper, lower = (
                float(np.linalg.norm(places[b] - places[a]))
                for a, b in ((top, middle), (middle, end))
            )
            found.append(Limb(names[0], top, middle, end, upper, lower))
        return tuple(found)

    @cached_property
    def measures(self) -> Measures:
        """The lengths of the body at rest."""
        return Measures.of(self.rest_positions[None], self.parts, self._upright)

    def measured(self, translations: Floats) -> Measures:
        """Return the lengths of the body as it grows.

        Args:
            translations: Of its joints at rest [m], shape (N, joint_count, 3).
        """
        rest = np.broadcast_to(self.skeleton.rest_rotations, (*translations.shape[:2], 4))
        positions, _ = forward(self.skeleton.parents, translations, rest)
        return Measures.of(positions, self.parts, self._upright)

    @property
    def leg_length(self) -> float:
        """Thigh and shank, mean of both legs [m]."""
        return float(self.measures.leg[0])

    @property
    def standing_heights(self) -> tuple[float, float]:
        """How high ankle and ball of a foot are over the sole that is on the ground [m]."""
        return float(self.measures.ankle_height[0]), float(self.measures.ball_height[0])

    @cached_property
    def frames_above(self) -> Floats:
        """Canonical frame of what carries each joint, in its own frame, xyzw, (joint_count, 4)."""
        parents = self.skeleton.parents
        return np.where((parents >= 0)[:, None], self.part_frames[parents], self.axes)

    def at_rest(self, part: str, above: str) -> Floats:
        """Return how a part is turned at rest as seen from another, xyzw, shape (4,)."""
        rest = self._upright
        return multiply(conjugate(rest[self.joint(above)]), rest[self.joint(part)])

    @cached_property
    def _rest(self) -> tuple[Floats, Floats]:
        return rest_pose(self.skeleton)

    @cached_property
    def _upright(self) -> Floats:
        """Canonical orientation of each joint at rest in the skeleton's space, (joint_count, 4)."""
        return multiply(self._rest[1], self.part_frames)

    @property
    def rest_positions(self) -> Floats:
        """Places of the joints at rest in the skeleton's space [m], shape (joint_count, 3)."""
        return self._rest[0]

    def basis(self, limb: Limb) -> Floats:
        """Return the axes of a limb in the canonical frames of its two segments, xyzw, (4,)."""
        return basis(limb.name)


def _refuse(skeleton: Skeleton, parts: PartMap, who: str) -> None:
    if parts.missing:
        raise SceneError(
            f"no joint of {who} can be told to be {', '.join(parts.missing)}; a motion is "
            "normalized on a whole human body; author usdmotion:parts on it"
        )
    for top in (*TOPS, "skullbase"):
        joint = parts.joint(top)
        assert joint is not None
        if parts.joint(ROOT) not in skeleton.chain(joint)[1:]:
            raise SceneError(
                f"{who} has its {top} '{skeleton.joints[joint]}' not below its {ROOT}; author "
                "usdmotion:parts on it"
            )
    for limb in LIMBS:
        joints = [parts.joint(part) for part in limb]
        for upper, lower, part in zip(joints[:-1], joints[1:], limb[1:], strict=True):
            assert upper is not None and lower is not None
            chain = skeleton.chain(lower)
            if upper not in chain:
                raise SceneError(
                    f"{who} has its {part} '{skeleton.joints[lower]}' not below "
                    f"'{skeleton.joints[upper]}'; author usdmotion:parts on it"
                )
            way = skeleton.rest_translations[list(chain[: chain.index(upper)])]
            if not np.any(way):
                raise SceneError(
                    f"{who} has no length between '{skeleton.joints[upper]}' and "
                    f"'{skeleton.joints[lower]}' at rest; give it a rest pose"
                )
