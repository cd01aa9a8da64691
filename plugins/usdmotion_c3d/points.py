"""Which of the points of a file are markers, and what they are called."""

import re
from collections import Counter
from collections.abc import Sequence

import numpy as np

from usdmotion import Bools, FileError, Floats, Ints
from usdmotion_c3d.trials import Trial

_OUTPUTS = ("ANGLES", "FORCES", "MOMENTS", "POWERS", "SCALARS", "REACTIONS", "MODELLED_MARKERS")
"""Parameters of POINT that list what a model put out."""
_OUTPUT_NAME = re.compile(r"(Angles?|Force|Moment|Power|NormalisedGRF|AbsAnkleAngle)\d*$")
_MADE_UP = re.compile(
    r"(CentreOfMass(Floor)?|CenterOfMass|(Left|Right)(Hip|Knee|Ankle)Cent(er|re))$"
)
_AXES = "OALP"
"""Last letters of the four points by which Plug-in-Gait shows the axes of a segment."""
_MANY = 256
"""A file whose labels are too many for one parameter goes on in LABELS2, LABELS3, …, below this."""


def labels_of(trial: Trial) -> list[str]:
    """Return the label of each point, "" where the file says none."""
    groups = trial.parameters.get("POINT", {})
    names = ["LABELS", *(f"LABELS{number}" for number in range(2, _MANY))]
    labels = trial.texts("POINT", *[name for name in names if name in groups])
    count = trial.points.shape[1]
    return (labels + [""] * count)[:count]


def choose_markers(trial: Trial) -> tuple[Ints, tuple[str, ...], list[str]]:
    """Return which points are markers, their labels, and what there is to say about the others.

    Angles, forces, moments and powers are no points at all; virtual points, such as the axes of
    segments and the centre of mass, are computed; what was never seen is nowhere.

    Raises:
        FileError: There are no markers.
    """
    labels = labels_of(trial)
    listed = {label for name in _OUTPUTS for label in trial.texts("POINT", name)} - {""}
    outputs = [label in listed or bool(_OUTPUT_NAME.search(label)) for label in labels]
    virtual = _virtual(labels)
    never = np.isnan(trial.points[..., 0]).all(axis=0)
    kept = np.flatnonzero(~(np.array(outputs) | virtual | never))
    if not len(kept):
        raise FileError(f"{trial.path}: none of its {len(labels)} points is a marker that was seen")
    counts = {
        "what a model put out (angles, forces, moments, powers)": sum(outputs),
        "virtual points (axes of segments, centres)": int((virtual & ~np.array(outputs)).sum()),
        "points that were never seen": int((never & ~virtual & ~np.array(outputs)).sum()),
    }
    notes = [f"left out: {what}, {count} in all" for what, count in counts.items() if count]
    return kept, _unique([labels[each] for each in kept], notes), notes


def _virtual(labels: Sequence[str]) -> Bools:
    names = set(labels)
    axes = {
        label
        for label in names
        if len(label) >= 4
        and label[-1] in _AXES
        and all(label[:-1] + letter in names for letter in _AXES)
    }
    return np.array([label in axes or bool(_MADE_UP.search(label)) for label in labels], dtype=bool)


def _unique(labels: Sequence[str], notes: list[str]) -> tuple[str, ...]:
    """Return labels made unique by numbers, and names for points that have none."""
    counts: Counter[str] = Counter()
    found: list[str] = []
    for label in labels:
        name = label or "Unlabelled"
        counts[name] += 1
        while (own := name if counts[name] == 1 and label else f"{name}_{counts[name]}") in found:
            counts[name] += 1
        found.append(own)
    twice = sorted(label for label in set(labels) if label and labels.count(label) > 1)
    if twice:
        notes.append(f"labels that stand there more than once are numbered: {', '.join(twice)}")
    if "" in labels:
        notes.append(f"points without a label: {list(labels).count('')}")
    return tuple(found)


def fill_gaps(points: Floats) -> Floats:
    """Return points that stay where they were last seen, and before that where they first are.

    Args:
        points: NaN where they were not seen, shape (frame_count, point_count, 3).
    """
    seen = ~np.isnan(points[..., 0])
    frames = np.arange(len(points))[:, None]
    last = np.maximum.accumulate(np.where(seen, frames, -1), axis=0)
    first = seen.argmax(axis=0)
    source = np.where(last < 0, first, last)
    return np.take_along_axis(points, source[..., None], axis=0)
