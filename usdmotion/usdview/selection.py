"""What somebody means who has selected something: the prim itself, what is above it, or below.

A goal is selected with its constraint, a constraint with its edit, an edit with its skeleton, a
mesh with the skeleton that it is bound to, and what guides show with what they belong to. Several
prims act together. Where nothing is selected that would do, and the stage has only one, it is that.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from pxr import Usd, UsdSkel

from usdmotion.errors import SceneError
from usdmotion.usd.drawn import without_guides
from usdmotion.usd.relations import bound_animation, edit_of, is_a, nearest, skeleton_of, target

_SKELETON, _EDIT, _DETECTION = "UsdSkelSkeleton", "UsdMotionEdit", "UsdMotionDetection"
_CONSTRAINT, _CONTACT = "UsdMotionConstraint", "UsdMotionContactConstraint"


@dataclass(frozen=True)
class Selection:
    """What is selected in usdview, and when."""

    stage: Usd.Stage
    prims: tuple[Usd.Prim, ...]
    """The selected prims; none where nothing is."""
    time_code: float
    """The frame that is shown."""

    @classmethod
    def of(cls, api: Any) -> "Selection":
        """Return what is selected.

        Raises:
            SceneError: No stage is open.
        """
        if api.stage is None:
            raise SceneError("no stage is open; open one first")
        # With nothing selected usdview selects the pseudo-root; what was removed is not valid.
        prims = tuple(prim for prim in api.selectedPrims if prim and not prim.IsPseudoRoot())
        frame = api.frame
        code = api.stage.GetStartTimeCode() if frame.IsDefault() else frame.GetValue()
        return cls(api.stage, prims, code)

    @property
    def anybody(self) -> bool:
        """Whether the stage has a Skeleton at all."""
        return bool(_below(self.stage.GetPseudoRoot(), _SKELETON))

    @property
    def characters(self) -> tuple[str, ...]:
        """Paths of the Skeletons that selected prims lead to."""
        return _paths(each for prim in self.prims for each in _skeletons_of(prim))

    @property
    def skeletons(self) -> tuple[str, ...]:
        """Paths of the Skeletons that are meant: those that are selected, or the only one.

        Raises:
            SceneError: It is not clear which.
        """
        return self.characters or self._only_one(_SKELETON, "Skeleton")

    @property
    def skeleton(self) -> str:
        """Path of the Skeleton that is meant.

        Raises:
            SceneError: It is not clear which, or several are selected.
        """
        return _alone(self.skeletons, "Skeleton")

    @property
    def edits(self) -> tuple[str, ...]:
        """Paths of the MotionEdits that are meant: those that are selected, or the only one.

        Raises:
            SceneError: It is not clear which.
        """
        found = _paths(each for prim in self.prims for each in _edits_of(prim))
        if not found and self.characters:
            raise SceneError(
                f"{_listed(self.characters)} has no MotionEdit; detect contacts, or make a "
                "constraint"
            )
        return found or self._only_one(_EDIT, "MotionEdit")

    @property
    def within(self) -> str:
        """Path of the one MotionEdit that something selected is in, "" for none or several."""
        above = (edit_of(prim) for prim in self.prims)
        found = _paths(prim for prim in above if prim is not None)
        return found[0] if len(found) == 1 else ""

    @property
    def constraint(self) -> str:
        """Path of the constraint that is selected.

        Raises:
            SceneError: None is, or several are.
        """
        return _alone(self._above(_CONSTRAINT, "constraint"), "constraint")

    @property
    def contacts(self) -> tuple[str, ...]:
        """Paths of the contacts that are selected.

        Raises:
            SceneError: None is.
        """
        return self._above(_CONTACT, "MotionContactConstraint")

    @property
    def props(self) -> tuple[str, ...]:
        """Paths of what is selected and moves without a Skeleton, by itself or by its detection."""
        return _paths(each for prim in self.prims for each in _props_of(prim))

    @property
    def prop(self) -> str:
        """Path of the one prop that is selected, "" for none.

        Raises:
            SceneError: Several are.
        """
        return _alone(self.props, "prim beside the Skeleton") if self.props else ""

    @property
    def joint(self) -> str:
        """The joint that a selected constraint holds, "" where none is selected."""
        above = (nearest(prim, _CONSTRAINT) for prim in self.prims)
        held = (prim.GetAttribute("usdmotion:joint").Get() for prim in above if prim is not None)
        return next((str(token) for token in held if token), "")

    def _only_one(self, kind: str, noun: str) -> tuple[str, ...]:
        known = _paths(_below(self.stage.GetPseudoRoot(), kind))
        if not known:
            raise SceneError(f"the stage has no {noun}, and nothing else that would do is selected")
        if len(known) > 1:
            raise SceneError(f"select a {noun}; there are {_listed(known)}")
        return known

    def _above(self, kind: str, noun: str) -> tuple[str, ...]:
        above = (nearest(prim, kind) for prim in self.prims)
        found = _paths(prim for prim in above if prim is not None)
        if not found:
            at = f"; <{self.prims[-1].GetPath()}> is none" if self.prims else ""
            raise SceneError(f"select a {noun}{at}")
        return found


def _skeletons_of(prim: Usd.Prim) -> list[Usd.Prim]:
    """Return the Skeletons that a prim means: of its edit, bound to it, moved by it, or below."""
    found = skeleton_of(prim) or UsdSkel.BindingAPI(prim).GetInheritedSkeleton().GetPrim()
    if found:
        return [found]
    if is_a(prim, "UsdSkelAnimation"):
        known = _below(prim.GetStage().GetPseudoRoot(), _SKELETON)
        return [each for each in known if bound_animation(each) == prim]
    return _below(nearest(prim, "UsdSkelRoot") or prim, _SKELETON)


def _edits_of(prim: Usd.Prim) -> list[Usd.Prim]:
    """Return the edits that a prim means: its own, or those of the Skeletons that it means."""
    within = edit_of(prim)
    if within is not None:
        return [within]
    skeletons = _skeletons_of(prim)
    known = _below(prim.GetStage().GetPseudoRoot(), _EDIT) if skeletons else []
    return [each for each in known if skeleton_of(each) in skeletons]


def _props_of(prim: Usd.Prim) -> list[Usd.Prim]:
    if _edits_of(prim) or _skeletons_of(prim):
        return []
    detection = nearest(prim, _DETECTION)
    if detection is not None:
        watched = target(detection, "usdmotion:object")
        return [] if watched is None else [watched]
    return [prim] if is_a(prim, "UsdGeomXformable") else []


def _below(prim: Usd.Prim, kind: str) -> list[Usd.Prim]:
    inside = without_guides(Usd.PrimRange(prim, Usd.TraverseInstanceProxies()))
    return [each for each in inside if is_a(each, kind)]


def _paths(prims: Iterable[Usd.Prim]) -> tuple[str, ...]:
    """Return paths, each once."""
    return tuple(dict.fromkeys(str(prim.GetPath()) for prim in prims))


def _alone(paths: Sequence[str], noun: str) -> str:
    if len(paths) > 1:
        raise SceneError(f"select one {noun} only, not {_listed(paths)}")
    return paths[0]


def _listed(paths: Sequence[str]) -> str:
    shown = ", ".join(f"<{path}>" for path in paths[:4])
    return shown + (f" and {len(paths) - 4} more" if len(paths) > 4 else "")
