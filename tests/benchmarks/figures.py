"""Figures: how long things take, beside something that runs next to them on the same machine.

    python tests/benchmarks/figures.py [--small]

Nothing here passes or fails. A figure is a ratio measured in one run, times are only told.
"""

import os
import sys
import tempfile
from pathlib import Path
from time import perf_counter

for _library in ("OPENBLAS", "MKL", "OMP"):
    os.environ.setdefault(f"{_library}_NUM_THREADS", "1")

import crowds  # noqa: E402
import detecting  # noqa: E402
import numpy as np  # noqa: E402
from measuring import Figure, least, products  # noqa: E402
from pxr import Sdf, Usd, Vt  # noqa: E402
from reaching import (  # noqa: E402
    OUT_OF_REACH,
    WITHIN_REACH,
    dragged,
    four_levels,
    reaching,
    reaching_for,
    twelve_points,
    unlimited,
)
from rich.console import Console  # noqa: E402
from rich.table import Table  # noqa: E402

from usdmotion import Motion, Problem, usd  # noqa: E402
from usdmotion.arrays import Floats  # noqa: E402
from usdmotion.demos.gait import Walk, walk  # noqa: E402
from usdmotion.demos.walker import FIRST, RATE, SKELETON  # noqa: E402
from usdmotion.options import configured  # noqa: E402
from usdmotion.plugins import host  # noqa: E402
from usdmotion.solved import SolvedScene  # noqa: E402

AIM_OF_AN_ITERATION = 10e-6 / 97e-3
"""Ten microseconds where forty products of two 400 × 400 matrices take 97 ms."""

THE_WALK_OF_2006 = 34e-3
"""What the paper's walk took with one template on a Pentium 4 (2006, table 1) [s]."""


def solving(small: bool) -> list[Figure]:
    """Return the figures of the solver, on one core."""
    solver = host().solver("prioritized_ik")()
    walking = walk(1.0 if small else 6.0)
    seconds, frames = float(walking.motion.times[-1]), walking.motion.frame_count
    near, far = reaching(walking), reaching(walking, OUT_OF_REACH)
    events = 3 if small else 12
    return [
        *iterations(walking),
        Figure(
            f"reaching, {frames} frames",
            least(lambda: solver.solve(near)),
            "the clip's own length",
            seconds,
            1 / 600,
        ),
        Figure(
            "the same, out of reach",
            least(lambda: solver.solve(far)),
            "0.2 ms a frame",
            2e-4 * frames,
            1.0,
        ),
        hour(10.0 if small else 3600.0),
        drags(6.0, 40, WITHIN_REACH, "", events),
        drags(6.0, 60, WITHIN_REACH, "", events),
        drags(6.0, 60, OUT_OF_REACH, ", out of reach", events),
        drags(10.0 if small else 3600.0, 60, WITHIN_REACH, "", events),
    ]


def iterations(walking: Walk) -> list[Figure]:
    """Return what one iteration takes, of frames that are left at the limit of iterations only."""
    kind = host().solver("prioritized_ik")
    restless = configured(kind, {"posture_change": 0.0, "finish": 0})
    yardstick = products()

    def figure(what: str, problem: Problem, aim: float) -> Figure:
        spent = int(restless.solve(problem).iterations.sum())
        once = least(lambda: restless.solve(problem)) / spent
        matrices = "40 products of 400 × 400 matrices"
        return Figure(f"one iteration, {what}, 4 levels", once, matrices, yardstick, aim)

    free = unlimited(walking)
    return [
        figure("72 × 18", four_levels(free), AIM_OF_AN_ITERATION),
        figure("72 × 18 with joint limits", four_levels(walking), 2.0 * AIM_OF_AN_ITERATION),
        figure("72 × 36", twelve_points(free), 2.0 * AIM_OF_AN_ITERATION),
    ]


def hour(seconds: float) -> Figure:
    """Return what so long a walk takes."""
    walking = walk(seconds)
    problem, solver = reaching(walking), host().solver("prioritized_ik")()
    what = f"reaching, {walking.motion.frame_count} frames of {seconds:g} s"
    return Figure(
        what, least(lambda: solver.solve(problem), 1), "its own length", seconds, 10 / 3600
    )


def drags(seconds: float, frames: int, offset: Floats, what: str, events: int) -> Figure:
    """Return what the drag of one goal takes, in the middle of some, from the event to poses."""
    walking = walk(seconds)
    solved = SolvedScene(reaching_for(walking, offset, frames), host().solver("prioritized_ik")())
    ways = np.random.default_rng(0).normal(scale=0.02, size=(events, 3))

    def drag(way: Floats) -> float:
        start = perf_counter()
        reached = solved.become(dragged(solved.scene, offset + way))
        solved.motion(SKELETON, reached)
        return perf_counter() - start

    _, *took = map(drag, ways)
    count = walking.motion.frame_count
    what = f"drag of a goal, {frames} of {count} frames{what}"
    return Figure(what, sorted(took)[len(took) // 2], "a frame at 60 Hz", 1 / 60, 0.016 * 60)


def detection(small: bool) -> list[Figure]:
    """Return the figures of the detector, on one core."""
    frames, joints = (400, 2) if small else (10_000, 31)
    detector = host().detector("contacts")()
    foot, every = detecting.toes(400), detecting.searches(frames, joints)
    return [
        Figure(
            "contacts, 400 frames, one object, one template",
            least(lambda: detector.detect(foot), 20),
            "the walk of 400 frames in 2006",
            THE_WALK_OF_2006,
            1e-3 / THE_WALK_OF_2006,
        ),
        Figure(
            f"contacts, {frames} frames of {joints} joints",
            least(lambda: [detector.detect(each) for each in every]),
            "40 products of 400 × 400 matrices",
            products(),
            0.2 / 97e-3,
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
        figures = [
            *solving(small),
            *crowds.figures(small),
            *detection(small),
            *stages(small, Path(folder)),
        ]
    Console(width=140).print(table(figures))
    return figures


if __name__ == "__main__":
    main("--small" in sys.argv)
