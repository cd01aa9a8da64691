"""The paper's examples on captured clips: what is looked at, and templates that nobody tuned.

A template is the rest of a limb that is neither long nor short among all of its rests. The longest
would be the wrong choice where somebody stands still before he begins: that part of a motion hardly
has noise (2006, section 8.6).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd
from scipy.spatial.transform import Rotation
from usdmotion_contacts import ContactDetector

from usdmotion import Contact, Detected, Search, Template, pipeline, usd
from usdmotion.arrays import Bools, Floats
from usdmotion.asking import Asked

SLOW, OVER, LEAST = 0.1, 0.1, 0.25
"""What rests: slower than that share of its fast speed, over so many seconds, for so many."""
MINIMUM = 0.1
"""Shorter contacts are dropped [s]: a limb that turns back is at rest for a moment."""
TOES = ("l_metatarsophalangeal", "r_metatarsophalangeal")
LIMBS = ("l_talocrural", "r_talocrural", "l_radiocarpal", "r_radiocarpal")


@dataclass(frozen=True, eq=False)
class Example:
    """A limb, with a template chosen by the rule above, and what was detected with it."""

    search: Search
    found: Detected

    @property
    def contacts(self) -> tuple[Contact, ...]:
        return self.found.contacts

    def held(self) -> Bools:
        """Return which frames are in a contact."""
        return within(self.search.times, [(each.start, each.end) for each in self.contacts])

    def rests_found(self) -> float:
        """Return the share of the rests that are a contact for at least half of their time."""
        held = self.held()
        spans = [within(self.search.times, [each]) for each in rests(self.search)]
        return float(np.mean([held[each].mean() > 0.5 for each in spans]))

    @property
    def speeds(self) -> Floats:
        return _speeds(self.search)


def within(times: Floats, spans: list[tuple[float, float]]) -> Bools:
    """Return which times are in one of some intervals."""
    inside = np.zeros(len(times), dtype=np.bool_)
    for start, end in spans:
        inside |= (times >= start - 1e-6) & (times <= end + 1e-6)
    return inside


def rests(search: Search) -> list[tuple[float, float]]:
    """Return the times in which a limb is slow for a while [s]."""
    speeds = _speeds(search)
    slow = speeds < SLOW * np.quantile(speeds, 0.9)
    edges = np.diff(np.pad(slow.astype(np.int8), 1))
    spans = zip(np.flatnonzero(edges > 0), np.flatnonzero(edges < 0) - 1, strict=True)
    times = [(float(search.times[a]), float(search.times[b])) for a, b in spans]
    return [(start, end) for start, end in times if end - start >= LEAST]


def _speeds(search: Search) -> Floats:
    """Return how fast a limb is over `OVER` seconds [m/s]."""
    frames = np.arange(len(search.times))
    half = max(1, round(0.5 * OVER / float(np.median(np.diff(search.times)))))
    before, after = np.maximum(frames - half, 0), np.minimum(frames + half, len(frames) - 1)
    way = np.linalg.norm(search.translations[after] - search.translations[before], axis=1)
    return way / (search.times[after] - search.times[before])


def template(search: Search) -> Template:
    """Return the rest of middling length."""
    spans = sorted(rests(search), key=lambda span: span[1] - span[0])
    return Template("space", *spans[len(spans) // 2])


def detected(search: Search) -> Example:
    """Return what is detected with that template."""
    search = replace(search, templates=(template(search),), minimum=MINIMUM)
    return Example(search, ContactDetector().detect(search))


@pytest.fixture(scope="session")
def read(mocap: Path, tmp_path_factory: pytest.TempPathFactory) -> Callable[..., list[Search]]:
    """Return what imports a clip, and reads some joints of the stage as searches."""

    def run(clip: str, joints: tuple[str, ...], *, skip: int = 0) -> list[Search]:
        shot = tmp_path_factory.mktemp("clip") / "shot.usda"
        pipeline.import_motion(mocap / clip, shot, options={"skip": skip})
        stage = Usd.Stage.Open(str(shot))
        return [each.search for each in usd.read_searches(stage, Asked(joints=joints))]

    return run


@pytest.fixture(scope="session")
def walking_around(read) -> list[Example]:
    """Return the toes of somebody who walks around, as in section 8.2.

    Of the CMU clips one goes around, iclone/006_10, in six steps of each foot, on which toes slide
    by two centimetres. This one is of about as many steps as the paper's.
    """
    return [detected(each) for each in read("other/fair_zombie.bvh", TOES)]


@pytest.fixture(scope="session")
def ladder(read) -> list[Example]:
    """Return feet and hands of somebody who climbs a ladder, as in section 8.3."""
    return [detected(each) for each in read("cmu/mb/01_03.bvh", LIMBS, skip=1)]


@pytest.fixture(scope="session")
def hands(mocap: Path) -> list[Example]:
    """Return the hands of somebody who climbs a wall, where section 8.4 has a break dance.

    One template for each hand: these are the two of the paper.
    """
    clip = np.load(mocap / "contacts/parkour/mu02_PKLP.npz")
    joints, places = list(clip["joint_names"]), clip["positions"].astype(float)
    times = np.arange(len(places)) / float(clip["fps"])
    found = []
    for side in "lr":
        named = [f"{side}_{name}" for name in ("fingers", "wrist", "elbow")]
        chain = [places[:, joints.index(name)] for name in named]
        length = float(np.median(np.linalg.norm(chain[1] - chain[0], axis=1)))
        search = Search(
            points=np.array([(0.0, 0.0, 0.0), (length, 0.0, 0.0)]),
            name=named[0], times=times, translations=chain[0], rotations=_turns(*chain),
            up=np.array((0.0, 0.0, 1.0)),
        )  # fmt: skip
        found.append(detected(search))
    return found


def _turns(tip: Floats, middle: Floats, end: Floats) -> Floats:
    """Return the orientation of a limb: its first axis to the middle joint, in the plane of all."""
    along, across = middle - tip, np.cross(middle - tip, end - tip)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    axes = np.stack([along, np.cross(across, along), across], axis=2)
    return Rotation.from_matrix(axes).as_quat()


@pytest.fixture
def draw(tmp_path: Path) -> Callable[[list[Example], str], Path]:
    """Return what draws contacts over trajectories: from above, and the height over time."""

    def run(examples: list[Example], title: str) -> Path:
        import matplotlib.figure

        figure = matplotlib.figure.Figure(figsize=(16, 4.0 * len(examples)), layout="constrained")
        rows = figure.subplots(len(examples), 2, width_ratios=(1, 2), squeeze=False)
        for (above, side), example in zip(rows, examples, strict=True):
            _draw(above, side, example)
        figure.suptitle(title)
        path = tmp_path / f"{title.replace(' ', '_')}.png"
        figure.savefig(path, dpi=60)
        return path

    return run


def _draw(above, side, example: Example) -> None:
    """Draw the way of a limb in red, contacts in blue and numbered, its template in green."""
    search, up = example.search, int(np.argmax(np.abs(example.search.up)))
    across = [axis for axis in range(3) if axis != up]
    places = search.translations
    above.plot(*places[:, across].T, color="tab:red", linewidth=0.6)
    side.plot(search.times, places[:, up], color="tab:red", linewidth=0.6)
    (shown,) = search.templates
    side.axvspan(shown.start, shown.end, ymax=0.04, color="tab:green")
    for number, each in enumerate(example.contacts, 1):
        above.plot(*each.location[across], "o", color="tab:blue", markersize=4)
        above.annotate(str(number), each.location[across], fontsize=7)
        side.axvspan(each.start, each.end, color="tab:blue", alpha=0.3)
        side.plot([each.start, each.end], [each.location[up]] * 2, color="black", linewidth=2)
        side.annotate(str(number), (each.start, each.location[up]), fontsize=7)
    above.set_aspect("equal", adjustable="datalim")
    above.set_title(f"{search.name}: {len(example.contacts)} contacts, from above [m]")
    side.set_title("height [m] over time [s]; template in green")
