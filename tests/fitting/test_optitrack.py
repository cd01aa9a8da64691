"""The walker in a suit with straps: the set of 36 markers."""

import numpy as np
import pytest

from usdmotion.capture import Capture, Markers
from usdmotion.fitting import fit
from usdmotion.kernels import forward, world_points

HEIGHT = 1.7
TRUNK = {
    "Hip1": ("Hips", (0.17, 0.05, 0.0)),
    "Hip2": ("Hips", (-0.17, 0.05, 0.0)),
    "Hip3": ("Hips", (0.02, 0.05, 0.12)),
    "Hip4": ("Hips", (-0.03, 0.05, -0.12)),
    "Chest1": ("Spine2", (0.0, 0.05, -0.12)),
    "Chest2": ("Spine2", (0.06, -0.1, -0.12)),
    "Chest3": ("Spine2", (-0.06, -0.1, -0.12)),
    "Head1": ("Head", (0.0, 0.16, -0.05)),
    "Head2": ("Head", (0.0, 0.13, 0.12)),
    "Head3": ("Head", (-0.09, 0.07, -0.04)),
}


def aside(side, letter, x):
    """Return the markers of an arm and a leg."""
    thumb, little = ("Hand2", "Hand3") if letter == "L" else ("Hand3", "Hand2")
    worn = {
        "Shoulder1": ("Spine2", (0.105 * HEIGHT * x, 0.048 * HEIGHT + 0.06, 0.0)),
        "Shoulder2": ("Spine2", (0.1 * HEIGHT * x, 0.048 * HEIGHT, -0.08)),
        "UArm1": (f"{side}ForeArm", (0.0, 0.0, -0.04)),
        "UArm2": (f"{side}Arm", (0.15 * x, 0.0, -0.05)),
        "Hand1": (f"{side}Hand", (0.08 * x, 0.0, 0.0)),
        thumb: (f"{side}Hand", (0.0, 0.0, 0.04)),
        little: (f"{side}Hand", (0.0, 0.0, -0.04)),
        "Thigh1": (f"{side}UpLeg", (0.0, -0.2, 0.09)),
        "Thigh2": (f"{side}Leg", (0.055 * x, 0.0, 0.0)),
        "Shin1": (f"{side}Leg", (0.0, -0.2, 0.06)),
        "Shin2": (f"{side}Foot", (0.0, 0.0, -0.05)),
        "Foot1": (f"{side}Foot", (-0.04 * x, -0.04, 0.14)),
        "Foot2": (f"{side}Foot", (0.04 * x, -0.04, 0.13)),
    }
    return {letter + name: place for name, place in worn.items()}


@pytest.fixture(scope="module")
def suited(wearer) -> Capture:
    worn = TRUNK | aside("Left", "L", 1.0) | aside("Right", "R", -1.0)
    walk = wearer.walk
    motion = walk.motion
    points, turns = forward(walk.skeleton.parents, motion.translations, motion.rotations)
    places = [
        world_points(points[:, walk.joint(joint)], turns[:, walk.joint(joint)], np.array(place))
        for joint, place in worn.values()
    ]
    positions = np.stack(places, axis=1)
    labels = tuple(f"Somebody_{name}" for name in worn)
    markers = Markers(labels, positions, np.ones(positions.shape[:2], dtype=bool))
    return Capture(
        name="suit", up="Y", frame_rate=50.0, times=wearer.capture.times, markers=markers
    )


def test_joints_are_within_a_strap_of_where_they_were(suited, wearer) -> None:
    recording, (note,) = fit(suited)
    assert "fitted to 36 markers" in note
    motion = recording.motion
    positions, _ = forward(recording.skeleton.parents, motion.translations, motion.rotations)
    names = recording.original_names
    for side in ("Left", "Right"):
        for joint, most in (("UpLeg", 0.06), ("Leg", 0.03), ("Foot", 0.03), ("Hand", 0.02)):
            found = positions[:, names.index(side + joint)]
            off = np.linalg.norm(found - wearer.joint(side + joint), axis=1)
            assert np.median(off) < most, side + joint
        elbow = positions[:, names.index(f"{side}ForeArm")]
        off = np.linalg.norm(elbow - wearer.joint(f"{side}ForeArm"), axis=1)
        assert np.median(off) < 0.03
    head = positions[:, names.index("Head")]
    assert np.median(np.linalg.norm(head - wearer.joint("Head"), axis=1)) < 0.06


def test_the_head_looks_where_its_wearer_goes(suited) -> None:
    recording, _ = fit(suited)
    _, turns = forward(
        recording.skeleton.parents, recording.motion.translations, recording.motion.rotations
    )
    head = recording.original_names.index("Head")
    ahead = world_points(np.zeros((len(turns), 3)), turns[:, head], np.array((0.0, 0.0, 1.0)))
    above = world_points(np.zeros((len(turns), 3)), turns[:, head], np.array((0.0, 1.0, 0.0)))
    assert ahead[:, 2].min() > 0.9
    assert above[:, 1].min() > 0.9
