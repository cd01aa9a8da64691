"""Figures: how long things take, beside something that runs next to them on the same machine.

    python tests/benchmarks/figures.py [--small]

Nothing here passes or fails. A figure is a ratio measured in one run, times are only told.
"""

import os
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

for _library in ("OPENBLAS", "MKL", "OMP"):
    os.environ.setdefault(f"{_library}_NUM_THREADS", "1")

import numpy as np  # noqa: E402
from pxr import Sdf, Usd, Vt  # noqa: E402
from rich.console import Console  # noqa: E402
from rich.table import Table  # noqa: E402

from usdmotion import Character, Edit, Motion, Placement, Problem, Scene, usd  # noqa: E402
from usdmotion.constraints import (  # noqa: E402
    CenterOfMassConstraint,
    Constraint,
    Goal,
    PositionConstraint,
)
from usdmotion.demos.gait import Walk, walk  # noqa: E402
from usdmotion.demos.walker import FIRST, RATE, SKELETON, feet, token  # noqa: E402
from usdmotion.options import configured  # noqa: E402
from usdmotion.plugins import host  # noqa: E402

AIM_OF_AN_ITERATION = 10e-6 / 97e-3
"""Ten microseconds where forty products of two 400 × 400 matrices take 97 ms."""


@dataclass(frozen=True)
class Figure:
    """One line of the table."""

    what: str
    seconds: float
    beside: str
    yardstick: float
    aim: float
    """Largest ratio that is aimed at."""

    @property
    def ratio(self) -> float:
        return self.seconds / self.yardstick


def least(call: Callable[[], object], times: int = 5) -> float:
    """Return the shortest of some runs, after one that warms up [s]."""
    call()
    runs = []
    for _ in range(times):
        start = perf_counter()
        call()
        runs.append(perf_counter() - start)
    return min(runs)


def products() -> float:
    """Return how long forty products of two 400 × 400 matrices take on one thread [s]."""
    a, b = np.random.default_rng(0).normal(size=(2, 400, 400))
    return least(lambda: [a @ b for _ in range(40)])


def reaching(walking: Walk, outward: float) -> Problem:
    """Return feet (12 rows), a wrist (3) and the centre of mass (3) over all joints."""
    last = float(walking.motion.times[-1])
    middle = tuple(last * share for share in (0.4, 0.5, 0.55, 0.65))
    goal = Goal(mode="offset", translation=np.array([outward, 0.1, 0.1]), times=middle)
    planted = feet(walking, priority=1)
    constraints: list[Constraint] = [
        *planted,
        PositionConstraint(
            path="Wrist",
            skeleton=SKELETON,
            joint=token(walking, "LeftHand"),
            priority=2,
            goals=(goal,),
        ),
        CenterOfMassConstraint(
            path="Balance",
            skeleton=SKELETON,
            priority=3,
            supports=tuple(each.joint for each in planted),
        ),
    ]
    frames = walking.motion.frame_count
    character = Character(
        SKELETON, walking.skeleton, walking.body, walking.motion, Placement.identity(frames), 0
    )
    edit = Edit(f"{SKELETON}/Edit", SKELETON, tuple(constraints))
    return Problem.of(Scene((character,), (edit,), np.arange(frames), np.array([0.0, 1.0, 0.0])))


def solving(small: bool) -> list[Figure]:
    """Return the figures of the solver, on one core."""
    kind = host().solver("prioritized_ik")
    solver, restless = kind(), configured(kind, {"posture_change": 0.0, "finish": 0})
    walking = walk(1.0 if small else 6.0)
    seconds = float(walking.motion.times[-1])
    near, far = reaching(walking, 0.15), reaching(walking, 1.2)
    spent = int(restless.solve(near).iterations.sum())
    iteration = least(lambda: restless.solve(near)) / spent
    clip, conflict = (least(lambda each=each: solver.solve(each)) for each in (near, far))
    long = walk(10.0 if small else 360.0)
    hour = reaching(long, 0.15)
    frames = f"{long.motion.frame_count} frames of {long.motion.times[-1]:g} s"
    matrices = "40 products of 400 × 400 matrices"
    return [
        Figure("one iteration, 69 × 18", iteration, matrices, products(), AIM_OF_AN_ITERATION),
        Figure("reaching, the clip", clip, "the clip's own length", seconds, 1 / 600),
        Figure(
            "the same, out of reach",
            conflict,
            "0.2 ms a frame",
            2e-4 * walking.motion.frame_count,
            1.0,
        ),
        Figure(
            f"reaching, {frames}",
            least(lambda: solver.solve(hour), 1),
            "its own length",
            float(long.motion.times[-1]),
            10 / 3600,
        ),
    ]


