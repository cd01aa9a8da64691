"""Captured limbs of which force plates say when they touched something, and how answers are judged.

A frame is judged only where the truth is known: on a plate, in the swing beside it, and of the
parkour where its authors vouch for it.
"""

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from usdmotion_contacts import ContactDetector

from usdmotion import Detector, Search, Template
from usdmotion.arrays import Bools, Floats

SWING = 0.3
"""For how long before and after a stance a walker's foot is in the air at least [s]."""
FEWEST = 3
"""A stance of fewer frames is no template."""
FAR = 0.5
"""How far an outlier is from where it should be [m]."""
MARKERS = {
    "PiG_Motion-FlatFoot-Full.c3d": ("{}TOE", "{}HEE", "{}ANK"),
    "PiG_Motion-FlatFoot-One.c3d": ("{}TOE", "{}HEE", "{}ANK"),
    "PiG_Motion3_FF.c3d": ("{}TOE", "{}HEE", "{}ANK"),
    "FunctionalWalk.c3d": ("{}TOE", "{}HEE", "{}ANK"),
    "sub_labels.c3d": ("Matt:{}TOE", "Matt:{}ANK", "Matt:{}KNE"),
    "PlugInC3D.c3d": ("{}TOE", "{}HEE", "{}ANK"),
    "OMCS_exampleOverground.c3d": ("{}TOE", "{}HEE", "{}ANK"),
    "ADemo1_rewrite_c3d_pc_float.c3d": ("{}.Toe", "{}.Heel", "{}.Ankle"),
    "Gait.c3d": ("{}TOE", "{}HEE", "{}ANK"),
}
"""Three markers of a foot: its origin, where its first axis goes, what spans the plane with it.

BTS.c3d is left out: it has two on a foot, which are no frame.
"""
KINDS = ("space", "line", "point")
LIMBS = {
    "l_ankle": ("l_toes", "l_ankle", "l_knee"),
    "r_ankle": ("r_toes", "r_ankle", "r_knee"),
    "l_fingers": ("l_fingers", "l_wrist", "l_elbow"),
    "r_fingers": ("r_fingers", "r_wrist", "r_elbow"),
}
"""Three joints of a limb, by the force that is measured at it."""


@dataclass(frozen=True, eq=False)
class Limb:
    """A foot or a hand of a captured clip, with the truth about it."""

    name: str
    clip: str
    times: Floats
    """[s], (F,)."""
    places: Floats
    """Of the three points that its frame is built from [m], (F, 3, 3)."""
    held: Bools
    """Whether a plate felt it, (F,)."""
    known: Bools
    """Whether that is the truth, (F,)."""

    @cached_property
    def search(self) -> Search:
        """The limb as an object with a frame."""
        rotations = Rotation.from_matrix(_axes(self.places)).as_quat()
        return Search(
            name=self.name,
            times=self.times,
            translations=self.places[:, 0],
            rotations=rotations,
            points=_points(self.places),
            up=np.array([0.0, 0.0, 1.0]),
        )

    @property
    def stances(self) -> tuple[Template, ...]:
        """When it is held, as templates, without what is not known."""
        edges = np.diff(np.pad((self.held & self.known).astype(np.int8), 1))
        pairs = zip(np.flatnonzero(edges > 0), np.flatnonzero(edges < 0) - 1, strict=True)
        return tuple(
            Template("space", float(self.times[first]), float(self.times[last]))
            for first, last in pairs
            if last - first + 1 >= FEWEST
        )

    @property
    def longest(self) -> tuple[Template, ...]:
        """Its longest stance, if it has any."""
        return tuple(sorted(self.stances, key=lambda each: each.start - each.end)[:1])

    def judge(self, said: Bools) -> "Score":
        """Compare an answer, (F,), with the truth where that is known."""
        known, held = self.known, self.held
        counts = (known, known & held & said, known & ~held & said, known & held & ~said)
        return Score(*(int(each.sum()) for each in counts))

    def thinned(self, rate: float) -> "Limb":
        """Return every n-th frame of it, so that there are about so many a second."""
        part = slice(None, None, max(1, round(1.0 / (self.times[1] - self.times[0]) / rate)))
        return replace(
            self,
            times=self.times[part],
            places=self.places[part],
            held=self.held[part],
            known=self.known[part],
        )

    def noisy(self, spread: float, share: float = 0.0, *, seed: int = 0) -> "Limb":
        """Return it with errors of its points that have nothing to do with each other.

        Args:
            spread: Standard deviation along each axis [m].
            share: Part of the frames on which the whole limb is somewhere else.
            seed: Of the errors.
        """
        chance = np.random.default_rng([seed, *self.name.encode()])
        places = self.places + chance.normal(0.0, 1.0, self.places.shape) * spread
        away = chance.random(len(places)) < share
        offsets = chance.normal(0.0, 1.0, (len(places), 1, 3))
        offsets *= FAR / np.linalg.norm(offsets, axis=2, keepdims=True)
        return replace(self, places=places + away[:, None, None] * offsets)


def _axes(places: Floats) -> Floats:
    """Return the axes of frames through three points as columns, (F, 3, 3) to (F, 3, 3)."""
    first = places[:, 1] - places[:, 0]
    normal = np.cross(first, places[:, 2] - places[:, 0])
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    return np.stack([first, np.cross(normal, first), normal], axis=2)


