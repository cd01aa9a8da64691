"""Forward kinematics straight from the text of a BVH file, knowing nothing of the reader."""

import math
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest

from usdmotion.arrays import Floats
from usdmotion.kernels import forward, world_points
from usdmotion.recording import Recording


@dataclass
class NaiveJoint:
    parent: int
    name: str = ""
    offset: tuple[float, ...] = (0.0, 0.0, 0.0)
    channels: list[str] = field(default_factory=list)


@dataclass
class NaiveClip:
    """End Sites are joints without channels here."""

    joints: list[NaiveJoint]
    rows: list[list[float]]

    def positions(self, frame: int, relative: bool) -> list[Floats]:
        numbers = iter(self.rows[frame])
        worlds: list[Floats] = []
        for joint in self.joints:
            turn, place = np.eye(4), list(joint.offset)
            for channel in joint.channels:
                axis, number = "XYZ".index(channel[0]), next(numbers)
                if channel.endswith("rotation"):
                    turn = turn @ turn_about(axis, math.radians(number))
                else:
                    place[axis] = number + (joint.offset[axis] if relative else 0.0)
            local = np.eye(4)
            local[:3, 3] = place
            above = worlds[joint.parent] if joint.parent >= 0 else np.eye(4)
            worlds.append(above @ local @ turn)
        return [world[:3, 3] for world in worlds]


def turn_about(axis: int, angle: float) -> Floats:
    turn = np.eye(4)
    a, b = (axis + 1) % 3, (axis + 2) % 3
    turn[a, a] = turn[b, b] = math.cos(angle)
    turn[b, a], turn[a, b] = math.sin(angle), -math.sin(angle)
    return turn


def naive_clip(path: Path) -> NaiveClip:
    text = path.read_text(encoding="latin-1")
    head, body = re.split(r"^MOTION\s*$", text, maxsplit=1, flags=re.MULTILINE)
    joints: list[NaiveJoint] = []
    stack = [-1]
    for line in head.splitlines():
        words = line.split()
        if words[:1] in (["ROOT"], ["JOINT"], ["End"]):
            joints.append(NaiveJoint(stack[-1], "" if words[0] == "End" else " ".join(words[1:])))
        elif words == ["{"]:
            stack.append(len(joints) - 1)
        elif words == ["}"]:
            stack.pop()
        elif words[:1] == ["OFFSET"]:
            joints[stack[-1]].offset = tuple(map(float, words[1:4]))
        elif words[:1] == ["CHANNELS"]:
            joints[stack[-1]].channels = words[2:]
    # One of the files has numbers without a space between them: 0.0-7.5.
    body = re.sub(r"(?<=\d)-", " -", body)
    rows = [line.split() for line in body.splitlines() if line.strip() and "Frame" not in line]
    return NaiveClip(joints, [list(map(float, row)) for row in rows])


CMU = 0.0254 / 0.45
GOOD = {
    # folder or file: metres per unit, up, root relative to OFFSET
    "cmu/mb/*": (CMU, "Y", False),
    "cmu/daz/*": (0.01, "Y", False),
    "cmu/daz_hands/*": (0.01, "Y", False),
    "cmu/iclone/*": (0.01, "Y", True),
    "other/fair_*": (0.0254, "Z", False),
    "other/rokoko*": (0.01, "Y", False),
    "other/mocapbank*": (0.01, "Y", False),
    "other/mixamorig*": (0.01, "Y", False),
    "odd/bvh/frames_250*": (CMU, "Z", False),
    "odd/bvh/makehuman*": (0.1, "Z", False),
    "odd/bvh/mixed_orders*": (0.0254, "Z", False),
    "odd/bvh/xsens*": (0.01, "Y", False),
    "odd/bvh/rotation_first*": (0.01, "Y", False),
    "odd/bvh/full_precision*": (0.01, "Y", False),
    "odd/bvh/reproductions/animated*": (0.01, "Y", False),
    "odd/bvh/reproductions/ganimator*": (0.01, "Y", False),
}


@dataclass
class Family:
    """Captured clips that were all written by one program."""

    paths: list[Path]
    metres: float
    """Metres per unit."""
    up: str
    relative: bool
    """Whether the root's positions are added to its OFFSET."""


@pytest.fixture(scope="session")
def families(mocap: Path) -> list[Family]:
    """Return every captured clip that is read without a question."""
    return [Family(sorted(mocap.glob(f"{pattern}.bvh")), *facts) for pattern, facts in GOOD.items()]


@pytest.fixture(params=range(len(GOOD)), ids=list(GOOD))
def family(request: pytest.FixtureRequest, families: list[Family]) -> Family:
    """Return one family of captured clips."""
    return families[request.param]


@pytest.fixture(scope="session")
def text_places() -> Callable[..., tuple[int, list[Floats]]]:
    """Return what says how many frames a text has, and where its joints are on some of them [m]."""

    def places(
        path: Path, metres: float, *, relative: bool, frames: Iterable[int] | None = None
    ) -> tuple[int, list[Floats]]:
        clip = naive_clip(path)
        named = [bool(joint.name) for joint in clip.joints]
        count = len(clip.rows)
        found = [
            metres * np.array(clip.positions(frame, relative))[named]
            for frame in (range(count) if frames is None else frames)
        ]
        return count, found

    return places


@pytest.fixture(scope="session")
def farthest_off() -> Callable[..., float]:
    """Return the check of a recording against the text, for joints and tips.

    It gives the largest distance between the two, as a part of the height of the body.
    """

    def compare(
        recording: Recording, path: Path, metres: float, *, relative: bool, frames: Iterable[int]
    ) -> float:
        clip = naive_clip(path)
        named = [bool(joint.name) for joint in clip.joints]
        motion, skeleton = recording.motion, recording.skeleton
        assert [joint.name for joint in clip.joints if joint.name] == list(recording.original_names)
        assert len(clip.rows) == motion.frame_count
        places, turns = forward(skeleton.parents, motion.translations, motion.rotations)
        tips = recording.tip_joints
        ends = world_points(places[:, tips], turns[:, tips], recording.tip_points)
        worst = size = 0.0
        for frame in frames:
            wanted = metres * np.array(clip.positions(frame, relative))
            size = max(size, float(np.ptp(wanted, axis=0).max()))
            found = np.empty_like(wanted)
            found[named], found[~np.array(named)] = places[frame], ends[frame]
            worst = max(worst, float(np.linalg.norm(found - wanted, axis=1).max()))
        return worst / (size or 1.0)

    return compare
