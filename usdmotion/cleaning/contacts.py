"""Where feet stand in the input, and what keeps them there when the input is filtered."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Bools, Floats
from usdmotion.cast import Cast, Character
from usdmotion.constraints import Goal, PositionConstraint
from usdmotion.curves import ease
from usdmotion.humanoid import FEET
from usdmotion.scene import Edit

WINDOW = 0.2
"""How long a joint has to be at rest [s]."""
SPREAD = 0.005
"""How far it may be from its mean place meanwhile, root mean square [m]."""
_FADE = 0.1
"""How long before and after a rest what it takes to hold it fades [s]."""
_SMOOTHED = 1.5
"""Over how many periods of the cutoff the places of a rest are smoothed."""


@dataclass(frozen=True, eq=False)
class Rests:
    """When a joint is at rest in a motion, and where it is."""

    joint: str
    """Token of the joint."""
    times: Floats
    """Ascending [s], shape (frame_count,)."""
    places: Floats
    """In the world [m], shape (frame_count, 3)."""
    when: Bools
    """Shape (frame_count,)."""

    @property
    def spans(self) -> list[slice]:
        """The frames of each rest."""
        edges = np.diff(np.pad(self.when.astype(np.int8), 1))
        pairs = zip(np.flatnonzero(edges > 0), np.flatnonzero(edges < 0), strict=True)
        return [slice(int(first), int(end)) for first, end in pairs]

    def slide(self, places: Floats) -> float:
        """Return how far something at some places moves in all the rests together [m]."""
        steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
        return float(steps[self.when[1:] & self.when[:-1]].sum())


def find_rests(character: Character) -> tuple[Rests, ...]:
    """Return the rests of ankles and balls of the feet, the deepest in the hierarchy first.

    Of a character whose feet are not known there are none.
    """
    feet = [character.parts.joint(part) for part in FEET] if character.parts else []
    found = []
    for foot in (joint for joint in feet if joint is not None):
        name = character.skeleton.joints[foot]
        places = places_of(character, name)
        when = at_rest(character.motion.times, places)
        if when.any():
            found.append(Rests(name, character.motion.times, places, when))
    return tuple(sorted(found, key=lambda each: -_depth(character, each.joint)))


def places_of(character: Character, joint: str) -> Floats:
    """Return where a joint is in the world [m], shape (frame_count, 3)."""
    cast = Cast.of([character])
    return cast.positions[:, cast.index[(character.path, joint)]]


def at_rest(times: Floats, places: Floats) -> Bools:
    """Return the frames on which a point is at rest, shape (frame_count,).

    It is where, for `WINDOW`, the root mean square of its distances from their mean place is at
    most `SPREAD`. What noise adds to that is taken off before: of independent errors of variance
    σ², second differences have the variance 6 σ². The outer quarters of a window are left out,
    because there it may be setting down or leaving already.

    Args:
        times: Ascending [s], shape (frame_count,).
        places: World positions [m], shape (frame_count, 3).
    """
    from scipy.ndimage import binary_dilation, uniform_filter1d  # slow to import, seldom needed

    half = round(0.5 * WINDOW / _gap(times)) if len(times) > 1 else 0
    if half < 1 or len(times) <= 2 * half:
        return np.zeros(len(times), dtype=np.bool_)
    size, near = 2 * half + 1, places - np.median(places, axis=0)
    mean = uniform_filter1d(near, size, axis=0, mode="reflect")
    square = uniform_filter1d(np.sum(near**2, axis=1), size, mode="reflect")
    bends = np.pad(np.diff(near, n=2, axis=0), ((1, 1), (0, 0)))
    noise = uniform_filter1d(np.sum(bends**2, axis=1), size, mode="reflect") / 6.0
    quiet = square - np.sum(mean**2, axis=1) - noise <= SPREAD**2
    return np.asarray(binary_dilation(quiet, np.ones(2 * (half // 2) + 1, dtype=np.bool_)))


def holds(
    found: Sequence[Rests], filtered: Character, edit: Edit
) -> tuple[PositionConstraint, ...]:
    """Return the constraints that hold joints where they were at rest, and leave them else.

    At rest the goal is the place in the input, smoothed with nothing from outside the rest: where
    the input stands so does the goal, where it drifts the goal drifts too. How far that is from the
    filtered motion fades over `_FADE` before and after, and there is none beyond. What is deeper in
    the hierarchy ranks higher, so that the ball of a foot stands still while the heel rises. Only
    joints that turn in the input and are below the root are recruited: the body does not move.

    Args:
        found: The rests in the input.
        filtered: The character as the filter has left it.
        edit: Whose constraints they are to be, and whose cutoff the smoothing takes.
    """
    ranks = sorted({-_depth(filtered, each.joint) for each in found})
    return tuple(
        PositionConstraint(
            path=f"{edit.path}, cleaning {each.joint}",
            skeleton=edit.skeleton,
            joint=each.joint,
            priority=1 + ranks.index(-_depth(filtered, each.joint)),
            recruits=_recruits(filtered, each.joint),
            goals=(Goal(translation=_goal(each, places_of(filtered, each.joint), edit.cleaning)),),
        )
        for each in found
    )


def _goal(rests: Rests, filtered: Floats, cutoff: float) -> Floats:
    """Return where a joint is to be [m], shape (frame_count, 3)."""
    away = np.zeros_like(filtered)
    for span in rests.spans:
        away[span] = _smoothed(rests.times[span], rests.places[span], cutoff) - filtered[span]
    frames, index = np.flatnonzero(rests.when), np.arange(len(filtered))
    before = frames[np.maximum(np.searchsorted(frames, index, side="right") - 1, 0)]
    after = frames[np.minimum(np.searchsorted(frames, index), len(frames) - 1)]
    since, until = (np.abs(rests.times - rests.times[each]) for each in (before, after))
    # Of two rests that follow each other soon, what the first asks for has faded half-way.
    reach = np.where(before < after, np.minimum(_FADE, 0.5 * (since + until)), _FADE)
    share = ease(np.minimum(since, until) / reach, (0.0, 0.0, 0.0, 1.0))
    return filtered + share[:, None] * away[np.where(since <= until, before, after)]


def _smoothed(times: Floats, places: Floats, cutoff: float) -> Floats:
    """Return places smoothed by parabolas (Savitzky and Golay 1964), one-sided at the ends."""
    from scipy.signal import savgol_filter  # slow to import, seldom needed

    half = max(round(0.5 * _SMOOTHED / cutoff / _gap(times)), 2) if len(times) > 4 else 0
    half = min(half, (len(times) - 1) // 2)
    return np.asarray(savgol_filter(places, 2 * half + 1, 2, axis=0)) if half else places


def _recruits(character: Character, held: str) -> tuple[str, ...]:
    """Return the joints from one that is held up to the root that turn, and not the root itself."""
    skeleton, turns = character.skeleton, character.motion.rotations
    chain = [
        joint
        for joint in skeleton.chain(skeleton.index[held])
        if character.root in skeleton.chain(joint)[1:]
        and (turns[1:, joint] != turns[0, joint]).any()
    ]
    return tuple(skeleton.joints[joint] for joint in chain)


def _depth(character: Character, joint: str) -> int:
    skeleton = character.skeleton
    return len(skeleton.chain(skeleton.index[joint]))


def _gap(times: Floats) -> float:
    """Return the usual time between two samples [s]."""
    return float(np.median(np.diff(times)))
