"""Somebody who does what his pelvis, chest, hands and feet are told, limbs bent to reach them."""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.spatial.transform import Rotation

from usdmotion.arrays import Floats
from usdmotion.demos.body import USUAL, Proportions, humanoid, sole
from usdmotion.demos.gait import Walk
from usdmotion.demos.gait.posture import local_rotations
from usdmotion.kernels import conjugate, from_vector, multiply, rotate, to_vector
from usdmotion.motion import Motion, Skeleton

RATE = 24.0
"""Frames per second."""
SIDES = (("Left", 1), ("Right", -1))
_STRETCHED = 0.998
"""How far a limb reaches at most, over its length: a straight one does not know where to bend."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Script:
    """What somebody does; F frames, the left side first. Places in metres, in the world."""

    pelvis: Floats
    """Where the root joint is, shape (F, 3)."""
    hips: Floats
    """Orientation of the pelvis, xyzw, shape (F, 4)."""
    chest: Floats
    """Orientation of the upper thorax; the spine is in between, shape (F, 4)."""
    head: Floats
    """Orientation of the head, shape (F, 4)."""
    ankles: tuple[Floats, Floats]
    """Where they are, each of shape (F, 3)."""
    feet: tuple[Floats, Floats]
    """Orientation of the feet, each of shape (F, 4)."""
    wrists: tuple[Floats, Floats]
    """Where they are, each of shape (F, 3)."""
    elbows: tuple[Floats, Floats]
    """The direction in which each elbow points, away from shoulder and wrist, shape (F, 3)."""
    knees: tuple[Floats, Floats] | None = None
    """The direction in which each knee points, shape (F, 3); None is where hips and foot point."""
    toes: tuple[Floats, Floats] | None = None
    """Orientation of the toes, each of shape (F, 4); None is that of the feet."""
    hands: tuple[Floats, Floats] | None = None
    """Orientation of the hands, each of shape (F, 4); None is that of the forearms."""


def through(table: tuple[tuple[float, ...], ...], times: Floats) -> Floats:
    """(F,) to (F, C): curves that never overshoot through rows whose first column is the moment."""
    rows = np.array(table)
    return np.asarray(PchipInterpolator(rows[:, 0], rows[:, 1:])(times))


def turn(*degrees: tuple[int, Floats | float]) -> Floats:
    """Return turns about world axes, the last one done first, shape (F, 4) or (4,)."""
    done = np.array((0.0, 0.0, 0.0, 1.0))
    for axis, angle in degrees:
        vector = np.zeros((*np.shape(angle), 3))
        vector[..., axis] = np.radians(angle)
        done = multiply(done, from_vector(vector))
    return np.asarray(done)


def act(
    times: Floats, script: Script, *, height: float = 1.7, proportions: Proportions = USUAL
) -> Walk:
    """Return somebody who does what a script says.

    Args:
        times: Of the frames [s], shape (F,).
        script: What he does.
        height: Of the body [m].
        proportions: How it differs from the usual one.
    """
    skeleton, body, parts = humanoid(height, proportions=proportions)
    translations = np.tile(skeleton.rest_translations, (len(times), 1, 1))
    translations[:, 0] = script.pelvis
    world = _trunk(script)
    for side in (0, 1):
        world |= _leg(skeleton, script, world, side) | _arm(skeleton, script, world, side)
    rotations = _steady(local_rotations(world))
    soles = sole(height, proportions)
    motion = Motion(times, translations, rotations)
    return Walk(motion, skeleton, body, parts, soles.heel, soles.ball, ())


def _steady(rotations: Floats) -> Floats:
    """Return rotations whose signs do not change from frame to frame."""
    turned = np.sum(rotations[1:] * rotations[:-1], axis=-1) < 0.0
    signs = np.where(np.cumsum(turned, axis=0) % 2, -1.0, 1.0)
    return np.concatenate([rotations[:1], rotations[1:] * signs[..., None]])


def _trunk(script: Script) -> dict[str, Floats]:
    """Return the world orientation of pelvis, vertebrae, neck and head."""
    bend = to_vector(multiply(conjugate(script.hips), script.chest))
    nod = to_vector(multiply(conjugate(script.chest), script.head))
    return {
        "Hips": script.hips,
        "Spine": multiply(script.hips, from_vector(bend / 3.0)),
        "Spine1": multiply(script.hips, from_vector(bend * (2.0 / 3.0))),
        "Spine2": script.chest,
        "Neck": multiply(script.chest, from_vector(0.5 * nod)),
        "Head": script.head,
    }


def _place(skeleton: Skeleton, script: Script, world: dict[str, Floats], name: str) -> Floats:
    """Return where a joint is whose ancestors are turned already, shape (F, 3)."""
    names = [token.rsplit("/", 1)[-1] for token in skeleton.joints]
    place, joint = np.zeros(3), names.index(name)
    while joint > 0:
        parent = int(skeleton.parents[joint])
        place = place + rotate(world[names[parent]], skeleton.rest_translations[joint])
        joint = parent
    return np.asarray(script.pelvis + place)


def _lengths(skeleton: Skeleton, *names: str) -> list[float]:
    """Return how far some joints are from their parents [m]."""
    ends = [token.rsplit("/", 1)[-1] for token in skeleton.joints]
    rows = [ends.index(name) for name in names]
    return [float(each) for each in np.linalg.norm(skeleton.rest_translations[rows], axis=1)]


def _leg(
    skeleton: Skeleton, script: Script, world: dict[str, Floats], side: int
) -> dict[str, Floats]:
    """Return a leg whose knee points to where pelvis and foot point."""
    name, _ = SIDES[side]
    hip = _place(skeleton, script, world, f"{name}UpLeg")
    front = np.array((0.0, 0.0, 1.0))
    knee = rotate(script.feet[side], front) + rotate(script.hips, front)
    if script.knees is not None:
        knee = script.knees[side]
    lengths = _lengths(skeleton, f"{name}Leg", f"{name}Foot")
    upper, lower, hinge = _bent(script.ankles[side] - hip, knee, lengths)
    toes = script.feet if script.toes is None else script.toes
    return {
        f"{name}UpLeg": _frame(hinge, -upper),
        f"{name}Leg": _frame(hinge, -lower),
        f"{name}Foot": script.feet[side],
        f"{name}ToeBase": toes[side],
    }


def _arm(
    skeleton: Skeleton, script: Script, world: dict[str, Floats], side: int
) -> dict[str, Floats]:
    """Return an arm that reaches a place, its elbow where it is told."""
    name, sign = SIDES[side]
    world = world | {f"{name}Shoulder": script.chest}
    shoulder = _place(skeleton, script, world, f"{name}Arm")
    lengths = _lengths(skeleton, f"{name}ForeArm", f"{name}Hand")
    upper, lower, hinge = _bent(script.wrists[side] - shoulder, script.elbows[side], lengths)
    fore = _frame(sign * lower, -sign * hinge)
    hands = (fore, fore) if script.hands is None else script.hands
    return {
        f"{name}Shoulder": script.chest,
        f"{name}Arm": _frame(sign * upper, -sign * hinge),
        f"{name}ForeArm": fore,
        f"{name}Hand": hands[side],
    }


def _bent(way: Floats, toward: Floats, lengths: list[float]) -> tuple[Floats, Floats, Floats]:
    """Return directions of two segments that span a way, and the axis about which they bend.

    The axis is that about which the first one is turned into the second one.
    """
    a, b = lengths
    distance = np.linalg.norm(way, axis=-1, keepdims=True)
    along = way / distance
    distance = np.minimum(distance, _STRETCHED * (a + b))
    side = toward - np.sum(toward * along, axis=-1, keepdims=True) * along
    side /= np.linalg.norm(side, axis=-1, keepdims=True)
    ahead = (a**2 - b**2 + distance**2) / (2.0 * distance)
    out = np.sqrt(a**2 - ahead**2)
    upper = (ahead * along + out * side) / a
    lower = ((distance - ahead) * along - out * side) / b
    return upper, lower, np.cross(side, along)


def _frame(x: Floats, y: Floats) -> Floats:
    """(F, 3), (F, 3) to (F, 4): the frame with its x and y there, which are at right angles."""
    axes = np.stack([x, y, np.cross(x, y)], axis=-1)
    return np.asarray(Rotation.from_matrix(axes).as_quat())
