"""2004, section 6: the wrist's goal is moved after a first solve, and what it reaches is solved."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from pxr import Sdf, Usd

from usdmotion import Session, host, usd
from usdmotion.arrays import Floats
from usdmotion.demos import gait
from usdmotion.demos.reaching import FRAMES, TARGET
from usdmotion.demos.reaching_again import MOVED
from usdmotion.demos.walker import SKELETON, seconds, token

EDIT = f"{SKELETON}/ReachingAgain"
WRIST, GOAL = f"{EDIT}/LeftWrist", f"{EDIT}/LeftWrist/Reach"
FAR = TARGET + np.array((1.0, 0.5, 0.0))
"""Out of reach."""


@dataclass(frozen=True)
class Answer:
    """A layer that was written, and the stage that shows it."""

    layer: Path
    stage: Path

    def samples(self) -> dict[float, tuple[bytes, bytes]]:
        """Return what is stored of each time."""
        layer = Sdf.Layer.FindOrOpen(str(self.layer))
        path = Sdf.Path(f"{EDIT}_result")
        names = [path.AppendProperty(name) for name in ("translations", "rotations")]
        return {
            code: tuple(np.array(layer.QueryTimeSample(name, code)).tobytes() for name in names)
            for code in layer.ListTimeSamplesForPath(names[0])
        }


@pytest.fixture
def written(tmp_path: Path) -> Callable[[Session, str], Answer]:
    """Return what writes a session's answer and a stage that shows it."""

    def run(session: Session, name: str) -> Answer:
        answer = Answer(tmp_path / f"{name}.usda", tmp_path / f"{name}.shot.usda")
        session.write(answer.layer, compose=answer.stage)
        return answer

    return run


@pytest.fixture
def solved_times(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """Return a list of the time codes that the solver is asked to solve from here on."""
    times: list[float] = []
    kind = host().solver("prioritized_ik")
    solve = kind.solve

    def told(self, problem):
        first = len(problem.known.stops) if problem.known else 0
        times.extend(np.round(1.0 + 24.0 * problem.cast.times[first:], 6))
        return solve(self, problem)

    monkeypatch.setattr(kind, "solve", told)
    return times


def apart(taken, one: Answer, other: Answer) -> tuple[Floats, Floats]:
    """Return how far joints are apart at most, on each frame [mm], [degrees]."""
    codes = np.array(sorted(one.samples()))
    takes = [taken(Usd.Stage.Open(str(each.stage)), SKELETON, codes) for each in (one, other)]
    moved = np.linalg.norm(takes[0].world[..., 3, :3] - takes[1].world[..., 3, :3], axis=-1)
    axes = [take.world[..., :3, :3] for take in takes]
    one_axes, other_axes = (each / np.linalg.norm(each, axis=-1, keepdims=True) for each in axes)
    # The Frobenius norm of the difference of two rotations is √8 sin(θ/2).
    sines = np.linalg.norm(one_axes - other_axes, axis=(-2, -1)) / np.sqrt(8.0)
    return 1e3 * moved.max(axis=1), np.degrees(2.0 * np.arcsin(sines)).max(axis=1)


ARM = ("LeftShoulder", "LeftArm", "LeftForeArm")
CHANGES = {
    "the goal is moved": (GOAL, {"translation": MOVED}),
    "the goal is moved out of reach": (GOAL, {"translation": FAR}),
    "the goal comes later": (GOAL, {"times": tuple(seconds(frame + 20) for frame in FRAMES)}),
    "the goal counts by half": (GOAL, {"activity": 0.5}),
    "the wrist ranks last": (WRIST, {"priority": 9}),
    "the wrist counts for a while": (WRIST, {"times": tuple(map(seconds, (60, 70, 80, 90)))}),
    "the wrist recruits the arm": (
        WRIST,
        {"recruits": [token(gait.walk(), name) for name in ARM]},
    ),
    "the balance is kept by half": (f"{EDIT}/Balance", {"activity": 0.5}),
}


@pytest.mark.parametrize("name", CHANGES)
def test_the_answer_is_that_of_a_solve_from_scratch(
    demo, taken, written, solved_times, tmp_path, name
):
    path, fields = CHANGES[name]
    session, other = (Session.open(demo("reaching_again")) for _ in range(2))
    other.change(path, **fields)
    stage = Usd.Stage.Open(str(demo("reaching_again")))
    usd.author(stage, other.constraint(path).path, other.constraint(path))
    stage.Export(str(tmp_path / "asked.usda"))
    scratch = Session.open(tmp_path / "asked.usda")
    whole, first = written(scratch, "whole"), written(session, "first")

    solved_times.clear()
    # What the stage says, because a goal out of reach lets one last digit turn an arm by a degree.
    change = session.set(scratch.constraint(path))
    tried, again = set(solved_times), written(session, "again")
    millimetres, degrees = apart(taken, again, whole)
    assert millimetres.max() <= 0.01 and degrees.max() <= 0.01
    before, after = first.samples(), again.samples()
    kept = set(before) - set(change.time_codes)
    assert all(before[code] == after[code] for code in kept)
    # To find that they have met, one frame more is looked at.
    assert len(kept & tried) <= 1
    assert set(change.time_codes) <= tried


def test_what_a_moved_goal_reaches_is_little_more_than_it_is_active_on(demo):
    session = Session.open(demo("reaching_again"))
    change = session.change(GOAL, translation=MOVED)
    start, _, _, end = FRAMES
    assert change.time_codes[0] == start + 1.0
    assert end - 1.0 <= change.time_codes[-1] <= end + 12.0


def test_after_any_number_of_drags_the_feet_stand_and_the_wrist_is_there(
    demo, taken, written, tell
):
    session = Session.open(demo("reaching_again"))
    first = written(session, "first")
    for share in np.linspace(0.0, 1.0, 61):
        session.change(GOAL, translation=TARGET + share * (MOVED - TARGET))
    dragged = written(session, "dragged")
    fresh = Session.open(demo("reaching_again"))
    fresh.change(GOAL, translation=MOVED)
    millimetres, degrees = apart(taken, dragged, written(fresh, "fresh"))
    tell(f"reaching again, 61 drags: {millimetres.max():.1e} mm, {degrees.max():.1e} degrees off")
    assert millimetres.max() <= 0.01 and degrees.max() <= 0.01

    codes = np.array(sorted(first.samples()))
    there = (codes >= FRAMES[1]) & (codes <= FRAMES[2])
    before, after = (
        taken(Usd.Stage.Open(str(each.stage)), SKELETON, codes) for each in (first, dragged)
    )
    assert 1e3 * np.linalg.norm(after.point("LeftHand")[there] - MOVED, axis=1).max() <= 0.01
    walking = gait.walk()
    for side in ("Left", "Right"):
        for joint, point in (("Foot", walking.heel_point), ("ToeBase", walking.toe_point)):
            held = after.point(side + joint, point) - before.point(side + joint, point)
            assert 1e3 * np.linalg.norm(held, axis=1).max() <= 0.02


def test_dragging_there_and_back_gives_the_first_answer(demo, taken, written):
    session = Session.open(demo("reaching_again"))
    first = written(session, "first")
    there = session.change(GOAL, translation=FAR)
    back = session.change(GOAL, translation=TARGET)
    again = written(session, "again")
    before, after = first.samples(), again.samples()
    behind = max(there.time_codes[-1], back.time_codes[-1])
    changed = {code for code in before if before[code] != after[code]}
    assert all(FRAMES[3] <= code <= behind for code in changed)
    millimetres, degrees = apart(taken, first, again)
    assert millimetres.max() <= 0.001 and degrees.max() <= 0.001
