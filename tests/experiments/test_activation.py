"""2004, section 5.2: constraints of every kind come and go, and no joint jumps."""

from dataclasses import replace

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom

from usdmotion import constraints as kinds
from usdmotion.constraints import Goal, Region, Space
from usdmotion.curves import ease
from usdmotion.demos import activation
from usdmotion.demos.gait import walk
from usdmotion.demos.walker import (
    RATE,
    SKELETON,
    VARIANTS,
    feet,
    seconds,
    token,
    write_walk,
)
from usdmotion.kernels import from_vector, multiply

WALK = walk()
KEYS = tuple(map(seconds, (43.0, 55.0, 91.0, 103.0)))
"""It comes and goes within half a second each."""
ABRUPT = (KEYS[1] - 1.0 / RATE, KEYS[1], KEYS[2], KEYS[2] + 1.0 / RATE)
CART = "/Cart"
"""A frame that goes along with the walker."""
HIPS = WALK.motion.translations[:, 0]
THORAX = (SKELETON, token(WALK, "Spine2"))


def arm(side):
    return tuple(token(WALK, f"{side}{part}") for part in ("Shoulder", "Arm", "ForeArm"))


def on_left_wrist(**fields):
    return {"joint": token(WALK, "LeftHand"), "recruits": arm("Left"), **fields}


def offset(*way):
    return (Goal(mode="offset", translation=np.array(way)),)


CASES = {
    kinds.PositionConstraint: on_left_wrist(goals=offset(0.1, 0.2, 0.15)),
    kinds.OrientationConstraint: {
        "joint": THORAX[1],
        "goals": (Goal(mode="offset", rotation=from_vector(np.array([0.0, 0.6, 0.0]))),),
    },
    kinds.TrajectoryConstraint: on_left_wrist(
        times=(KEYS[0] - 0.5, KEYS[3] + 0.5),
        keys=(KEYS[1], KEYS[2]),
        points=np.array([[0.25, 0.10, 0.35], [0.15, -0.10, 0.40]]),
        space=Space(joint=THORAX),
    ),
    # With the forearm bent as elbows bend.
    kinds.ContactConstraint: on_left_wrist(
        location=np.array([0.25, 1.1, 0.35]),
        orientation=multiply(from_vector((0.0, 0.0, -0.7)), from_vector((0.0, -1.05, 0.0))),
    ),
    kinds.CenterOfMassConstraint: {"displacement": np.array([0.03, -0.03, 0.05])},
    kinds.AimConstraint: {
        "joint": token(WALK, "Head"),
        "recruits": (token(WALK, "Neck"), token(WALK, "Head")),
        "goals": (Goal(translation=np.array([3.0, 1.2, 12.0])),),
    },
    kinds.DistanceConstraint: {
        "joint": token(WALK, "LeftHand"),
        "recruits": arm("Left") + arm("Right"),
        "other_joint": token(WALK, "RightHand"),
        "distance": 0.2,
    },
    kinds.RegionConstraint: on_left_wrist(
        region=Region(path="/Ball", margin=0.3, translation=HIPS + np.array([0.4, -0.1, 0.1]))
    ),
}
"""Something that each kind can ask of the walker."""


def others():
    """Return what is asked all the time: feet above it, a wrist and the head below it."""
    wrist = kinds.PositionConstraint(
        path="Wrist",
        skeleton=SKELETON,
        joint=token(WALK, "RightHand"),
        priority=3,
        goals=offset(0.0, 0.1, 0.1),
    )
    head = kinds.OrientationConstraint(
        path="Head", skeleton=SKELETON, joint=token(WALK, "Head"), priority=4
    )
    return [*feet(WALK, priority=1), wrist, head]


def write_cart(stage):
    """Put the cart on the stage, with the contact in its frame."""
    cart = UsdGeom.Xform.Define(stage, CART).AddTranslateOp()
    for frame in (0, -1):
        code = 1.0 + WALK.motion.times[frame] * RATE
        cart.Set(Gf.Vec3d(0.0, 0.0, 100.0 * HIPS[frame, 2]), code)
    contact = stage.GetPrimAtPath(f"{SKELETON}/Edit/It")
    contact.GetRelationship("usdmotion:space").SetTargets([CART])
    stage.Save()


