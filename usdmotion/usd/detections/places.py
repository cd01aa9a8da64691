"""Where a detection is put on a stage."""

from dataclasses import dataclass, field

from pxr import Sdf, Tf, Usd

from usdmotion.usd.attribute_authoring import define
from usdmotion.usd.detections.joints import leaf_of
from usdmotion.usd.detections.objects import Watched
from usdmotion.usd.detections.performers import Performer

EDIT = "Contacts"
"""Name of the edit that is made of a skeleton that has none."""
SCOPE = "Detections"
"""Name of the prim that is made over the detections of props."""


@dataclass(frozen=True)
class Place:
    """A prim that is a detection, or is to be one."""

    path: str
    """Path of the MotionDetection."""
    parent_type: str = ""
    """Schema class of the prim above it, where that is to be made too."""
    skeleton: str = ""
    """Path of the Skeleton that the edit has to name, "" where it stands under it."""


@dataclass
class Places:
    """Gives each detection a path of its own."""

    stage: Usd.Stage
    _taken: set[str] = field(default_factory=set)
    _edits: dict[str, Place] = field(default_factory=dict)
    """The edit that is made for each Skeleton."""

    def of(self, watched: Watched) -> Place:
        """Return where the detection of a joint or prim is, or is to be made."""
        if watched.detection is not None:
            return Place(str(watched.detection.GetPath()))
        if watched.performer is None:
            assert watched.prim is not None
            return self._named(self._beside(watched.prim), watched.prim.GetName())
        return self.within(watched.performer, leaf_of(watched.joint))

    def within(self, performer: Performer, name: str, new: str = EDIT) -> Place:
        """Return where a prim of some name is to be made in the edit of a skeleton.

        Args:
            performer: The skeleton.
            name: How the prim is called, but for a number behind it.
            new: How an edit is called that is to be made as well.
        """
        edit = performer.edit
        above = Place(str(edit.GetPath())) if edit else self._new_edit(performer.prim, new)
        return self._named(above, name)

    def _new_edit(self, skeleton: Usd.Prim, new: str) -> Place:
        path = str(skeleton.GetPath())
        if path not in self._edits:
            # Nothing can be written inside an instance.
            outside = skeleton
            while outside.IsInstanceProxy():
                outside = outside.GetParent()
            moved = outside != skeleton
            name = f"{outside.GetName()}_{new}" if moved else new
            above = outside.GetParent() if moved else skeleton
            free = self._free(str(above.GetPath()), name)
            self._edits[path] = Place(free, "MotionEdit", path if moved else "")
        return self._edits[path]

    def _beside(self, prim: Usd.Prim) -> Place:
        top = prim.GetPath().GetPrefixes()[0]
        above = "/" if top == prim.GetPath() or self.stage.GetPrimAtPath(top).IsInstance() else top
        path = _join(str(above), SCOPE)
        return Place(path, "" if self.stage.GetPrimAtPath(path) else "Scope")

    def _named(self, above: Place, leaf: str) -> Place:
        path = self._free(above.path, Tf.MakeValidIdentifier(leaf))
        return Place(path, above.parent_type, above.skeleton)

    def _free(self, above: str, name: str) -> str:
        """Return a path below another that nothing has, and take it."""
        number, path = 1, _join(above, name)
        while path in self._taken or self.stage.GetPrimAtPath(path):
            number += 1
            path = _join(above, f"{name}{number}")
        self._taken.add(path)
        return path


def author_edit_above(stage: Usd.Stage, place: Place) -> None:
    """Make the edit that a prim is to stand in, in the edit target, where it is not there yet."""
    above = str(Sdf.Path(place.path).GetParentPath())
    if place.parent_type and not stage.GetPrimAtPath(above):
        edit = define(stage, above, place.parent_type)
        if place.skeleton:
            edit.GetRelationship("usdmotion:skeleton").SetTargets([place.skeleton])


def _join(above: str, name: str) -> str:
    return str(Sdf.Path(above).AppendChild(name))
