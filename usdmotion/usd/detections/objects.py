"""What is looked at on a stage: joints and prims, and the detection that each of them has."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from pxr import Sdf, Usd

from usdmotion.asking import Asked
from usdmotion.errors import SceneError
from usdmotion.humanoid import PARTS
from usdmotion.usd.concerns import concerns
from usdmotion.usd.detections.joints import feet_of, find_joint, unknown_joint
from usdmotion.usd.detections.performers import Performer
from usdmotion.usd.detections.survey import Survey
from usdmotion.usd.relations import edit_of, is_a, joints_of, skeleton_of, target, value
from usdmotion.usd.stages import refuse


@dataclass(frozen=True, eq=False)
class Watched:
    """One joint or prim that is looked at."""

    detection: Usd.Prim | None
    """Its MotionDetection, None where there is none yet."""
    performer: Performer | None
    """The skeleton of the joint; None of a prim."""
    joint: str
    """Token of the joint; "" of a prim."""
    prim: Usd.Prim | None
    """The prim; None of a joint."""

    @property
    def key(self) -> tuple[str, str]:
        """What tells it from others: path of the Skeleton and joint, or path and ""."""
        of = self.prim or (self.performer.prim if self.performer else None)
        return str(of.GetPath()) if of else "", self.joint


def find_watched(here: Survey, asked: Asked) -> tuple[Watched, ...]:
    """Return what somebody asks to be looked at, each once.

    That is the joints and prims that are named. Where none is, it is what the detections of the
    stage ask for, or the feet of every skeleton of which they are known, and what examples name.

    Raises:
        SceneError: Something that is named is not there, or there is nothing to look at.
    """
    found: dict[tuple[str, str], Watched] = {}

    def add(each: Iterable[Watched]) -> None:
        for one in each:
            found.setdefault(one.key, one)

    named = bool(asked.joints or asked.prims)
    if not named:
        add(_of_detections(here))
    for name in asked.joints:
        add(_of_joint(here, name))
    for path in asked.prims:
        add(_of_prim(here, path))
    for example in asked.templates:
        add(objects_of(here, example.object))
    if not found:
        add(_feet(here))
    if not found:
        raise SceneError(_nothing(here))
    return _switched_on(found.values())


def objects_of(here: Survey, name: str) -> list[Watched]:
    """Return the joints, or the prim, that a name means.

    Raises:
        SceneError: It means none.
    """
    return _of_prim(here, name) if name.startswith("/") else _of_joint(here, name)


def _of_detections(here: Survey) -> Iterator[Watched]:
    for prim in here.detections:
        within = edit_of(prim)
        if not prim.IsActive() or (here.only is not None and within != here.only):
            continue
        refuse(concerns(prim))
        watched, joint = target(prim, "usdmotion:object"), str(value(prim, "usdmotion:joint", ""))
        skeleton = skeleton_of(prim) if joint else None
        if not here.wants(skeleton):
            continue
        if skeleton is not None:
            yield Watched(prim, here.performer(skeleton), joint, None)
        elif watched is not None:
            yield Watched(prim, None, "", watched)
        else:
            raise SceneError(
                f"<{prim.GetPath()}> looks at nothing; set usdmotion:joint or usdmotion:object"
            )


def _of_joint(here: Survey, name: str) -> list[Watched]:
    if not here.skeletons:
        raise SceneError(
            f"there is no Skeleton that could have the joint '{name}'; name a prim with --prims"
        )
    found = []
    for skeleton in here.skeletons:
        token = _token(here, skeleton, name)
        if token is not None:
            known = here.detection_of(str(skeleton.GetPath()), token)
            found.append(Watched(known, here.performer(skeleton), token, None))
    if not found:
        paths = [str(skeleton.GetPath()) for skeleton in here.skeletons]
        raise unknown_joint(name, joints_of(here.skeletons[0]), paths)
    return found


def _token(here: Survey, skeleton: Usd.Prim, name: str) -> str | None:
    """Return the joint of a skeleton that a name means; its motion is read only if it has to be."""
    token = find_joint(name, joints_of(skeleton), str(skeleton.GetPath()))
    if token is not None or name not in PARTS:
        return token
    performer = here.performer(skeleton)
    joint = performer.parts.joint(name)
    return None if joint is None else performer.tokens[joint]


def _of_prim(here: Survey, path: str) -> list[Watched]:
    fine = Sdf.Path.IsValidPathString(path)[0] and path.startswith("/")
    prim = here.stage.GetPrimAtPath(path) if fine else None
    if not prim:
        raise SceneError(f"there is no prim <{path}>; name one of the stage, as /World/Box")
    if not is_a(prim, "UsdGeomXformable"):
        raise SceneError(
            f"<{path}> is a {prim.GetTypeName() or 'prim without a type'}, which has no transform; "
            "name an Xformable prim, or a joint with --joints"
        )
    return [Watched(here.detection_of(path, ""), None, "", prim)]


def _feet(here: Survey) -> Iterator[Watched]:
    for skeleton in here.skeletons:
        each = here.performer(skeleton)
        for token in feet_of(each.tokens, each.parts):
            yield Watched(here.detection_of(each.path, token), each, token, None)


def _switched_on(watched: Iterable[Watched]) -> tuple[Watched, ...]:
    on: list[Watched] = []
    off: list[str] = []
    for each in watched:
        if each.detection is None or each.detection.IsActive():
            on.append(each)
        else:
            off.append(f"<{each.detection.GetPath()}>")
    if not on:
        raise SceneError(f"{', '.join(off)} is switched off; activate it to look there again")
    return tuple(on)


def _nothing(here: Survey) -> str:
    if not here.skeletons:
        such = ", ".join(here.moving[:4])
        return "there is no Skeleton and no MotionDetection; name animated prims with --prims" + (
            f", such as {such}" if such else ""
        )
    paths = ", ".join(f"<{skeleton.GetPath()}>" for skeleton in here.skeletons)
    return (
        f"nobody knows which joints of {paths} are feet; name joints with --joints, or say in "
        "usdmotion:parts which they are"
    )
