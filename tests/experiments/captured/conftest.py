"""Captured clips as stages, and what the experiments ask for on bodies that they never saw.

Nothing is fitted to a clip. Joints are found by the humanoid map, lengths are shares of the body's
height, and of each clip the three seconds are taken around the moment at which a foot is highest:
kicks and leaps are in there, and whatever else a clip does there.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd

from usdmotion import pipeline
from usdmotion.anthropometry import with_masses
from usdmotion.arrays import Bools, Floats
from usdmotion.constraints import Constraint, PositionConstraint
from usdmotion.humanoid import PartMap, guess
from usdmotion.kernels import conjugate, forward, rotate
from usdmotion.motion import Body
from usdmotion.recording import Recording

RATE = 30.0
"""Samples per second."""
SECONDS = 3.0
"""How much of a clip is solved."""
LEG = 0.491
"""From hip to ankle, as a share of the height (Drillis & Contini 1966)."""
RISE, THERE = 16, 8
"""Frames in which a goal is approached, and those for which it is held."""
STANDS_AT, STANDS_FOR = 0.25, 0.2
"""A foot slower than so many heights a second, for so many seconds, stands; it swings with 3."""

CLIPS = {
    "walk": ("cmu/daz/08_01_trimmed.bvh", {}),
    "kicks": ("cmu/daz/135_04.bvh", {"skip": 8}),
    "kata": ("cmu/daz/135_03.bvh", {"skip": 8}),
    "dance": ("cmu/iclone/005_06.bvh", {}),
    "dance-turning": ("cmu/iclone/005_19.bvh", {}),
    "brisk-walk": ("cmu/iclone/007_12.bvh", {"skip": 1}),
    "rokoko-dance": ("other/rokoko_jesse_dance.bvh", {}),
    "crouch": ("other/mocapbank_crouch.bvh", {}),
    "turns": ("other/mixamorig_turns.bvh", {}),
    "zombie": ("other/fair_zombie.bvh", {}),
    "jumping": ("other/fair_jumping.bvh", {}),
    "dab": ("other/fair_dab.bvh", {}),
}
"""Each clip, and what its reader says has to be left out of it."""
QUICK = ("walk", "kicks")
"""Those that every run looks at."""


@dataclass(frozen=True, eq=False)
class Captured:
    """Three seconds of an imported clip."""

    shot: Path
    skeleton: str
    recording: Recording
    take: object
    """What a `Take` says of them."""

    @cached_property
    def parts(self) -> PartMap:
        return guess(self.recording.skeleton)

    @cached_property
    def body(self) -> Body:
        nothing = Body.unknown(len(self.recording.skeleton.joints))
        body, _ = with_masses(self.recording.skeleton, nothing, self.parts)
        return body

    @property
    def seconds(self) -> Floats:
        """When the frames are, from the first one on."""
        return (self.take.times - self.take.times[0]) / RATE

    @property
    def frames(self) -> tuple[float, float]:
        """First and last time code."""
        return float(self.take.times[0]), float(self.take.times[-1])

    def token(self, part: str) -> str:
        return self.recording.skeleton.joints[self._joint(part)]

    def _joint(self, part: str) -> int:
        joint = self.parts.joint(part)
        assert joint is not None, part
        return joint

    @cached_property
    def thorax(self) -> str:
        """The topmost joint of the back."""
        return self.recording.skeleton.joints[self.parts.spine[-1]]

    def chain(self, end: str, top: str) -> tuple[str, ...]:
        """Return the joints from one part up to another."""
        skeleton = self.recording.skeleton
        chain = skeleton.chain(self._joint(end))
        return tuple(skeleton.joints[j] for j in chain[: chain.index(self._joint(top)) + 1])

    @cached_property
    def height(self) -> float:
        """Of the body [m], by the length of its legs."""
        return sum(self.length(a, b) for a, b in (("hip", "knee"), ("knee", "talocrural"))) / LEG

    def length(self, upper: str, lower: str, side: str = "l") -> float:
        """Return the distance between two parts of one side in the rest pose [m]."""
        apart = self.at_rest(f"{side}_{upper}") - self.at_rest(f"{side}_{lower}")
        return float(np.linalg.norm(apart))

    @property
    def arm(self) -> float:
        """Length of an arm from shoulder to wrist [m]."""
        return self.length("shoulder", "elbow") + self.length("elbow", "radiocarpal")

    @cached_property
    def _rest(self) -> tuple[Floats, Floats]:
        skeleton = self.recording.skeleton
        rest = skeleton.rest_translations[None], skeleton.rest_rotations[None]
        places, turns = forward(skeleton.parents, *rest)
        return places[0], turns[0]

    def at_rest(self, part: str) -> Floats:
        """Return where a part is in the rest pose [m]."""
        return self._rest[0][self._joint(part)]

    def in_rest_of(self, joint: str, place: Floats) -> Floats:
        """Return a place of the rest pose in the frame of a joint [m]."""
        places, turns = self._rest
        index = self.recording.skeleton.index[joint]
        return rotate(conjugate(turns[index]), place - places[index])

    def rest_way(self, left: float, up: float, ahead: float) -> Floats:
        """Return a way as the body at rest would call it, in the world."""
        apart = self.at_rest("l_hip") - self.at_rest("r_hip")
        apart -= (apart @ self.up) * self.up
        side = apart / np.linalg.norm(apart)
        return left * side + up * self.up + ahead * np.cross(side, self.up)

    @property
    def up(self) -> Floats:
        """The direction away from the ground."""
        return np.eye(3)[{"Y": 1, "Z": 2}[self.recording.up]]

    @property
    def ground_axes(self) -> str:
        """The axes along the ground."""
        return "".join(axis for axis, up in zip("xyz", self.up, strict=True) if not up)

    def ahead(self, frame: int) -> Floats:
        """Return where the pelvis faces on a frame, along the ground; its left is up × ahead."""
        apart = self.take.point(self.token("l_hip")) - self.take.point(self.token("r_hip"))
        faced = np.cross(apart[frame], self.up)
        return faced / np.linalg.norm(faced)

    def ball(self, side: str) -> Floats:
        """Return where the ball or the end of a foot is, in the frame of its ankle [m]."""
        skeleton, ankle = self.recording.skeleton, self._joint(f"{side}_talocrural")
        toes = self.parts.joint(f"{side}_metatarsophalangeal")
        if toes is not None:
            chain = skeleton.chain(toes)
            return skeleton.rest_translations[list(chain[: chain.index(ankle)])].sum(axis=0)
        tips = self.recording.tip_points[self.recording.tip_joints == ankle]
        return tips[0] if len(tips) else -0.1 * self.height * self.up

    def soles(self, side: str) -> tuple[tuple[str, Floats], ...]:
        """Return two points that hold a foot: its ankle and its ball."""
        ankle = self.token(f"{side}_talocrural")
        return (ankle, np.zeros(3)), (ankle, self.ball(side))

    def feet(self, *, priority: int, sides: str = "lr") -> list[PositionConstraint]:
        """Return the constraints that keep feet on their trajectories."""
        return [
            PositionConstraint(
                path=f"{side}_{name}", skeleton=self.skeleton, joint=joint, point=point,
                priority=priority,
            )
            for side in sides
            for name, (joint, point) in zip(("ankle", "ball"), self.soles(side), strict=True)
        ]  # fmt: skip

    def stances(self, side: str) -> list[tuple[int, int]]:
        """Return the first and the last frame of each time in which a foot stands.

        It does where its ankle and its ball are slow for long enough.
        """
        slow = np.ones(len(self.take.times), dtype=np.bool_)
        for sole in self.soles(side):
            speed = np.linalg.norm(np.gradient(self.take.point(*sole), axis=0), axis=1)
            slow &= speed * RATE < STANDS_AT * self.height
        edges = np.flatnonzero(np.diff(np.concatenate([[False], slow, [False]])))
        pairs = edges.reshape(-1, 2)
        return [(int(a), int(b) - 1) for a, b in pairs if b - a >= STANDS_FOR * RATE]

    def calm(self, part: str) -> int:
        """Return the frame around which a joint moves least while a goal would hold it."""
        places, margin = self.take.point(self.token(part)), THERE // 2 + RISE
        frames = range(margin, len(places) - margin)
        around = [places[frame - THERE // 2 : frame + THERE // 2 + 1] for frame in frames]
        return margin + int(np.argmin([np.ptp(each, axis=0).max() for each in around]))

    def keys(self, frame: int, *, there: int = THERE) -> tuple[float, ...]:
        """Return four key times around a frame [s]: 40 frames, as in the paper's reaching."""
        plateau = np.array([frame - there // 2, frame + (there + 1) // 2])
        return tuple(np.array([plateau[0] - RISE, *plateau, plateau[1] + RISE]) / RATE)

    def within(self, keys: Sequence[float]) -> Bools:
        """Return which frames are on the plateau of four key times."""
        return (self.seconds >= keys[1] - 1e-6) & (self.seconds <= keys[2] + 1e-6)


@pytest.fixture(scope="session")
def imported(mocap: Path, tmp_path_factory: pytest.TempPathFactory, taken):
    """Return what imports a clip, once."""
    done: dict[str, Captured] = {}

    def run(name: str) -> Captured:
        if name not in done:
            path, options = CLIPS[name]
            shot = tmp_path_factory.mktemp(name) / f"{name}.usda"
            recording = pipeline.import_motion(mocap / path, shot, fps=RATE, options=options)
            skeleton = f"/{recording.name}/Skeleton"
            stage = Usd.Stage.Open(str(shot))
            codes = np.arange(stage.GetStartTimeCode(), stage.GetEndTimeCode() + 0.5)
            done[name] = _cut(Captured(shot, skeleton, recording, taken(stage, skeleton, codes)))
        return done[name]

    return run


def _cut(clip: Captured) -> Captured:
    """Return the three seconds around the moment at which an ankle is highest."""
    ankles = [clip.take.point(clip.token(f"{side}_talocrural")) @ clip.up for side in "lr"]
    highest = int(np.argmax(np.max(ankles, axis=0)))
    count = min(int(SECONDS * RATE), len(clip.take.times))
    start = int(np.clip(highest - count // 2, 0, len(clip.take.times) - count))
    take = clip.take.part(slice(start, start + count))
    return Captured(clip.shot, clip.skeleton, clip.recording, take)


@pytest.fixture(
    scope="session",
    params=[pytest.param(name, marks=() if name in QUICK else pytest.mark.slow) for name in CLIPS],
)
def clip(request: pytest.FixtureRequest, imported) -> Captured:
    """Return each clip in turn; a test may choose by `indirect`."""
    return imported(request.param)


@pytest.fixture(scope="session")
def ask(asked, solve):
    """Return what asks something of a clip, solves it, and holds the answer to what holds always.

    Joints that nothing recruits equal the input, and the knees of the sides that are said turn
    faster than the input's fastest by two degrees a frame at most.
    """

    def run(clip: Captured, constraints: Sequence[Constraint], *, knees="lr", **options):
        shot = asked(clip.shot, clip.skeleton, constraints, clip.take.times)
        solved = solve(shot, clip.skeleton, frames=clip.frames, **options)
        mends = "mend_recruiting" in options
        moves = set(solved.before.joints) if mends else _recruited(clip, constraints)
        still = np.array([joint not in moves for joint in solved.before.joints])
        assert np.array_equal(solved.after.local[:, still], solved.before.local[:, still])
        pops = {side: solved.pops(clip.token(f"{side}_knee")) for side in "lr"}
        assert all(pops[side] <= 2.0 for side in knees), pops
        return solved

    return run


def _recruited(clip: Captured, constraints: Sequence[Constraint]) -> set[str]:
    """Return the joints that some constraint may move: those it names, or all up to the root."""
    skeleton, moves = clip.recording.skeleton, set()
    for each in constraints:
        if each.recruits:
            moves |= set(each.recruits)
        elif not each.joint:
            moves |= set(skeleton.joints)
        else:
            moves |= {skeleton.joints[j] for j in skeleton.chain(skeleton.index[each.joint])}
    return moves
