"""What planting the feet of a shot has done: a table and JSON."""

import json
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass

import numpy as np
from rich.table import Table

from usdmotion.arrays import Bools, Floats
from usdmotion.cast import Cast
from usdmotion.constraints import ContactConstraint
from usdmotion.kernels import world_points
from usdmotion.motion import WorldPose
from usdmotion.quality import jerk
from usdmotion.report.contacts import ObjectReport
from usdmotion.report.verdict import EditReport
from usdmotion.scene import Edit, Scene

AWAY = 0.25
"""So long before and after every contact the motion is to be as it was [s]."""


@dataclass(frozen=True)
class FootReport:
    """How far one joint of a foot slides while it is in contact; its fields are keys of the JSON.

    The slide of a contact is the largest distance of what is held from its mean place. When there
    is contact is told by the source alone.
    """

    edit: str
    joint: str
    contacts: int
    worst_before: float
    """Largest slide of a contact in the source [m]."""
    worst_after: float
    """Largest slide in the result [m]."""
    mean_before: float
    """Mean of the slides of all contacts in the source [m]."""
    mean_after: float
    """The same in the result [m]."""


@dataclass(frozen=True)
class KeptReport:
    """How much of a motion was kept; its fields are keys of the JSON."""

    edit: str
    elsewhere: float | None
    """Largest distance of a joint from where it was, farther than 0.25 s from any contact [m]; None
    where no frame is, as in most walks."""
    moved_mean: float
    """Mean distance of all joints from where they were, over all frames [m]."""
    moved: float
    """The largest [m]."""
    moved_joint: str
    moved_time: float
    """The time code of it."""
    jerk_before: float
    """Of the root in the source, root mean square [m/s³]."""
    jerk_after: float
    """The same in the result."""

    @property
    def sentence(self) -> str:
        """What a person is told of it."""
        if self.elsewhere is None:
            away = f"no frame is more than {AWAY:g} s away from contacts"
        else:
            away = (
                f"more than {AWAY:g} s away from contacts by {_millimetres(self.elsewhere)} at most"
            )
        return (
            f"<{self.edit}>: joints moved by {_millimetres(self.moved_mean)} on average, "
            f"{self.moved_joint.rsplit('/', 1)[-1]} most, by {_millimetres(self.moved)} at "
            f"{self.moved_time:g}; {away}; jerk of the root "
            f"{self.jerk_before:.0f} → {self.jerk_after:.0f} m/s³"
        )


@dataclass(frozen=True)
class PlantingReport:
    """What was found, enforced and kept."""

    feet: tuple[FootReport, ...]
    kept: tuple[KeptReport, ...]
    edits: tuple[EditReport, ...]
    objects: tuple[ObjectReport, ...]
    """What was looked at, and the contacts of it."""
    notes: tuple[str, ...] = ()
    """One sentence about each thing that whoever asked should know."""

    @property
    def met(self) -> bool:
        """Whether every constraint of every edit was met."""
        return all(row.met for edit in self.edits for row in edit.constraints)

    def to_json(self) -> str:
        """Return the machine-readable form; the fields are its keys."""
        return json.dumps(asdict(self), indent=2, allow_nan=False)

    def tables(self) -> list[Table | str]:
        """Return a table of all feet for a terminal, and a line about each motion."""
        told = [each.sentence for each in self.kept]
        if not self.feet:
            return ["no foot was found to stand", *told]
        table = slide_table("foot slide during contacts")
        for each in self.feet:
            slides = (each.worst_before, each.worst_after, each.mean_before, each.mean_after)
            table.add_row(each.joint.rsplit("/", 1)[-1], *slide_cells(each.contacts, slides))
        return [table, *told]


def slide_table(title: str) -> Table:
    """Return a table without rows of how far feet slide before and after."""
    table = Table(title=title, title_justify="left")
    table.add_column("joint")
    for heading in ("contacts", "worst before", "after", "mean before", "after"):
        table.add_column(heading, justify="right")
    return table


def slide_cells(contacts: int, slides: Sequence[float | None]) -> Iterator[str]:
    """Yield what a row of it says of a joint: its contacts, and slides [m], None for unknown."""
    yield str(contacts)
    for slide in slides:
        yield "—" if slide is None else f"{slide * 1e3:.2f} mm"


def slide_of(cast: Cast, contact: ContactConstraint, when: Bools, pose: WorldPose) -> float:
    """Return how far what a contact holds is from its mean place at most [m].

    Args:
        cast: Whoever the contact holds.
        contact: The contact.
        when: The frames that count, at least one, shape (frame_count,).
        pose: All nodes in the source, or in the result.
    """
    node = contact.node(cast)
    point = contact.point[when] if contact.point.ndim > 1 else contact.point
    places = world_points(pose[0][when, node], pose[1][when, node], point)
    return float(np.linalg.norm(places - places.mean(axis=0), axis=1).max())


def feet_of(
    scene: Scene, edit: Edit, solved: WorldPose, detections: Sequence[str]
) -> Iterator[FootReport]:
    """Yield what became of the joints of feet of one edit.

    Args:
        scene: The scene as it was read.
        edit: One of its edits.
        solved: All nodes in the result.
        detections: Paths of the detections that feet have in it.
    """
    cast = scene.cast
    source = cast.positions, cast.orientations
    for path in detections:
        contacts = [
            each
            for each in edit.constraints
            if isinstance(each, ContactConstraint) and each.path.startswith(f"{path}/")
        ]
        held = [(each, each.plateau(cast)) for each in contacts]
        held = [(each, when) for each, when in held if when.any()]
        if held:
            before, after = (
                np.array([slide_of(cast, each, when, pose) for each, when in held])
                for pose in (source, solved)
            )
            yield FootReport(
                edit.path,
                held[0][0].joint,
                len(held),
                float(before.max()),
                float(after.max()),
                float(before.mean()),
                float(after.mean()),
            )


def kept_of(scene: Scene, edit: Edit, solved: WorldPose) -> KeptReport:
    """Return how much of the motion of an edit's skeleton was kept."""
    cast, times = scene.cast, scene.times
    nodes = [cast.index[joint] for joint in cast.joints if joint[0] == edit.skeleton and joint[1]]
    apart = np.linalg.norm(solved[0][:, nodes] - cast.positions[:, nodes], axis=-1)
    frame, joint = np.unravel_index(apart.argmax(), apart.shape)
    away = _away(times, edit)
    root = cast.index[edit.skeleton, _root(scene, edit)]
    before, after = (
        float(np.sqrt(np.mean(jerk(times, places[:, root])[1] ** 2))) if len(times) > 3 else 0.0
        for places in (cast.positions, solved[0])
    )
    return KeptReport(
        edit=edit.path,
        elsewhere=float(apart[away].max()) if away.any() else None,
        moved_mean=float(apart.mean()),
        moved=float(apart[frame, joint]),
        moved_joint=cast.joints[nodes[joint]][1],
        moved_time=float(scene.time_codes[frame]),
        jerk_before=before,
        jerk_after=after,
    )


def _millimetres(length: float) -> str:
    return f"{length * 1e3:.2f} mm"


def _away(times: Floats, edit: Edit) -> Bools:
    """Return the frames that are far from every contact, shape (frame_count,)."""
    away = np.ones(len(times), dtype=np.bool_)
    for each in edit.constraints:
        if isinstance(each, ContactConstraint):
            first, last = each.held(times)
            away &= (times < first - AWAY) | (times > last + AWAY)
    return away


def _root(scene: Scene, edit: Edit) -> str:
    character = scene.character(edit.skeleton)
    return character.skeleton.joints[character.root]
