"""How many characters can be stepped at 30 frames a second, beside what could be done in 2005."""

from dataclasses import dataclass
from time import perf_counter

import numpy as np
from measuring import Figure

from usdmotion import (
    Character,
    Edit,
    Goal,
    Live,
    Placement,
    PositionConstraint,
    Problem,
    Scene,
    cue,
)
from usdmotion.constraints import CenterOfMassConstraint, Constraint
from usdmotion.demos.gait import Walk, walk
from usdmotion.humanoid import PartMap
from usdmotion.options import configured
from usdmotion.plugins import host

FRAME = 1.0 / 30.0
"""How long a frame lasts [s]."""


@dataclass(frozen=True)
class Asking:
    """What is asked of each of a crowd."""

    name: str
    within: bool
    """Whether the wrists can be where they are to be."""
    balanced: bool
    """Whether feet and balance rank above them."""
    then: int
    """How many like these there were at 30 Hz in 2005."""
    most: int = 1000
    """How many are stepped at most."""


ASKINGS = (
    Asking("targets within reach", True, True, 8),
    Asking("wrists out of reach", False, False, 22),
    Asking("out of reach, in balance", False, True, 22, most=100),
)
NOW = 1000
"""How many are aimed at on two cores."""
FRAMES = 10
"""How many frames are stepped through."""
_TRUNK = ("Spine", "Spine1", "Spine2")
_ARM = ("Shoulder", "Arm", "ForeArm", "Hand")
_LEG = ("UpLeg", "Leg", "Foot")


def figures(small: bool) -> list[Figure]:
    """Return what one frame of one character takes, and of more and more."""
    counts = (1, 10) if small else (1, 10, 100, 1000)
    measured = []
    for asking in ASKINGS:
        once = step(crowd(1, asking), 1)
        share = "a core's share of 1,000 on two cores, 30 Hz"
        measured.append(
            Figure(f"ccd, a frame of one, {asking.name}", once, share, 2 * FRAME / NOW, 1)
        )
        for count in counts[1:]:
            if count > asking.most:
                continue
            asked = crowd(count, asking)
            then = f"{asking.then} a frame at 30 Hz in 2005"
            yardstick = FRAME * count / asking.then
            for threads in (1, 2):
                name = f"ccd, a frame of {count:,}, {asking.name}, {threads} at a time"
                aim = asking.then / NOW * 2 / threads
                measured.append(Figure(name, step(asked, threads), then, yardstick, aim))
    return measured


def step(problem: Problem, threads: int) -> float:
    """Return what a step of a performance takes on average [s]."""
    solver = configured(host().solver("ccd"), {"threads": threads})
    assert isinstance(solver, Live)
    performance = solver.start(problem)
    rounds = []
    for _ in range(2):
        took = 0.0
        for frame in range(problem.cast.frame_count):
            cue(performance, problem, frame)
            start = perf_counter()
            performance.step()
            took += perf_counter() - start
        rounds.append(took / problem.cast.frame_count)
    return min(rounds)


def crowd(count: int, asking: Asking) -> Problem:
    """Return walkers in rows, who are asked for both wrists, and feet and balance above them."""
    walking = walk((FRAMES - 1) * FRAME, 1.0 / FRAME)
    characters, edits, parts = [], [], PartMap(walking.parts)
    for index in range(count):
        path = f"/Walker{index}/Skeleton"
        aside = np.tile((2.0 * (index % 32), 0.0, 3.0 * (index // 32)), (FRAMES, 1))
        place = Placement(aside, Placement.identity(FRAMES).rotations)
        characters.append(
            Character(path, walking.skeleton, walking.body, walking.motion, place, 0, parts=parts)
        )
        edits.append(Edit(f"{path}/Edit", path, tuple(_asked(walking, path, asking))))
    codes = np.arange(float(FRAMES))
    return Problem.of(Scene(tuple(characters), tuple(edits), codes, np.array([0.0, 1.0, 0.0])))


def _asked(walking: Walk, path: str, asking: Asking) -> list[Constraint]:
    """Return feet (1), the balance (2), and the wrists (3), which recruit the trunk."""

    def hold(name: str, recruits: tuple[str, ...], *goals: Goal, priority: int) -> Constraint:
        return PositionConstraint(
            path=f"{path}/Edit/{name}",
            skeleton=path,
            joint=_token(walking, name),
            recruits=tuple(_token(walking, each) for each in recruits),
            goals=goals,
            priority=priority,
        )

    away = np.array((0.05, 0.08, 0.12) if asking.within else (0.5, 0.5, 3.0))
    asked = []
    for side, sign in (("Left", 1.0), ("Right", -1.0)):
        leg, arm = (tuple(f"{side}{each}" for each in limb) for limb in (_LEG, _ARM))
        goal = Goal(mode="offset", translation=away * (sign, 1.0, 1.0))
        if asking.balanced:
            asked.append(hold(f"{side}Foot", ("Hips", *leg), priority=1))
        asked.append(hold(f"{side}Hand", (*_TRUNK, *arm), goal, priority=3))
    if not asking.balanced:
        return asked
    balance = CenterOfMassConstraint(
        path=f"{path}/Edit/Balance", skeleton=path, priority=2, axes="xz"
    )
    return [*asked, balance]


def _token(walking: Walk, name: str) -> str:
    return walking.skeleton.joints[walking.joint(name)]
