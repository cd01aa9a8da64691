"""The input of a scene, cleaned before anything is asked of it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from usdmotion.arrays import Bools, Floats
from usdmotion.cast import Cast, Character
from usdmotion.cleaning.account import Cleaning, Held, Replaced
from usdmotion.cleaning.contacts import Rests, find_rests, holds, places_of
from usdmotion.cleaning.outliers import Outliers, find_outliers, without
from usdmotion.kernels.rotations import normalize
from usdmotion.motion import Motion
from usdmotion.scene import Edit, Scene
from usdmotion.smoothing import low_pass
from usdmotion.solving import Problem, Solution


@dataclass(frozen=True, eq=False)
class _Work:
    """One edit's character on its way."""

    edit: Edit
    given: Character
    """As it was read."""
    outliers: Outliers
    whole: Character
    """Without outliers."""
    filtered: Character
    """And low-passed."""
    rests: tuple[Rests, ...]
    """What was at rest in it before it was, and where; nothing where it was not."""


def cleaned(
    scene: Scene, solve: Callable[[Problem], Solution]
) -> tuple[Scene, dict[str, Cleaning]]:
    """Return a scene whose edits start from cleaned motions, and what was done for each edit.

    Outliers are replaced, then rotations and translations are low-passed. What the filter moves
    where a foot was at rest is put right by a solve of its own, before anything else is asked
    for. Edits that do not ask for it keep their motions.

    Args:
        scene: What was read.
        solve: Brings feet back to where they stood.
    """
    works = [_begun(scene, edit) for edit in scene.edits if edit.cleaning > 0.0]
    if not works:
        return scene, {}
    filtered = _with(scene, {each.edit.skeleton: each.filtered for each in works})
    asked = _asking(filtered, works)
    done = filtered
    if asked.constraints:
        solution = solve(Problem.of(asked))
        done = _with(
            filtered, {each.edit.skeleton: _solved(asked, each, solution) for each in works}
        )
    return done, {each.edit.path: _told(each, done) for each in works}


def low_passed(motion: Motion, cutoff: float) -> Motion:
    """Return a motion without what is faster than a frequency.

    The components of quaternions are filtered and brought back to length one. That is the chordal
    mean to first order, does not depend on any frame, and leaves an even turn as it is however
    fast it is. What does not move at all keeps its bits.

    Args:
        motion: What to filter.
        cutoff: Frequency at which half the amplitude is left [Hz]; a motion whose samples hold
            nothing above it comes back as it is.
    """
    translations, rotations = np.array(motion.translations), np.array(motion.rotations)
    moving, turning = _changes(translations), _changes(rotations)
    frames, signed = motion.frame_count, _without_flips(rotations[:, turning])
    given = np.concatenate(
        [signed.reshape(frames, -1), translations[:, moving].reshape(frames, -1)], axis=1
    )
    filtered = low_pass(motion.times, given, cutoff) if given.size else given
    if filtered is given:
        return motion
    rotations[:, turning] = normalize(filtered[:, : signed[0].size].reshape(signed.shape))
    translations[:, moving] = filtered[:, signed[0].size :].reshape(frames, -1, 3)
    return Motion(motion.times, translations, rotations)


def _begun(scene: Scene, edit: Edit) -> _Work:
    """Return what the filters make of a character, and where it rests."""
    given = scene.character(edit.skeleton)
    outliers = find_outliers(given.motion)
    whole = given
    if outliers.either.any():
        whole = replace(given, motion=without(given.motion, outliers))
    motion = low_passed(whole.motion, edit.cleaning)
    if motion is whole.motion:
        return _Work(edit, given, outliers, whole, whole, ())
    filtered = replace(given, motion=motion)
    return _Work(edit, given, outliers, whole, filtered, find_rests(whole))


def _asking(filtered: Scene, works: Sequence[_Work]) -> Scene:
    """Return a scene in which nothing is asked for but that what was at rest is where it was."""
    asked = {each.edit.path: holds(each.rests, each.filtered, each.edit) for each in works}
    edits = (replace(edit, constraints=asked.get(edit.path, ())) for edit in filtered.edits)
    return replace(filtered, edits=tuple(edits))


def _solved(asked: Scene, work: _Work, solution: Solution) -> Character:
    if not work.rests:
        return work.filtered
    nodes = asked.nodes(work.edit.skeleton)
    motion = Motion(asked.times, solution.translations[:, nodes], solution.rotations[:, nodes])
    return replace(work.filtered, motion=motion)


def _told(work: _Work, done: Scene) -> Cleaning:
    """Return what was done to the input of an edit."""
    final = done.character(work.edit.skeleton)
    counts = work.outliers.either.sum(axis=0)
    joints = work.given.skeleton.joints
    apart = np.linalg.norm(_places(final) - _places(work.given), axis=-1)
    apart[work.outliers.either.any(axis=1)] = 0.0
    frame, joint = np.unravel_index(apart.argmax(), apart.shape)
    moved = float(apart[frame, joint])
    return Cleaning(
        cutoff=work.edit.cleaning,
        low_passed=work.filtered is not work.whole,
        replaced=tuple(
            Replaced(joints[each], int(counts[each])) for each in np.flatnonzero(counts)
        ),
        moved=moved,
        moved_joint=joints[joint] if moved > 0.0 else "",
        moved_time=float(done.time_codes[frame]) if moved > 0.0 else None,
        feet_known=work.given.parts is not None,
        held=tuple(
            Held(
                each.joint,
                len(each.spans),
                each.slide(each.places),
                each.slide(places_of(final, each.joint)),
            )
            for each in work.rests
        ),
    )


def _with(scene: Scene, characters: dict[str, Character]) -> Scene:
    """Return a scene with some characters exchanged."""
    return replace(
        scene, characters=tuple(characters.get(each.path, each) for each in scene.characters)
    )


def _places(character: Character) -> Floats:
    """Return where the joints are in the world [m], shape (frame_count, joint_count, 3)."""
    return Cast.of([character]).positions[:, 1:]


def _changes(values: Floats) -> Bools:
    """Return which joints change over time, shape (joint_count,)."""
    return np.asarray((values != values[:1]).any(axis=(0, 2)))


def _without_flips(rotations: Floats) -> Floats:
    """Return the same rotations with signs that do not jump from frame to frame."""
    flips = np.einsum("fji,fji->fj", rotations[1:], rotations[:-1]) < 0.0
    signs = np.where(np.cumsum(flips, axis=0) % 2, -1.0, 1.0)
    signs = np.concatenate([np.ones((1, rotations.shape[1])), signs])
    return rotations * signs[..., None]
