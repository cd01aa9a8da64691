"""Our solver beside mink, pink and placo on one clip, in environments of their own.

    python tests/benchmarks/compare.py [--small]

Makes the environments at the first time, in the user's cache folder, with pip. Nothing here passes
or fails. Everything runs on one thread, in turns, and a ratio is the median over the rounds.
"""

import os
import sys
import tempfile
from contextlib import ExitStack
from pathlib import Path

for _library in ("OPENBLAS", "MKL", "OMP"):
    os.environ.setdefault(f"{_library}_NUM_THREADS", "1")

from comparison import rounds, tables  # noqa: E402
from comparison.contestants import CONTESTANTS  # noqa: E402
from comparison.exchange import export  # noqa: E402
from reaching import OUT_OF_REACH, WITHIN_REACH, character, reaching, unlimited  # noqa: E402
from rich.console import Console  # noqa: E402

from usdmotion.arrays import Floats  # noqa: E402
from usdmotion.demos.gait import Walk, walk  # noqa: E402
from usdmotion.plugins import host  # noqa: E402

NAMES = ("LeftHeel", "LeftBall", "RightHeel", "RightBall", "LeftWrist", "CenterOfMass")
TOLERANCE = 1e-3
"""What every task is met to [m]."""
RULES = {
    "tolerance": TOLERANCE,
    "still": 1e-3,
    "limit": 60,
    "reach": 0.1,
    "turn": 0.3,
    "look_first": False,
}
TOLD = """\
They leave a frame when every task is within 1 mm, when a step turned no joint by more than 0.001
rad, or after 60 steps. Each frame starts from its input posture with the displacement of the frame
before. Targets farther than 0.1 m are approached in steps, and no joint turns by more than 0.3 rad
in one. No joint has limits. Ours runs with its default options: until nothing varies, and with the
finish; its step is the time of the clip by its iterations. What counts is all from the first
frame's posture and targets to the last frame's pose, with setting targets and looking at errors;
not loading, nor computing targets, nor measuring what is left, which our own kinematics does for
everybody."""


def tasks(walking: Walk, folder: Path) -> list[rounds.Task]:
    """Return the clips and the rules to solve them by, written where runners read them."""

    def task(title: str, offset: Floats, settings: str, **rules: object) -> rounds.Task:
        place, problem = folder / settings, reaching(walking, offset)
        export(problem, character(walking), NAMES, place)
        return rounds.Task(title, problem, place, RULES | rules, settings)

    frames = f"{walking.motion.frame_count} frames"
    return [
        task(
            f"Within reach, {frames}; the others make a step on each at least",
            WITHIN_REACH,
            "within_reach",
        ),
        task(
            f"Within reach, {frames}; nobody makes a step where all is obeyed from the start",
            WITHIN_REACH,
            "within_reach",
            look_first=True,
        ),
        task(f"Out of reach, {frames}", OUT_OF_REACH, "out_of_reach"),
    ]


def main(small: bool) -> None:
    """Let everybody run, and print the tables."""
    console = Console(width=140)
    ours = rounds.Ours(host().solver("prioritized_ik")())
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        clips = tasks(unlimited(walk(1.0 if small else 6.0)), folder)
        others = list(rounds.start(CONTESTANTS, stack))
        console.print(tables.given([each.contestant for each in others], clips))
        for versions in dict.fromkeys(each.runner.versions for each in others):
            console.print(versions)
        console.print(TOLD.replace("\n", " "))
        for each in clips:
            standings = rounds.compete(each, ours, others, 2 if small else 7)
            console.print(tables.standings(each, standings))


if __name__ == "__main__":
    main("--small" in sys.argv)
