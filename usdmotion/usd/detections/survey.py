"""A stage while contacts are looked for on it: its units, skeletons and detections, read once."""

from collections.abc import Sequence
from functools import cached_property

from pxr import Usd, UsdGeom

from usdmotion.arrays import Floats
from usdmotion.errors import SceneError
from usdmotion.usd.detections.performers import Performer, read_performer
from usdmotion.usd.drawn import without_guides
from usdmotion.usd.relations import bound_animation, edit_of, is_a, skeleton_of, target, value
from usdmotion.usd.stages import read_facts


class Survey:
    """What a detection has to know of a stage."""

    def __init__(self, stage: Usd.Stage, edit: str = "", skeletons: Sequence[str] = ()) -> None:
        """Look at a stage.

        Args:
            stage: The stage, whole.
            edit: Path of the only MotionEdit whose skeleton is of interest, "" for all.
            skeletons: Paths of the only Skeletons of interest; none is all of them.

        Raises:
            SceneError: There is no such edit, or it solves no Skeleton.
        """
        self.stage = stage
        self._wanted = frozenset(skeletons)
        self.facts = read_facts(stage)
        switched_off_too = Usd.PrimIsDefined & ~Usd.PrimIsAbstract
        everything = Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies(switched_off_too))
        self._prims = [
            prim for prim in without_guides(everything) if is_a(prim, "UsdGeomImageable")
        ]
        self._performers: dict[str, Performer] = {}
        self.only = self._edit(edit) if edit else None

    @property
    def up(self) -> Floats:
        """The direction away from the ground, shape (3,)."""
        return self.facts.up

    @cached_property
    def detections(self) -> list[Usd.Prim]:
        """The MotionDetections that can be written to, those that are switched off too."""
        return [
            prim
            for prim in self._prims
            if is_a(prim, "UsdMotionDetection") and not prim.IsInstanceProxy()
        ]

    @cached_property
    def edits(self) -> list[Usd.Prim]:
        """The MotionEdits that contacts can be put into."""
        return [
            prim
            for prim in self._prims
            if is_a(prim, "UsdMotionEdit") and prim.IsActive() and not prim.IsInstanceProxy()
        ]

    @property
    def moving(self) -> list[str]:
        """Paths of the prims whose own transform is animated."""
        return [
            str(prim.GetPath())
            for prim in self._prims
            if is_a(prim, "UsdGeomXformable")
            and UsdGeom.Xformable(prim).TransformMightBeTimeVarying()
        ]

    @cached_property
    def skeletons(self) -> list[Usd.Prim]:
        """The Skeletons that are of interest and that something moves.

        Raises:
            SceneError: One that is wanted is not among them.
        """
        if self.only is not None:
            return [prim for prim in (skeleton_of(self.only),) if prim is not None]
        found = [
            prim
            for prim in self._prims
            if is_a(prim, "UsdSkelSkeleton")
            and prim.IsActive()
            and self.wants(prim)
            and (bound_animation(prim) is not None or self.edit_for(prim) is not None)
        ]
        for path in sorted(self._wanted - {str(prim.GetPath()) for prim in found}):
            raise SceneError(
                f"<{path}> is no Skeleton that anything moves; bind an animation to it"
            )
        return found

    def wants(self, skeleton: Usd.Prim | None) -> bool:
        """Tell whether a Skeleton is of interest; None is of interest where all are."""
        if not self._wanted:
            return True
        return skeleton is not None and str(skeleton.GetPath()) in self._wanted

    def performer(self, skeleton: Usd.Prim) -> Performer:
        """Return a skeleton with its motion, read once.

        Raises:
            SceneError: Its motion cannot be read.
        """
        path = str(skeleton.GetPath())
        if path not in self._performers:
            edit = self.edit_for(skeleton)
            self._performers[path] = read_performer(skeleton, edit, self.facts, self.up)
        return self._performers[path]

    def edit_for(self, skeleton: Usd.Prim) -> Usd.Prim | None:
        """Return the edit that contacts of a skeleton's joints go into: the first, if any."""
        edits = [self.only] if self.only is not None else self.edits
        return next((edit for edit in edits if skeleton_of(edit) == skeleton), None)

    def detection_of(self, path: str, joint: str) -> Usd.Prim | None:
        """Return the first detection that looks at a joint of a Skeleton, or at a prim and ""."""
        found = self._known.get((path, joint))
        if found is not None and self.only is not None and joint and edit_of(found) != self.only:
            return None
        return found

    @cached_property
    def _known(self) -> dict[tuple[str, str], Usd.Prim]:
        found: dict[tuple[str, str], Usd.Prim] = {}
        for prim in self.detections:
            joint = str(value(prim, "usdmotion:joint", ""))
            of = skeleton_of(prim) if joint else target(prim, "usdmotion:object")
            if of is not None:
                found.setdefault((str(of.GetPath()), joint), prim)
        return found

    def _edit(self, path: str) -> Usd.Prim:
        for edit in self.edits:
            if str(edit.GetPath()) == path:
                if skeleton_of(edit) is None:
                    raise SceneError(f"<{path}> solves no Skeleton; set usdmotion:skeleton")
                return edit
        known = ", ".join(str(edit.GetPath()) for edit in self.edits) or "none"
        raise SceneError(f"<{path}> is no MotionEdit; there are: {known}")
