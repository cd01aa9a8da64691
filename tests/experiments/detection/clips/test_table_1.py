"""2006, table 1: frames, templates, contacts and costs, ours beside the published ones."""

from collections.abc import Callable
from time import perf_counter

import numpy as np
from rich.console import Console
from rich.table import Table
from usdmotion_contacts.displacements import displacements
from usdmotion_contacts.instants import at_rest
from usdmotion_contacts.pattern import pattern_of, taught
from usdmotion_contacts.places import places
from usdmotion_contacts.projection import project

PUBLISHED = {
    "walking around (8.2)": (400, 2, 27, 13.1, 18.1, 2.8),
    "ladder (8.3)": (300, 4, 23, 9.6, 13.7, 2.2),
    "hands only (8.4)": (380, 2, 19, 12.4, 25.7, 2.9),
}
"""Frames, templates, contacts; displacements, noise pattern and detection of one object [ms]."""


def least(call: Callable[[], object]) -> float:
    """Return the shortest of some runs [ms]."""
    runs = []
    for _ in range(5):
        start = perf_counter()
        call()
        runs.append(1e3 * (perf_counter() - start))
    return min(runs)


def costs(example) -> tuple[float, float, float]:
    """Return what the three parts take for one object with one template [ms]."""
    search = example.search
    points = project(displacements(search))
    pattern = pattern_of(taught(search, points)[0], None)
    resting = at_rest(search, points, pattern)
    return (
        least(lambda: project(displacements(search))),
        least(lambda: pattern_of(taught(search, points)[0], None)),
        least(lambda: places(search, points.displacements, resting, pattern)),
    )


def test_it_is_printed_with_ours_beside_it(walking_around, ladder, hands, tell) -> None:
    table = Table("motion", "", "frames", "templates", "contacts", *("ms",) * 3, "total [ms]")
    for (name, published), examples in zip(
        PUBLISHED.items(), (walking_around, ladder, hands), strict=True
    ):
        mean = np.mean([costs(each) for each in examples], axis=0)
        frames = len(examples[0].search.times)
        contacts = sum(len(each.contacts) for each in examples)
        ours = (frames, len(examples), contacts, *mean)
        for who, row in (("published", published), ("ours", ours)):
            whole, parts = [f"{number:g}" for number in row[:3]], [f"{ms:.2f}" for ms in row[3:]]
            table.add_row(name, who, *whole, *parts, f"{sum(row[3:]):.2f}")
        # As many contacts as steps, not one a frame: within a factor of three of the paper's.
        each_second = contacts / len(examples) / examples[0].search.times[-1]
        assert 0.1 < each_second < 3.0
    console = Console(width=120)
    with console.capture() as captured:
        console.print(table)
    print(captured.get())
    tell(captured.get())
