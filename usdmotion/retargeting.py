"""A motion is put on another body, with what it must obey, from file to file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from usdmotion.answering import Say, results_of, solved_scenes
from usdmotion.arrays import Floats
from usdmotion.cast import Cast
from usdmotion.errors import SceneError
from usdmotion.guiding import require_room, write_with_guides
from usdmotion.motion import Motion, WorldPose
from usdmotion.normalizing import Choice, take_off
from usdmotion.plugins import host
from usdmotion.report.mapping import mapped_of
from usdmotion.report.normalizing import travellers_of
from usdmotion.report.retargeting import RetargetingReport, SlideReport, slides_of
from usdmotion.s4d import hinged, restore, stand
from usdmotion.solved import SolvedScene
from usdmotion.travelling import (
    Left,
    Luggage,
    Meanings,
    Traveller,
    contacts_of_feet,
    footprints_of,
    with_own_feet,
    with_points_for_balls,
)

if TYPE_CHECKING:
    from usdmotion.usd import Overlay, Shot
    from usdmotion.usd.normalized import Recorded, Target


@dataclass(frozen=True)
class Placing:
    """How a motion is to be put on a body."""

    skeleton: str = ""
    """Path of the Skeleton; "" is the only one of the stage."""
    enforce: bool = True
    """Whether constraints that travelled are solved."""
    ground: tuple[str, ...] | None = None
    """Paths of the prims that the motion is put on; None takes what travelled."""
    solver: str | None = None
    """Name of the solver; None takes what travelled."""
    options: Mapping[str, object] = field(default_factory=dict)
    """Options of the solver."""


def retarget(
    source: Path,
    target: Path,
    output: Path,
    *,
    motion: str = "",
    edits: Sequence[str] = (),
    frames: tuple[float, float] | None = None,
    contacts: bool = True,
    skeleton: str = "",
    enforce: bool = True,
    solver: str | None = None,
    options: Mapping[str, object] | None = None,
    ground: Sequence[str] | None = None,
    guides: bool | Path = False,
    say: Say = lambda _: None,
) -> RetargetingReport:
    """Put a motion on another body, and write a layer over the stage of that body.

    Args:
        source: A stage of normalized motions; or a shot, which is normalized on the way.
        target: The stage of the body.
        output: The layer to write; the target is its sublayer.
        motion: Path of the MotionNormalized, Skeleton or SkelAnimation, where the source has
            several.
        edits: Paths of the MotionEdits of a shot whose constraints travel, as in `normalize`.
        frames: First and last time code of the source; None takes all of the motion.
        contacts: Look for contacts of feet where a shot has none.
        skeleton: Path of the Skeleton, where the target has several.
        enforce: Solve what travelled; else it is there, and not solved.
        solver: Name of the solver; None takes what travelled.
        options: Options of the solver, on top of those that travelled.
        ground: Paths of the prims of the target's stage that the motion is put on, none for no
            ground; None takes the ground that the edit had, where the target's stage has it too.
        guides: Draw what there is to see too: in the layer itself, or in a file of their own over
            it and the target.
        say: Is told what is being done.

    Raises:
        InputError: A stage, or what is asked for, is at fault, or a body is not human.
        PluginError: A detector or solver does not keep its contract.
    """
    from usdmotion import usd

    require_room(guides, (output,), (source, target))
    choice = Choice(motion, tuple(edits), frames, contacts)
    put_on = None if ground is None else tuple(ground)
    placing = Placing(skeleton, enforce, put_on, solver, dict(options or {}))
    luggage, recorded, notes = _read(source, output, choice, say)
    say(f"reading {target}")
    overlay = usd.Overlay.open(target, output)
    try:
        put = _put(overlay, luggage, placing)
        read, scenes, told = _solved(overlay, put, placing, say)
    except SceneError as error:
        named = str(error).startswith(f"{target}: ")
        raise error if named else SceneError(f"{target}: {error}") from error
    notes = tuple(dict.fromkeys((*notes, *put.notes, *told)))
    results = [result for each in scenes for result in results_of(each)]
    layer, folder = overlay.stage.GetRootLayer(), output.parent
    made = usd.put(layer, read, results, folder, notes) if read else {"notes": notes}
    overlay.remember(**made)
    write_with_guides(overlay, guides, say=say)
    return _report(put, recorded, scenes, notes)


@dataclass(frozen=True, eq=False)
class _Put:
    """A motion on a body, in a layer that is being made."""

    luggage: Luggage
    target: Target
    motion: Motion
    """On the body, standing on its footprints."""
    animation: str
    """Path of the SkelAnimation."""
    edit: str
    """Path of the MotionEdit, "" where there is nothing to enforce."""
    there: tuple[Traveller, ...]
    """What came along, on the body."""
    left: tuple[Left, ...]
    notes: tuple[str, ...]

    @property
    def meanings(self) -> Meanings:
        """What parts mean on the body."""
        return Meanings.of(self.target.path, self.target.morphology, np.array([0.0, 1.0, 0.0]))


def _read(
    source: Path, output: Path, choice: Choice, say: Say
) -> tuple[Luggage, Recorded | None, tuple[str, ...]]:
    """Return a motion without a body; and, from a shot, the body that it was taken off."""
    from usdmotion import usd
    from usdmotion.usd import normalized

    say(f"reading {source}")
    overlay = usd.Overlay.open(source, output)
    if normalized.normalized_prims(overlay.stage):
        try:
            kinds = host().constraints
            luggage = normalized.read_luggage(overlay.stage, choice.source, choice.frames, kinds)
        except SceneError as error:
            raise SceneError(f"{source}: {error}") from error
        return luggage, None, ()
    found, notes = take_off(overlay, choice, say=say)
    if len(found) > 1:
        paths = ", ".join(each.subject.path for each in found)
        raise SceneError(f"{source}: there are several motions, of {paths}; name one with --source")
    return found[0].luggage, found[0], notes


def _put(overlay: Overlay, luggage: Luggage, placing: Placing) -> _Put:
    """Put a motion on a body of a stage, with what came along."""
    from usdmotion.usd import normalized
    from usdmotion.usd.stages import read_facts

    stage = overlay.stage
    facts = read_facts(stage)
    if placing.ground is not None:
        settings = replace(luggage.settings, ground=placing.ground)
        luggage = replace(luggage, settings=settings)
    codes = luggage.codes(facts.time_codes_per_second)
    normalized.set_range(stage, float(codes[0]), float(codes[-1]))
    prim = normalized.find_target(stage, placing.skeleton)
    target = normalized.read_target(prim, codes, facts)
    same = luggage.body == normalized.fingerprint(target.morphology) and placing.ground is None
    needed = [each for each in luggage.travellers if not (same and each.name in luggage.found)]
    ways = normalized.ways_onto(stage, target, luggage, facts)
    there, behind = normalized.carry(with_points_for_balls(needed, target.morphology), ways)
    meanings = Meanings.of(target.path, target.morphology, facts.up)
    if not same:
        there = with_own_feet(there, meanings, target.morphology, luggage.motion.times)
    motion = _standing(luggage, target, there, facts.up, same)
    animation = normalized.author_animation(stage, target, motion)
    edit = normalized.edit_path(stage, target, "Retargeted")
    asked = _asked(luggage, there)
    placed, missing = normalized.place_travellers(stage, edit, target, animation, luggage, asked)
    return _Put(
        luggage,
        target,
        motion,
        animation,
        edit if stage.GetPrimAtPath(edit) else "",
        placed,
        (*luggage.left, *behind, *missing),
        _notes(luggage, target, same),
    )


def _standing(
    luggage: Luggage, target: Target, there: Sequence[Traveller], up: Floats, same: bool
) -> Motion:
    """Return a motion on a body; on another one than its own it stands on its footprints."""
    body, character = target.morphology, target.sitting.character
    motion = restore(luggage.motion, body, character.placement, up=up)
    if not same:
        motion = hinged(motion, body, character.body)
    prints = footprints_of(there, Meanings.of(target.path, body, up), motion.times)
    if same or not prints:
        return motion
    return stand(motion, character.placement, body, prints, up=up, body=character.body).motion


def _asked(luggage: Luggage, there: Sequence[Traveller]) -> list[Traveller]:
    """Return what is to be enforced: not what was found on a joint that the edit itself holds."""
    held = {each.constraint.joint for each in there if each.name not in luggage.found}
    return [
        each
        for each in there
        if each.name not in luggage.found or each.constraint.joint not in held
    ]


def _notes(luggage: Luggage, target: Target, same: bool) -> tuple[str, ...]:
    if not same:
        return ()
    count = len(luggage.found)
    return (
        f"<{target.path}> is the body that the motion is of, and gets it back as it was"
        + (f"; {count} contacts that were looked for on the way are not enforced" if count else ""),
    )


def _solved(
    overlay: Overlay, put: _Put, placing: Placing, say: Say
) -> tuple[Shot | None, Sequence[SolvedScene], tuple[str, ...]]:
    """Return what came along as it was read, its scenes solved, and what should be known."""
    from usdmotion import usd

    if not put.edit or not placing.enforce:
        return None, [], ()
    kinds = host().constraints
    read = usd.read_stage(
        overlay.stage, overlay.shot, edits=[put.edit], frames=None, cleaning=None, kinds=kinds
    )
    answers = solved_scenes(read, placing.solver, placing.options, say=say)
    notes = (note for each in answers.scenes for note in each.notes)
    return read, answers.scenes, (*read.warnings, *answers.notes, *notes)


def _report(
    put: _Put, recorded: Recorded | None, scenes: Sequence[SolvedScene], notes: tuple[str, ...]
) -> RetargetingReport:
    target, luggage = put.target, put.luggage
    codes = target.time_codes
    return RetargetingReport(
        source=luggage.source,
        skeleton=target.path,
        animation=put.animation,
        edit=put.edit,
        frames=len(codes),
        first=float(codes[0]),
        last=float(codes[-1]),
        leg_before=None if recorded is None else recorded.body.leg_length,
        leg=target.morphology.leg_length,
        mapped=mapped_of(luggage.motion, target.morphology),
        slides=_slid(put, recorded, scenes),
        travellers=travellers_of(put.there, put.left, luggage.found),
        edits=tuple(edit for each in scenes for edit in each.report().edits),
        notes=notes,
    )


def _slid(
    put: _Put, recorded: Recorded | None, scenes: Sequence[SolvedScene]
) -> tuple[SlideReport, ...]:
    """Return how far feet slide during their contacts, before and after."""
    character = replace(put.target.sitting.character, motion=put.motion)
    after = Cast.of([character])
    pose: WorldPose = after.positions, after.orientations
    if scenes:
        solved = scenes[0].motion(put.target.path)
        if solved.frame_count == after.frame_count:
            done = Cast.of([replace(character, motion=solved)])
            pose = done.positions, done.orientations
    before = None if recorded is None else Cast.of([recorded.character])
    was = {} if recorded is None else recorded.contacts
    contacts = [
        (part, was.get(name), now) for name, part, now in contacts_of_feet(put.there, put.meanings)
    ]
    return slides_of(before, after, pose, contacts)
