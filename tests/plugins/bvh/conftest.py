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
    rows = [line.split() for line in body.splitlines() if line.strip() and "Frame" not in line]
    return NaiveClip(joints, [list(map(float, row)) for row in rows])


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
