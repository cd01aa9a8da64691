"""The walk as a motion, with the times at which heels and balls of the feet stand still."""

from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.demos.body import humanoid, sole
from usdmotion.demos.gait.pelvis import pelvis_position
from usdmotion.demos.gait.posture import local_rotations, world_rotations
from usdmotion.demos.gait.stance import FOOT_FLAT, HEEL_OFF, HEEL_STRIKE, TOE_OFF
from usdmotion.motion import Body, Motion, Skeleton

CADENCE = 113.0
"""Steps per minute of adults at free speed (Perry & Burnfield 2010), on a body of 1.7 m."""


@dataclass(frozen=True)
class Stance:
    """An interval in which one point of a foot stands still on the ground."""

    side: str
    """"Left" or "Right"."""
    effector: str
    """"heel" or "toe"."""
    joint: str
    """Token of the joint that carries the point."""
    start: float
    """First moment at which it stands [s]."""
    end: float
    """Last moment [s]."""


@dataclass(frozen=True, eq=False)
class Walk:
    """A walk along +Z, the one who walks, and where and when the feet stand."""

    motion: Motion
    """The local transforms of the joints."""
    skeleton: Skeleton
    """Its joints."""
    body: Body
    """Its masses and limits."""
    parts: tuple[str, ...]
    """H-Anim name of each joint."""
    heel_point: Floats
    """Underside of the heel in the frame of LeftFoot and RightFoot [m], shape (3,)."""
    toe_point: Floats
    """Underside of the ball in the frame of LeftToeBase and RightToeBase [m], shape (3,)."""
    stances: tuple[Stance, ...]
    """Every interval of every heel and ball, in order of its start, cut to the motion."""

    def joint(self, name: str) -> int:
        """Return the index of a joint by the last part of its token."""
        names = [token.rsplit("/", 1)[-1] for token in self.skeleton.joints]
        return names.index(name)


def walk(seconds: float = 6.0, frame_rate: float = 24.0, *, height: float = 1.7) -> Walk:
    """Return a walk on level ground that starts with the left heel's strike.

    Args:
        seconds: How long; the last frame is at that moment when it is a whole number of frames.
        frame_rate: Samples per second.
        height: Of the body [m]. Cadence goes with its inverse root (equal Froude numbers), so
            bodies of all heights walk alike.
    """
    skeleton, body, parts = humanoid(height)
    times = np.arange(int(np.floor(seconds * frame_rate + 1e-9)) + 1) / frame_rate
    cycles_per_second = cycle_rate(height)
    phase = times * cycles_per_second
    rotations = local_rotations(world_rotations(phase))
    translations = np.tile(skeleton.rest_translations, (len(times), 1, 1))
    start = pelvis_position(np.zeros(())) * (0.0, 0.0, 1.0)
    translations[:, 0] = height * (pelvis_position(phase) - start)
    soles = sole(height)
    stances = _stances(skeleton, cycles_per_second, float(times[-1]))
    motion = Motion(times, translations, rotations)
    return Walk(motion, skeleton, body, parts, soles.heel, soles.ball, stances)


def cycle_rate(height: float) -> float:
    """Return the cycles per second of a body [m]."""
    return CADENCE / 120.0 * float(np.sqrt(1.7 / height))


def _stances(skeleton: Skeleton, cycles_per_second: float, end: float) -> tuple[Stance, ...]:
    """Return when which point stands, from the phases of each foot."""
    joints = {token.rsplit("/", 1)[-1]: token for token in skeleton.joints}
    found = []
    for side, shift in (("Left", 0.0), ("Right", 0.5)):
        for effector, joint, first, last in (
            ("heel", joints[f"{side}Foot"], HEEL_STRIKE, HEEL_OFF),
            ("toe", joints[f"{side}ToeBase"], FOOT_FLAT, TOE_OFF),
        ):
            for cycle in range(-1, int(end * cycles_per_second) + 2):
                bounds = [(cycle - shift + phase) / cycles_per_second for phase in (first, last)]
                start, stop = max(bounds[0], 0.0), min(bounds[1], end)
                if start < stop:
                    found.append(Stance(side, effector, joint, start, stop))
    return tuple(sorted(found, key=lambda stance: (stance.start, stance.end)))
