"""What was given, and what came out, as tables."""

from collections.abc import Sequence

import numpy as np
from rich.table import Table

from comparison.contestants import Contestant, Settings
from comparison.exchange import errors, turned
from comparison.rounds import Standing, Task

MILLIMETRES = 1e3


def given(contestants: Sequence[Contestant], tasks: Sequence[Task]) -> Table:
    """Return what each library was given."""
    table = Table(title="What each was given; costs are of feet, wrist, centre of mass")
    for column in ("who", "tasks", *dict.fromkeys(task.settings for task in tasks)):
        table.add_column(column.replace("_", " "), overflow="fold")
    for each in contestants:
        ways = (getattr(each, way) for way in dict.fromkeys(task.settings for task in tasks))
        table.add_row(each.name, each.tasks, *map(_told, ways))
    return table


def _told(settings: Settings) -> str:
    return "\n".join(f"{name} {value}" for name, value in settings.items() if name != "hard")


def standings(task: Task, ranked: Sequence[Standing]) -> Table:
    """Return how everybody did; errors are measured by our own kinematics."""
    table = Table(title=task.title)
    table.add_column("who")
    columns = ("a step", "steps a frame", "clip", "of our time", "aim")
    for column in (*columns, "feet", "wrist", "CoM", "turned"):
        table.add_column(column, justify="right")
    for each in ranked:
        last = each.runs[-1]
        left = errors(task.problem, last.answer).max(axis=0) * MILLIMETRES
        table.add_row(
            each.name,
            f"{each.step * 1e6:.1f} µs",
            f"{np.mean(last.steps):.2f}",
            f"{each.seconds * 1e3:.2f} ms",
            f"{each.ratio:.1f} ×",
            f"≥ {each.aim:g} ×" if each.aim else "",
            f"{left[:-2].max():.4f} mm",
            f"{left[-2]:.3f} mm",
            f"{left[-1]:.3f} mm",
            f"{turned(task.problem, last.answer).mean():.2f}°",
        )
    return table