@pytest.fixture
def switched(tmp_path, solve):
    """Return what solves a walk with a constraint that comes and goes."""

    def run(kind, among=(), keys=KEYS):
        activity = ease(WALK.motion.times, keys)
        asked = kind(path="It", skeleton=SKELETON, priority=2, activity=activity, **CASES[kind])
        # Among others it has to recruit all that moves it, as they do (2003, section 3.1).
        asked = replace(asked, recruits=()) if among else asked
        shot = tmp_path / "switched.usda"
        write_walk(shot, WALK, "Edit", [asked, *among])
        if kind is kinds.ContactConstraint:
            write_cart(Usd.Stage.Open(str(shot)))
        return solve(shot, SKELETON)

    return run


def changes(take):
    """Return how much each joint's angular velocity changes at each frame [degrees/s], (F, J)."""
    turns = [take.turn(joint) for joint in take.joints]
    velocities = np.stack([(each[:-1].inv() * each[1:]).as_rotvec() for each in turns], axis=1)
    return RATE * np.degrees(np.linalg.norm(np.diff(velocities, axis=0), axis=2))


def jump(solved, keys=KEYS):
    """Return the largest change of a joint at a boundary, as a share of its largest elsewhere."""
    return most_at_boundary(changes(solved.after), changes(solved.before), keys, least=1.0)


def root_jump(solved, keys=KEYS):
    """Return the same of the root's velocity."""
    after, before = (
        np.linalg.norm(np.diff(take.point("Hips"), 2, axis=0), axis=1)[:, None] * RATE
        for take in (solved.after, solved.before)
    )
    return most_at_boundary(after, before, keys, least=0.01)


def most_at_boundary(after, before, keys, *, least):
    times = np.arange(1, len(after) + 1) / RATE
    boundary = np.abs(times[:, None] - keys).min(axis=1) <= 1.01 / RATE
    elsewhere = np.maximum(after[~boundary].max(axis=0), before.max(axis=0))
    return (after[boundary].max(axis=0) / np.maximum(elsewhere, least)).max()


def assert_it_came(solved):
    (it,) = (each for each in solved.report.edits[0].constraints if each.path.endswith("/It"))
    assert it.met
    moved = max(map(solved.moved, solved.before.joints))
    turned = max(map(solved.turned, solved.before.joints))
    assert moved > 20.0 or turned > 5.0


def test_every_kind_has_a_case():
    assert set(CASES) == set(kinds.built_in())


@pytest.mark.parametrize("kind", CASES, ids=lambda kind: kind.__name__)
def test_a_constraint_alone_comes_and_goes_without_a_jump(switched, kind):
    solved = switched(kind)
    assert_it_came(solved)
    assert jump(solved) <= 2.0
    assert root_jump(solved) <= 2.0


@pytest.mark.parametrize("kind", CASES, ids=lambda kind: kind.__name__)
def test_a_constraint_among_others_comes_and_goes_without_a_jump(switched, kind):
    solved = switched(kind, among=others())
    assert_it_came(solved)
    assert jump(solved) <= 2.0
    assert root_jump(solved) <= 2.0


def test_one_that_is_switched_within_a_frame_jumps(switched):
    assert jump(switched(kinds.PositionConstraint, keys=ABRUPT), ABRUPT) > 4.0


@pytest.mark.parametrize("name", [activation.STACK, *activation.kinds(WALK)])
def test_the_demo_comes_and_goes_without_a_jump(demo, solve, name):
    shot = demo("activation")
    stage = Usd.Stage.Open(str(shot))
    edit = stage.GetPrimAtPath(f"{SKELETON}/{activation.EDIT}")
    edit.GetVariantSet(VARIANTS).SetVariantSelection(name)
    stage.Save()
    own = {activation.STACK: (*activation.GRIP, *activation.FRAMES), "contact": activation.GRIP}
    keys = tuple(map(seconds, own.get(name, activation.FRAMES)))
    solved = solve(shot, SKELETON)
    assert jump(solved, keys) <= 2.0
    assert root_jump(solved, keys) <= 2.0