def bare_write(path: Path, joints: list[str], codes: list[float], arrays: list[np.ndarray]) -> None:
    """Write a SkelAnimation by the fastest honest calls of USD."""
    layer = Sdf.Layer.CreateAnonymous(".usdc")
    stage = Usd.Stage.Open(layer)
    prim = stage.DefinePrim("/Animation", "SkelAnimation")
    prim.GetAttribute("joints").Set(joints)
    prim.GetAttribute("scales").Set(Vt.Vec3hArray.FromNumpy(np.ones((len(joints), 3), np.half)))
    names = ("/Animation.translations", "/Animation.rotations")
    prim.CreateAttribute("translations", Sdf.ValueTypeNames.Float3Array, custom=False)
    prim.CreateAttribute("rotations", Sdf.ValueTypeNames.QuatfArray, custom=False)
    with Sdf.ChangeBlock():
        for frame, code in enumerate(codes):
            layer.SetTimeSample(names[0], code, Vt.Vec3fArray.FromNumpy(arrays[0][frame]))
            layer.SetTimeSample(names[1], code, Vt.QuatfArray.FromNumpy(arrays[1][frame]))
    layer.Export(str(path))


def bare_read(path: Path, animation: str) -> None:
    """Read the samples of a SkelAnimation by the fastest honest calls of USD."""
    stage = Usd.Stage.Open(Sdf.Layer.OpenAsAnonymous(str(path)))
    prim = stage.GetPrimAtPath(animation)
    for name in ("translations", "rotations", "scales"):
        query = Usd.AttributeQuery(prim.GetAttribute(name))
        times = query.GetTimeSamples() or [Usd.TimeCode.Default()]
        np.array([np.asarray(query.Get(time)) for time in times])


def stages(small: bool, folder: Path) -> list[Figure]:
    """Return the figures of reading and writing 10,000 frames of 31 joints."""
    count = 200 if small else 10_000
    walking = walk(1.0)
    shot = folder / "long.usdc"
    random = np.random.default_rng(1)
    joints = len(walking.skeleton.joints)
    times = np.arange(count) / RATE
    codes = FIRST + np.arange(count)
    pick = np.arange(count) % walking.motion.frame_count
    translations = walking.motion.translations[pick] + random.normal(size=(count, joints, 3)) * 1e-3
    motion = Motion(times, translations, walking.motion.rotations[pick])
    with usd.new_stage(
        shot, frame_rate=RATE, first=FIRST, last=float(codes[-1]), root="Walker"
    ) as stage:
        usd.author_character(
            stage, "/Walker", walking.skeleton, walking.body, motion, time_codes=codes
        )
        usd.author_edit(stage, f"{SKELETON}/Edit")
    kinds = host().constraints
    read = usd.read(shot, kinds=kinds)
    result = usd.Result(f"{SKELETON}/Edit", read.scenes[0].characters[0].motion, "none", {})
    arrays = [motion.translations.astype(np.float32), motion.rotations.astype(np.float32)]
    tokens = list(walking.skeleton.joints)
    what = f"{count} frames of {joints} joints"
    return [
        Figure(
            f"reading {what}",
            least(lambda: usd.read(shot, kinds=kinds)),
            "bare USD calls",
            least(lambda: bare_read(shot, "/Walker/Animation")),
            1.3,
        ),
        Figure(
            f"writing {what}",
            least(lambda: usd.write(read, [result], folder / "out.usdc")),
            "bare USD calls",
            least(lambda: bare_write(folder / "bare.usdc", tokens, codes.tolist(), arrays)),
            1.3,
        ),
    ]


def table(figures: list[Figure]) -> Table:
    """Return the figures as a table."""
    drawn = Table("what", "took", "beside", "which took", "ratio", "aim")
    for each in figures:
        drawn.add_row(
            each.what,
            f"{each.seconds * 1e3:.4g} ms",
            each.beside,
            f"{each.yardstick * 1e3:.4g} ms",
            f"{each.ratio:.3g}",
            f"≤ {each.aim:.3g}",
        )
    return drawn


def main(small: bool) -> list[Figure]:
    """Measure everything and print the table."""
    with tempfile.TemporaryDirectory() as folder:
        figures = [*solving(small), *stages(small, Path(folder))]
    Console(width=140).print(table(figures))
    return figures


if __name__ == "__main__":
    main("--small" in sys.argv)
