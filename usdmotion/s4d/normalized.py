"""The normalized motion: a value that depends on no body (2005, section 4)."""

from dataclasses import dataclass, field, replace

import numpy as np

from usdmotion.arrays import Floats, Ints, seal


@dataclass(frozen=True, eq=False, kw_only=True)
class NormalizedMotion:
    """Postures over time on the normalized skeleton.

    Everything is told in the axes of the normalized body: x to its left, y up, z to its front, as
    it stands in a T-pose, palms down. A part's frame is the identity there, whatever the axes of
    its joint and the rest pose of its skeleton are, so that a rotation means the same on every one.
    F frames, L limbs, S segments, P points, C carriers, E extra joints, O offset joints.
    """

    times: Floats
    """Seconds, ascending, shape (F,)."""
    limbs: tuple[str, ...]
    """The arms and legs, each by the H-Anim name of its top joint."""
    limb_frames: Floats
    """Frame at the top joint, seen from the part that carries it, xyzw, shape (F, L, 4): z points
    from the top joint to the end, y to the side where the middle joint is (2005, figure 4)."""
    limb_lengths: Floats
    """Distance from the top joint to the end, over the limb stretched out (2005, equation 1),
    shape (F, L)."""
    limb_twists: Floats
    """Turn of the upper and of the lower segment about themselves, away from the half-plane [rad],
    shape (F, L, 2)."""
    segments: tuple[str, ...]
    """What has a rotation of its own, each by its H-Anim name: vertebrae, neck, head, clavicles,
    hands, feet, toes, fingers; what carries another comes first."""
    segment_rotations: Floats
    """Rotation of each as seen from what carries it, xyzw, shape (F, S, 4)."""
    spine: Floats
    """Points of the spine from the pelvis up, over its length, as seen from the pelvis, shape
    (F, P, 3); straight up at rest, whatever the curvature of the body's own spine is."""
    root_position: Floats
    """Middle of the hip joints over leg length; its height is above where ankles are when soles are
    on the ground, and over the length to the carriers, shape (F, 3)."""
    root_heading: Floats
    """Turn of the body about the up axis, xyzw, shape (F, 4)."""
    root_orientation: Floats
    """What is left of the pelvis' orientation without its heading, xyzw, shape (F, 4)."""
    carriers: tuple[str, ...] = ()
    """The joints that carry the root, each by its H-Anim name; none is the ankles."""
    carrier_shares: Floats = field(default_factory=lambda: np.zeros((0, 0)))
    """How much each carries, adding up to 1, shape (F, C)."""
    extra_joints: tuple[str, ...] = ()
    """Tokens of the joints that have no place above."""
    extra_rotations: Floats = field(default_factory=lambda: np.zeros((0, 0, 4)))
    """Rotation of each away from rest, in the axes of what carries it, xyzw, shape (F, E, 4)."""
    offset_joints: tuple[str, ...] = ()
    """Tokens of the joints that are translated in their parent's frame, the root apart."""
    offsets: Floats = field(default_factory=lambda: np.zeros((0, 0, 3)))
    """Translation of each away from where it usually is over leg length, in the axes of what
    carries it, shape (F, O, 3)."""

    def on(self, frames: slice | Ints) -> "NormalizedMotion":
        """Return the motion on some of its frames."""
        own = {name: getattr(self, name)[frames] for name in _OVER_TIME}
        return replace(self, **own)

    def __post_init__(self) -> None:
        frames = len(self.times)
        limbs, segments = len(self.limbs), len(self.segments)
        shapes: dict[str, tuple[int | None, ...]] = {
            "times": (frames,),
            "limb_frames": (frames, limbs, 4),
            "limb_lengths": (frames, limbs),
            "limb_twists": (frames, limbs, 2),
            "segment_rotations": (frames, segments, 4),
            "spine": (frames, None, 3),
            "root_position": (frames, 3),
            "root_heading": (frames, 4),
            "root_orientation": (frames, 4),
            "carrier_shares": (frames, len(self.carriers)),
            "extra_rotations": (frames, len(self.extra_joints), 4),
            "offsets": (frames, len(self.offset_joints), 3),
        }
        for name, shape in shapes.items():
            value = getattr(self, name)
            if 0 in shape and np.size(value) == 0:
                value = np.zeros(tuple(size or 0 for size in shape))
            object.__setattr__(self, name, seal(value, *shape, name=name))


_OVER_TIME = (
    "times",
    "limb_frames",
    "limb_lengths",
    "limb_twists",
    "segment_rotations",
    "spine",
    "root_position",
    "root_heading",
    "root_orientation",
    "carrier_shares",
    "extra_rotations",
    "offsets",
)
"""The fields that have a value on each frame."""
