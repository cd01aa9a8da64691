"""2004, figure 7: a walk on level ground becomes one over irregular steps, up and down."""

from pathlib import Path

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.constraints import (
    Constraint,
    Goal,
    OrientationConstraint,
    PositionConstraint,
    TrajectoryConstraint,
)
from usdmotion.demos.figures import Figure
from usdmotion.demos.gait import Stance, Walk, walk
from usdmotion.demos.walker import SKELETON, balance, feet, token, write_walk
from usdmotion.kernels import forward, from_vector, world_points

STEPS = {
    "Left": (0.0, 0.06, 0.18, 0.21, 0.09, 0.0),
    "Right": (0.0, 0.0, 0.11, 0.22, 0.14, 0.02, 0.0),
}
"""How high each footfall is [m], by its foot and in order; the right foot stands on its first."""
SMOOTHING = 1.5
"""Cutoff of the filter between the two passes [Hz]; there are 1.9 steps a second."""
EDGE = 1e-6
"""How near to an end of a stance a frame is one of it [s]."""
ELBOW = np.array((-0.1785, 0.0816, 0.0)) + 0.3162 * np.array((-0.15, -0.95, 0.2739))
"""Where the right elbow is to be in the frame of the upper thorax [m]: an upper arm away."""
FOREARM = from_vector(np.array((0.0, 0.5 * np.pi, 0.0)))
"""How the right forearm is to lie there: it points ahead, as if it carried a cup."""
CARRIES = (0.5, 1.5, 4.5, 5.5)
"""When the arm leaves its swing, is there, leaves, is back [s]."""


def build(output: Path) -> None:
    """Write the stage."""
    walking = walk()
    planted = feet(walking, priority=1)
    asked = [
        *(_over_steps(walking, each) for each in planted),
        balance(planted, priority=2),
        *_carrying(walking),
    ]
    write_walk(output, walking, "Stairs", asked, smoothing=SMOOTHING, passes=2)


def rise(walking: Walk, side: str, times: Floats) -> Floats:
    """Return how high a foot is above where it was [m]: on its steps, and from one to the next."""
    total = np.full(len(times), STEPS[side][0])
    footfalls = _falls(walking, side)
    for index in range(1, len(footfalls)):
        start, end = footfalls[index - 1][1], footfalls[index][0]
        s = np.clip((times - start) / (end - start), 0.0, 1.0)
        total += (STEPS[side][index] - STEPS[side][index - 1]) * s**3 * (10 - 15 * s + 6 * s**2)
    return total


def _falls(walking: Walk, side: str) -> list[tuple[float, float]]:
    """Return when each footfall of a foot begins and ends [s], from heel to toe."""
    heels = [each for each in walking.stances if (each.side, each.effector) == (side, "heel")]
    toes = [each for each in walking.stances if (each.side, each.effector) == (side, "toe")]
    starts = [each.start for each in heels]
    if len(starts) < len(toes):
        starts.insert(0, toes[0].start)
    return list(zip(starts, (each.end for each in toes), strict=True))


def _over_steps(walking: Walk, planted: PositionConstraint) -> TrajectoryConstraint:
    """Return the trajectory of a point under a foot: still in its stances, points in between."""
    motion = walking.motion
    joint = walking.skeleton.joints.index(planted.joint)
    side, effector = planted.path[:-4], {"Heel": "heel", "Ball": "toe"}[planted.path[-4:]]
    positions, rotations = forward(walking.skeleton.parents, motion.translations, motion.rotations)
    places = world_points(positions[:, joint], rotations[:, joint], planted.point)
    places[:, 1] += rise(walking, side, motion.times)
    stances = [e for e in walking.stances if (e.side, e.effector) == (side, effector)]
    keys, releases = _moments(stances, motion.times)
    middle = 0.5 * (keys + releases)
    return TrajectoryConstraint(
        path=planted.path,
        skeleton=SKELETON,
        joint=planted.joint,
        point=planted.point,
        priority=planted.priority,
        times=(float(motion.times[0]), float(motion.times[-1])),
        keys=tuple(map(float, keys)),
        releases=tuple(map(float, releases)),
        points=np.stack([np.interp(middle, motion.times, each) for each in places.T], axis=1),
    )


def _moments(stances: list[Stance], times: Floats) -> tuple[Floats, Floats]:
    """Return when points are reached and left: a stance is one, a swing has one a frame.

    The first and the last frame belong to the ends of the curve.
    """
    pairs = []
    for each in stances:
        planted = times[(times >= each.start - EDGE) & (times <= each.end + EDGE)]
        first, last = max(planted[0], times[1]), min(planted[-1], times[-2])
        if first < last:
            pairs.append((first, last))
    swung = [t for t in times[1:-1] if all(t < first or t > last for first, last in pairs)]
    pairs += [(moment, moment) for moment in swung]
    pairs.sort()
    keys, releases = np.array(pairs).T
    return keys, releases


def _carrying(walking: Walk) -> list[Constraint]:
    """Return the right elbow against the torso (3), and how the forearm lies against it (4)."""
    torso = (SKELETON, token(walking, "Spine2"))
    joint = token(walking, "RightForeArm")
    recruits = (token(walking, "RightShoulder"), token(walking, "RightArm"), joint)
    place = Goal(path="Place", translation=ELBOW, joint=torso, times=CARRIES)
    level = Goal(path="Level", rotation=FOREARM, joint=torso, times=CARRIES)
    elbow = PositionConstraint(
        path="RightElbow",
        skeleton=SKELETON,
        joint=joint,
        priority=3,
        recruits=recruits,
        goals=(place,),
    )
    forearm = OrientationConstraint(
        path="RightForeArm",
        skeleton=SKELETON,
        joint=joint,
        priority=4,
        recruits=recruits,
        goals=(level,),
    )
    return [elbow, forearm]


PICTURE = Figure(
    "2004, figure 7: a walk becomes one over irregular steps",
    frames=(1.0, 25.0, 49.0, 73.0, 97.0, 121.0, 145.0),
    views=("side",),
)
