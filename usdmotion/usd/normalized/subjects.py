"""Who moves on a stage, from which motion, and which edit says what it must obey."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from pxr import Usd, UsdSkel

from usdmotion.arrays import Floats
from usdmotion.errors import SceneError
from usdmotion.humanoid import guess
from usdmotion.motion import Motion
from usdmotion.s4d import Morphology
from usdmotion.usd.characters import Sitting, read_character
from usdmotion.usd.clips import own_times
from usdmotion.usd.concerns import concerns
from usdmotion.usd.constraints import other_skeletons
from usdmotion.usd.detections.trajectories import filled
from usdmotion.usd.drawn import without_guides
from usdmotion.usd.origins import depends_on, source_of
from usdmotion.usd.relations import bound_animation, edit_of, is_a, skeleton_of
from usdmotion.usd.roots import parts_of
from usdmotion.usd.shot import Facts
from usdmotion.usd.stages import read_facts, refuse
from usdmotion.usd.times import solved_times


@dataclass(frozen=True, eq=False)
class Subject:
    """One Skeleton that moves."""

    skeleton: Usd.Prim
    animation: Usd.Prim
    """The SkelAnimation that it is taken from."""
    edit: Usd.Prim | None
    """The MotionEdit that starts from it; None where there is none."""

    @property
    def path(self) -> str:
        """Path of the Skeleton."""
        return str(self.skeleton.GetPath())


def find_subjects(stage: Usd.Stage, named: str = "", edits: Sequence[str] = ()) -> list[Subject]:
    """Return who moves on a stage.

    Args:
        stage: The stage.
        named: Path of the only Skeleton, or SkelAnimation, that is of interest; "" takes all.
        edits: Paths of the MotionEdits that say what a motion must obey, where a Skeleton has
            several.

    Raises:
        SceneError: Nobody does, or it is not clear which edit is meant.
    """
    everything = Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies())
    prims = list(without_guides(everything))
    every = [prim for prim in prims if is_a(prim, "UsdMotionEdit") and not prim.IsInstanceProxy()]
    _refuse_unknown(every, edits)
    wanted = stage.GetPrimAtPath(named) if named else None
    if named and not (is_a(wanted, "UsdSkelSkeleton") or is_a(wanted, "UsdSkelAnimation")):
        raise SceneError(f"<{named}> is no Skeleton and no SkelAnimation; name one of the stage")
    found = []
    for prim in prims:
        if not is_a(prim, "UsdSkelSkeleton"):
            continue
        mine = [edit for edit in every if skeleton_of(edit) == prim]
        edit = _edit_of(prim, mine, edits)
        animation = bound_animation(prim) if edit is None else source_of(edit, prim)
        if is_a(wanted, "UsdSkelAnimation") and wanted in (animation, bound_animation(prim)):
            found.append(Subject(prim, wanted, edit))
        elif animation is not None and wanted in (None, prim):
            found.append(Subject(prim, animation, edit))
    if edits:
        found = [each for each in found if each.edit and str(each.edit.GetPath()) in edits]
    if not found:
        who = f"<{named}> moves nothing" if named else "there is no Skeleton in motion"
        raise SceneError(f"{who}; bind a SkelAnimation to a Skeleton")
    return found


def read_sittings(
    subject: Subject, frames: tuple[float, float] | None, facts: Facts
) -> tuple[Floats, Mapping[str, Sitting]]:
    """Return the time code of each frame, and who takes part by the paths of their skeletons.

    Args:
        subject: Who moves; the others are those that its edit is about.
        frames: First and last time code; None is all of the animation.
        facts: Units and rates of the stage.

    Raises:
        SceneError: A motion cannot be told without guessing.
    """
    refuse(concerns(subject.skeleton))
    if subject.edit is not None:
        refuse(concerns(subject.edit))
    name = f"<{subject.path}>"
    own = solved_times(own_times(subject.animation), frames, 0.0, facts, name)
    codes = filled(own, facts)
    sittings = {subject.path: read_character(subject.skeleton, subject.animation, codes, facts)}
    for path, prim in (other_skeletons(subject.edit) if subject.edit else {}).items():
        if path not in sittings:
            sittings[path] = read_character(prim, bound_animation(prim), codes, facts)
    return codes, sittings


def morphology_of(skeleton: Usd.Prim, sitting: Sitting) -> Morphology:
    """Return the body of a Skeleton.

    Raises:
        SceneError: It is no human body, or it is not sure which joint is which part of one.
    """
    shape, who = sitting.character.skeleton, f"<{skeleton.GetPath()}>"
    given = parts_of(skeleton, len(shape.joints))
    parts = sitting.character.parts or guess(shape, given=given, who=who)
    return Morphology.of(shape, parts, poses=_poses(skeleton), who=who)


def _poses(skeleton: Usd.Prim) -> Motion | None:
    """Return how a body moves on its stage, whoever asks and for whichever frames."""
    animation = bound_animation(skeleton)
    own = own_times(animation)
    if animation is None or not len(own):
        return None
    facts = read_facts(skeleton.GetStage())
    return read_character(skeleton, animation, own, facts).character.motion


def bodies_of(
    stage: Usd.Stage, sittings: Mapping[str, Sitting]
) -> Iterator[tuple[str, Morphology]]:
    """Yield the human bodies among those who take part, with the paths of their skeletons."""
    for path, sitting in sittings.items():
        try:
            yield path, morphology_of(stage.GetPrimAtPath(path), sitting)
        except SceneError:
            continue


def _edit_of(
    skeleton: Usd.Prim, edits: Sequence[Usd.Prim], wanted: Sequence[str]
) -> Usd.Prim | None:
    """Return the edit of a Skeleton that is meant, None where it has none.

    Of several it is the one that is named, else the one whose result is bound.
    """
    named = [edit for edit in edits if str(edit.GetPath()) in wanted]
    bound = bound_animation(skeleton)
    shown = [edit for edit in edits if bound is not None and depends_on(bound, edit)]
    chosen = named or (edits if len(edits) < 2 else shown[-1:])
    if len(edits) > 1 and len(chosen) != 1:
        paths = ", ".join(str(edit.GetPath()) for edit in edits)
        raise SceneError(f"<{skeleton.GetPath()}> has the edits {paths}; name one with --edit")
    return chosen[0] if chosen else None


def _refuse_unknown(edits: Sequence[Usd.Prim], wanted: Sequence[str]) -> None:
    known = [str(edit.GetPath()) for edit in edits]
    for path in wanted:
        if path not in known:
            raise SceneError(f"<{path}> is no MotionEdit; there are: {', '.join(known) or 'none'}")


def in_edit_of(stage: Usd.Stage, subject: Subject, prims: Sequence[str]) -> Subject:
    """Return who moves with the edit that some prims are in, from the same motion."""
    edits = [edit_of(stage.GetPrimAtPath(path)) for path in prims]
    mine = [each for each in edits if each is not None and skeleton_of(each) == subject.skeleton]
    return Subject(subject.skeleton, subject.animation, mine[0] if mine else subject.edit)


def name_of(subject: Subject) -> str:
    """Return what a motion is called after: the SkelRoot of its body, else what is at the top."""
    root = UsdSkel.Root.Find(subject.skeleton)
    prim = root.GetPrim() if root else subject.skeleton
    return str(prim.GetName())


def notes_of(subject: Subject) -> Iterator[str]:
    """Yield a sentence where a motion is not the one that the stage shows."""
    bound = bound_animation(subject.skeleton)
    if bound is not None and bound != subject.animation and subject.edit is not None:
        yield (
            f"<{subject.path}> shows <{bound.GetPath()}>; the motion is that of "
            f"<{subject.animation.GetPath()}>, and what <{subject.edit.GetPath()}> asks of it "
            "travels along"
        )
