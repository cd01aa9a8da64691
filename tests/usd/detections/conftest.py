"""A stage on which it is known when what stands still, and a detector that finds just that."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest
from pxr import Usd

from usdmotion import Contact, Detected, NoisePattern, Search, Spline, option, pipeline, searching
from usdmotion.plugins import Host, Plugin
from usdmotion.quality import runs
from usdmotion.report.contacts import DetectionReport

FOOT = "hips/foot"
STANDS = ((1, 6), (11, 16), (21, 24))
"""Time codes between which the foot stands still."""
RISES = 3.0
"""How high it is in between, in stage units."""


@dataclass(frozen=True)
class Still:
    """Finds where the origin of an object does not move at all."""

    name: ClassVar[str] = "contacts"
    slack: float = option(1e-6, "How far it may move in a step [m].", minimum=0.0)
    seen: ClassVar[list[Search]] = []

    def detect(self, search: Search) -> Detected:
        self.seen.append(search)
        steps = np.linalg.norm(np.diff(search.translations, axis=0), axis=1)
        contacts = []
        for first, end in runs(steps <= self.slack):
            middle = (first + end) // 2
            contacts.append(
                Contact(
                    kind=search.kinds[0],
                    start=float(search.times[first]),
                    end=float(search.times[end]),
                    point=np.array([0.0, 0.0, 0.5]),
                    location=search.translations[middle] + 0.5 * ahead(search.rotations[middle]),
                    orientation=search.rotations[middle],
                    axis=np.array([0.0, 1.0, 0.0]),
                    residual=0.001,
                )
            )
        kept = [each for each in contacts if each.end - each.start >= search.minimum]
        ends = search.times[[0, -1]]
        estimate = NoisePattern(
            Spline.through(ends, np.array([0.1, 0.2])), Spline.through(ends, np.array([0.01, 0.02]))
        )
        return Detected(tuple(kept), search.pattern or estimate)


def ahead(rotation: np.ndarray) -> np.ndarray:
    from usdmotion.kernels import rotate

    return np.asarray(rotate(rotation, np.array([0.0, 0.0, 1.0])))


@dataclass(frozen=True)
class Loose:
    """The same under another name, without options."""

    name: ClassVar[str] = "loose"

    def detect(self, search: Search) -> Detected:
        return Still().detect(search)


@pytest.fixture
def still(monkeypatch: pytest.MonkeyPatch) -> type[Still]:
    """Let nothing but our own detectors look."""
    Still.seen.clear()
    known = Host((Plugin("still", "", "still", detectors=(Still, Loose)),))
    monkeypatch.setattr(searching, "host", lambda: known)
    return Still


def course(stands: tuple[tuple[int, int], ...] = STANDS, last: int = 24) -> np.ndarray:
    """Return where the foot is at every time code from 1 on, (time_code_count, 3)."""
    places = np.zeros((last, 3))
    for code in range(1, last + 1):
        done = sum(end < code for _, end in stands)
        stands_now = any(start <= code <= end for start, end in stands)
        lift = 0.0 if stands_now else RISES
        ahead = 0.0 if stands_now else 0.37 * (code % 5)
        places[code - 1] = (1.0, 2.0 + lift, 10.0 * done + ahead)
    return places


def animation(places: np.ndarray) -> str:
    """Return the body of a SkelAnimation of hips, foot and hand; only the foot moves."""
    rows = ",\n".join(
        f"{index + 1}: [(0, 0, 0), {tuple(place.tolist())}, (0, 7, 0)]"
        for index, place in enumerate(places)
    )
    return f"""
        uniform token[] joints = ["hips", "{FOOT}", "hips/hand"]
        float3[] translations.timeSamples = {{ {rows} }}
        quatf[] rotations = [(1, 0, 0, 0), (1, 0, 0, 0), (1, 0, 0, 0)]
        half3[] scales = [(1, 1, 1), (1, 1, 1), (1, 1, 1)]
    """


HEADER = 'metersPerUnit = 1\nupAxis = "Y"\nstartTimeCode = 1\nendTimeCode = 24'


@pytest.fixture
def shot(tmp_path: Path) -> Callable[..., Path]:
    """Return what writes a stage with one skeleton whose foot stands still three times."""

    def write(
        name: str = "shot.usda",
        *,
        header: str = HEADER,
        root: str = "",
        skeleton: str = "",
        more: str = "",
        places: np.ndarray | None = None,
    ) -> Path:
        at = "( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1) )"
        path = tmp_path / name
        path.write_text(f"""#usda 1.0
(
{header}
)
def SkelRoot "Man" {{
    {root}
    def Skeleton "Bones" (prepend apiSchemas = ["SkelBindingAPI", "MotionSkeletonAPI"]) {{
        uniform token[] joints = ["hips", "{FOOT}", "hips/hand"]
        uniform matrix4d[] restTransforms = [{at}, {at}, {at}]
        uniform matrix4d[] bindTransforms = [{at}, {at}, {at}]
        uniform token[] usdmotion:parts = ["humanoid_root", "l_talocrural", "l_radiocarpal"]
        rel skel:animationSource = </Man/Walk>
        {skeleton}
    }}
    def SkelAnimation "Walk" {{ {animation(course() if places is None else places)} }}
}}
{more}
""")
        return path

    return write


@pytest.fixture
def detect(still: type[Still], tmp_path: Path) -> Callable[..., DetectionReport]:
    """Return what looks at a shot and writes `out.usda`, or another file."""

    def run(shot: Path, output: str = "out.usda", **asked: object) -> DetectionReport:
        return pipeline.detect(shot, tmp_path / output, **asked)

    return run


@pytest.fixture
def over(tmp_path: Path) -> Callable[..., Path]:
    """Return what writes a layer over another that says something more."""

    def write(beneath: str, body: str, name: str = "person.usda", offset: str = "") -> Path:
        path = tmp_path / name
        path.write_text(f"#usda 1.0\n(\n{HEADER}\nsubLayers = [@./{beneath}@ {offset}]\n)\n{body}")
        return path

    return write


@pytest.fixture
def opened(tmp_path: Path) -> Callable[..., Usd.Stage]:
    """Return what opens a stage that was written."""
    stages = []  # prims live as long as their stage

    def read(name: str = "out.usda") -> Usd.Stage:
        stages.append(Usd.Stage.Open(str(tmp_path / name)))
        return stages[-1]

    return read


@pytest.fixture(scope="session")
def steps() -> type:
    """Return what is known of the stage."""

    class Steps:
        foot, stands, rises = FOOT, STANDS, RISES
        edit = "/Man/Bones/Contacts"
        detection = f"{edit}/foot"
        header = HEADER
        places = staticmethod(course)
        animation = staticmethod(animation)

    return Steps
