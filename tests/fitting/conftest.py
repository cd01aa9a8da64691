"""Someone who walks with markers on, of whom every joint is known."""

from dataclasses import dataclass

import numpy as np
import pytest

from usdmotion.arrays import Floats
from usdmotion.capture import Capture, Markers
from usdmotion.demos.gait import Walk, walk
from usdmotion.kernels import forward, world_points

RATE = 50.0
HEIGHT = 1.7
SIDES = (("Left", "L", 1.0), ("Right", "R", -1.0))


@dataclass(frozen=True, eq=False)
class Wearer:
    """A walk, and the markers glued on whoever walks."""

    walk: Walk
    capture: Capture
    points: Floats
    """World positions of the joints [m], shape (frame_count, joint_count, 3)."""

    def joint(self, name: str) -> Floats:
        return self.points[:, self.walk.joint(name)]


def pelvis_marks() -> dict[str, tuple[str, tuple[float, float, float]]]:
    """Return markers of which Harrington's equations give the hip joints of the walker."""
    width = (0.05 * HEIGHT - 0.0073) / 0.33
    depth = 0.16
    ahead = 0.24 * depth + 0.0099
    above = 0.30 * width + 0.0109 - 0.025 * HEIGHT
    return {
        "LASI": ("Hips", (0.5 * width, above, ahead)),
        "RASI": ("Hips", (-0.5 * width, above, ahead)),
        "LPSI": ("Hips", (0.04, above, ahead - depth)),
        "RPSI": ("Hips", (-0.04, above, ahead - depth)),
    }


def leg_marks(
    side: str, letter: str, x: float
) -> dict[str, tuple[str, tuple[float, float, float]]]:
    shank = 0.246 * HEIGHT
    between = shank / np.sqrt(1.0 - (0.13 - 0.09) ** 2)
    knee, ankle = 0.13 * between, 0.09 * between
    return {
        f"{letter}THI": (f"{side}UpLeg", (0.1 * x, -0.2, 0.0)),
        f"{letter}KNE": (f"{side}Leg", (knee * x, 0.0, 0.0)),
        f"{letter}TIB": (f"{side}Leg", (0.08 * x, -0.2, 0.0)),
        f"{letter}ANK": (f"{side}Foot", (ankle * x, 0.0, 0.0)),
        f"{letter}HEE": (f"{side}Foot", (0.0, -0.04, -0.06)),
        f"{letter}TOE": (f"{side}Foot", (0.0, -0.04, 0.12)),
    }


def arm_marks(
    side: str, letter: str, x: float
) -> dict[str, tuple[str, tuple[float, float, float]]]:
    elbow = 0.5 * 0.19 * 0.246 * HEIGHT
    drop = 0.17 * 2.0 * 0.105 * HEIGHT
    reach = 0.105 * HEIGHT * x
    return {
        f"{letter}SHO": ("Spine2", (reach, (0.818 - 0.770) * HEIGHT + drop, 0.0)),
        f"{letter}ELB": (f"{side}ForeArm", (0.0, elbow, 0.0)),
        f"{letter}WRA": (f"{side}Hand", (0.0, 0.0, 0.035)),
        f"{letter}WRB": (f"{side}Hand", (0.0, 0.0, -0.035)),
        f"{letter}FIN": (f"{side}Hand", (0.08 * x, 0.0, 0.0)),
    }


def trunk_marks() -> dict[str, tuple[str, tuple[float, float, float]]]:
    neck = (0.840 - 0.770) * HEIGHT
    skull, head = 0.45 * 0.19, 0.095
    return {
        "C7": ("Spine2", (0.0, neck, -0.06)),
        "CLAV": ("Spine2", (0.0, neck, 0.06)),
        "T10": ("Spine2", (0.0, neck - 0.2, -0.1)),
        "STRN": ("Spine2", (0.0, neck - 0.2, 0.1)),
        "LFHD": ("Head", (0.07, skull, head)),
        "RFHD": ("Head", (-0.07, skull, head)),
        "LBHD": ("Head", (0.07, skull, -head)),
        "RBHD": ("Head", (-0.07, skull, -head)),
    }


@pytest.fixture(scope="module")
def wearer() -> Wearer:
    """Return the walker of the demos in a full set of markers, for two seconds."""
    walked = walk(2.0, RATE, height=HEIGHT)
    motion = walked.motion
    points, turns = forward(walked.skeleton.parents, motion.translations, motion.rotations)
    worn = pelvis_marks() | trunk_marks()
    for side in SIDES:
        worn |= leg_marks(*side) | arm_marks(*side)
    positions = np.stack(
        [
            world_points(
                points[:, walked.joint(joint)], turns[:, walked.joint(joint)], np.array(place)
            )
            for joint, place in worn.values()
        ],
        axis=1,
    )
    markers = Markers(tuple(worn), positions, np.ones(positions.shape[:2], dtype=bool))
    capture = Capture(name="walk", up="Y", frame_rate=RATE, times=motion.times, markers=markers)
    return Wearer(walked, capture, points)