def _points(places: Floats) -> Floats:
    """Return the origin and the next of the three points in the frame of the limb, (2, 3)."""
    length = float(np.median(np.linalg.norm(places[:, 1] - places[:, 0], axis=1)))
    return np.array([[0.0, 0.0, 0.0], [length, 0.0, 0.0]])


@dataclass(frozen=True)
class Score:
    """How often an answer is right, over the frames of which the truth is known."""

    judged: int
    hit: int
    """Held, and said so."""
    invented: int
    missed: int

    @property
    def wrong(self) -> int:
        """Mislabelled frames."""
        return self.invented + self.missed

    @property
    def f1(self) -> float:
        """Harmonic mean of precision and recall; 1 where nothing is held and nothing said."""
        return 2 * self.hit / (2 * self.hit + self.wrong) if self.hit + self.wrong else 1.0

    @property
    def share(self) -> float:
        """Mislabelled frames among those that are judged."""
        return self.wrong / self.judged

    def __add__(self, other: "Score") -> "Score":
        return Score(
            self.judged + other.judged,
            self.hit + other.hit,
            self.invented + other.invented,
            self.missed + other.missed,
        )


def _walks(mocap: Path) -> list[Limb]:
    """Return the feet that stepped on force plates, one for each stance or run of stances."""
    trials = json.loads((mocap / "contacts/c3d_contacts.json").read_text())
    return [
        limb
        for trial in trials
        if trial["file"] in MARKERS
        for side in "LR"
        for limb in _walk(mocap / "c3d" / trial["file"], side, trial["plate_contacts"])
    ]


def _walk(path: Path, side: str, contacts: Sequence[dict]) -> list[Limb]:
    import ezc3d

    mine = [each for each in contacts if each["foot"] == side]
    if not mine:
        return []
    file = ezc3d.c3d(str(path))
    labels = file["parameters"]["POINT"]["LABELS"]["value"]
    rows = [labels.index(each.format(side)) for each in MARKERS[path.name]]
    places = file["data"]["points"][:3, rows].transpose(2, 1, 0) * 1e-3
    times = np.arange(len(places)) / file["header"]["points"]["frame_rate"]
    held = np.any([_within(times, each) for each in mine], axis=0)
    near = np.any([_within(times, each, SWING) for each in mine], axis=0)
    doubt = [_within(times, each) for each in contacts if each["foot"] is None]
    known = near & ~np.any([np.zeros(len(times), dtype=bool), *doubt], axis=0)
    limbs = []
    for first, end in _whole(places):
        part = slice(first, end)
        if (held & known)[part].any():
            name = f"{path.stem}_{side}_{first}"
            limb = (times[part] - times[first], places[part], held[part], known[part])
            limbs.append(Limb(name, path.stem, *limb))
    return limbs


def _within(times: Floats, stance: dict, more: float = 0.0) -> Bools:
    return (times >= stance["start"] - more) & (times <= stance["end"] + more)


def _whole(places: Floats) -> list[tuple[int, int]]:
    """Return the stretches of frames on which all markers were seen."""
    seen = np.isfinite(places).all(axis=(1, 2))
    edges = np.diff(np.pad(seen.astype(np.int8), 1))
    return list(zip(np.flatnonzero(edges > 0), np.flatnonzero(edges < 0), strict=True))


def _parkour(mocap: Path, part: str) -> list[Limb]:
    """Return the feet ("ankle") or hands ("fingers") of the parkour whose forces were measured."""
    limbs = []
    for path in sorted((mocap / "contacts/parkour").glob("*.npz")):
        clip = np.load(path)
        joints, forces = list(clip["joint_names"]), list(clip["force_names"])
        for force, named in LIMBS.items():
            column = forces.index(force)
            if part in force:
                places = clip["positions"][:, [joints.index(each) for each in named]]
                times = np.arange(len(places)) / float(clip["fps"])
                truth = clip["contact"][:, column], clip["valid"][:, column]
                name = f"{path.stem}_{force}"
                limbs.append(Limb(name, path.stem, times, places.astype(float), *truth))
    return limbs


@pytest.fixture(scope="session")
def limbs(mocap: Path) -> dict[str, list[Limb]]:
    """Return the limbs by where their truth is from."""
    return {
        "force plates": _walks(mocap),
        "parkour, feet": _parkour(mocap, "ankle"),
        "parkour, hands": _parkour(mocap, "fingers"),
    }


Answer = Callable[..., Bools]


@pytest.fixture(scope="session")
def said() -> Answer:
    """Return what says of each frame of a limb whether it touches something, (F,).

    It does while any contact is found: a foot that rolls over its heel is one that turns about a
    line.
    """

    def say(limb: Limb, *, detector: Detector | None = None, **fields: object) -> Bools:
        fields = {"kinds": KINDS, **fields} if detector is None else fields
        found = (detector or ContactDetector()).detect(replace(limb.search, **fields))
        spans = [(limb.times >= each.start) & (limb.times <= each.end) for each in found.contacts]
        return np.any([np.zeros(len(limb.times), dtype=bool), *spans], axis=0)

    return say
