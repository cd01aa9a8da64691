"""Several people on one stage: who moves, with the contacts of that, and who stands at rest."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from usdmotion import usd
from usdmotion.arrays import Floats
from usdmotion.constraints import ContactConstraint
from usdmotion.demos.figures import Answer
from usdmotion.demos.gait import Walk
from usdmotion.demos.people import Person
from usdmotion.demos.walker import FIRST, RATE
from usdmotion.kernels import forward, from_vector
from usdmotion.motion import Motion

_FALLEN = from_vector(np.array((-0.5 * np.pi, 0.0, 0.0)))
"""What sets somebody upright on a stage along Y who stands along Z."""


@dataclass(frozen=True, eq=False)
class Member:
    """Somebody on a stage."""

    name: str
    """Name of the prim."""
    who: Person
    """The body."""
    motion: Motion
    """What it does."""
    contacts: Sequence[ContactConstraint] = field(default=())
    """What of that is held, and when; the last part of each path is the prim's name."""
    z_up: bool = False
    """Whether the body stands along Z, so that a prim above it sets it upright."""

    @classmethod
    def at_rest(cls, name: str, who: Person, *, z_up: bool = False) -> "Member":
        """Return somebody who stands at rest."""
        rest = who.skeleton.rest_translations[None], who.skeleton.rest_rotations[None]
        return cls(name, who, Motion(np.zeros(1), *rest), z_up=z_up)

    def path(self, root: str) -> str:
        """Return the path of its SkelRoot."""
        return f"/{root}/{self.name}/Body" if self.z_up else f"/{root}/{self.name}"


def one_by_one(root: str, source: str, others: Sequence[str]) -> tuple[Answer, ...]:
    """Return rows that show who moves, and then each of the others alone, with that motion.

    Args:
        root: Name of the default prim.
        source: Name of who moves.
        others: Names of the others.
    """
    everybody = {source, *others}
    retarget = f"usdmotion retarget {{stage}} {{stage}} --source /{root}/{source}/Skeleton"
    steps = {each: f"{retarget} --skeleton /{root}/{each}/Skeleton" for each in others}
    return tuple(
        Answer(each, hidden=tuple(sorted(everybody - {each})), steps=(step,))
        for each, step in {source: "usdmotion inspect {stage}", **steps}.items()
    )


def write_company(output: Path, root: str, members: Iterable[Member]) -> None:
    """Write a stage with some people; contacts are under an edit of their own.

    Args:
        output: The layer to write.
        root: Name of the default prim.
        members: Who is there.
    """
    company = list(members)
    last = max(float(each.motion.times[-1]) for each in company)
    with usd.new_stage(
        output, frame_rate=RATE, first=FIRST, last=FIRST + round(last * RATE), root=root
    ) as stage:
        usd.author_prop(stage, f"/{root}")
        for each in company:
            _author(stage, root, each)


def _author(stage: Any, root: str, member: Member) -> None:
    """Author somebody, and what he holds."""
    codes = FIRST + np.round(member.motion.times * RATE)
    who, path = member.who, member.path(root)
    if member.z_up:
        usd.author_prop(stage, f"/{root}/{member.name}", rotation=_FALLEN)
    skeleton = usd.author_character(
        stage,
        path,
        who.skeleton,
        who.body,
        member.motion,
        who.parts,
        time_codes=codes,
        tip_joints=who.tip_joints,
        tip_points=who.tip_points,
    )
    if member.contacts:
        usd.author_edit(stage, f"{skeleton}/Contacts")
    for each in member.contacts:
        usd.author(stage, f"{skeleton}/Contacts/{each.path}", each, time_codes=codes)


def held(
    acted: Walk,
    skeleton: str,
    spans: Iterable[tuple[str, float, float]],
    *,
    kind: str = "space",
    ease: float = 0.0,
) -> list[ContactConstraint]:
    """Return the contacts of joints that stand, each where and as it is meanwhile on average.

    Args:
        acted: Who moves.
        skeleton: Path of the Skeleton.
        spans: Name of a joint, first and last moment [s].
        kind: Of the contacts.
        ease: How long they take to come and to go [s].
    """
    motion = acted.motion
    positions, orientations = forward(acted.skeleton.parents, motion.translations, motion.rotations)
    found: list[ContactConstraint] = []
    for name, start, end in spans:
        inside = (motion.times >= start - 1e-6) & (motion.times <= end + 1e-6)
        if inside.sum() < 2:
            continue
        joint, times = acted.joint(name), motion.times[inside]
        first, last = float(times[0]), float(times[-1])
        keys = (max(first - ease, 0.0), first, last, min(last + ease, float(motion.times[-1])))
        found.append(
            ContactConstraint(
                path=f"{name}{len(found) + 1:02d}",
                skeleton=skeleton,
                kind=kind,
                joint=acted.skeleton.joints[joint],
                times=keys if ease else (first, last),
                location=_mean(positions[inside, joint]),
                orientation=orientations[inside, joint][0],
            )
        )
    return found


def _mean(places: Floats) -> Floats:
    return np.asarray(places.mean(axis=0))
