"""The way of a foot over the ground: from footprint to footprint, and clear of what is between."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Bools, Floats
from usdmotion.ground import Ground
from usdmotion.humanoid import ANKLE, BALL
from usdmotion.kernels import conjugate, multiply, rotate
from usdmotion.s4d.standing.ankles import Foot
from usdmotion.s4d.standing.footprints import Footprint, Stance, between
from usdmotion.s4d.standing.legs import Leg, Pose
from usdmotion.s4d.standing.soles import lie

_SAME = 0.04
"""A sole this near to the ground that a motion was made on stood on it [m]."""
_UNSURE = 0.03
"""Rest poses tell where soles are no better than this [m]."""
_SETTLES = 0.3
"""How long a foot takes after its last stance to swing as it stood in the middle of it [s]."""
_NONE = np.array((0.0, 0.0, 0.0, 1.0))


@dataclass(frozen=True, eq=False)
class Tread:
    """What moves a foot as it stands and swings."""

    stands: Bools
    """When it stands, shape (frame_count,)."""
    drawn: Floats
    """By how much it is moved [m], shape (frame_count, 3)."""
    turned: Floats
    """By what it is turned so that it stands as its footprints say, xyzw, (frame_count, 4)."""
    toes: Floats
    """By what its toes are, xyzw, shape (frame_count, 4)."""
    sloped: Floats
    """By what both are turned after that, to lie on the ground, xyzw, (frame_count, 4)."""
    contact: Floats
    """Where it touches the ground, seen from the joint that it stands on, before it is turned [m],
    shape (frame_count, 3)."""
    rises: Floats
    """How much higher the ground is than that which the motion was made on [m], (frame_count,)."""
    groundless: tuple[Footprint, ...] = ()
    """The footprints under which there is no ground."""

    def moved(self, leg: Leg, pose: Pose, up: Floats) -> Foot:
        """Return where the foot is to be."""
        stands_on, ankle = (pose.positions[:, joint] for joint in (leg.stands_on, leg.ankle))
        turn = multiply(self.sloped, self.turned)
        # It lies down about the place where it touches the ground.
        held = stands_on + self.drawn + self.contact - rotate(self.sloped, self.contact)
        ankle = held + rotate(turn, ankle - stands_on)
        toes = multiply(self.sloped, self.toes)
        return Foot(ankle, multiply(turn, pose.rotations[:, leg.ankle]), toes)


@dataclass(frozen=True)
class Level:
    """The ground that a motion was made on, and how feet stood on it."""

    height: float
    """Along the up axis [m]."""
    over: dict[str, float]
    """How high ankles, and balls, are over a sole that is on the ground [m], by their names."""
    flat: bool = True
    """Whether it is level; what is higher than the rest of it then stands on something."""

    @classmethod
    def of(
        cls,
        footprints: Sequence[Footprint],
        at_rest: dict[str, float],
        up: Floats,
    ) -> "Level":
        """Return it as footprints tell it: 0, or where soles are if that is farther away than rest
        poses are wrong. Where most footprints are at other heights than the middle one, as on
        stairs, it goes up and down with them, from the lowest.

        Args:
            footprints: Of both feet.
            at_rest: How high ankles and balls are over a sole on the ground at rest [m].
            up: The direction away from the ground.
        """
        found: dict[str, list[float]] = {name: [] for name in at_rest}
        for each in (one for one in footprints if one.part[2:] in found):
            found[each.part[2:]].append(float(each.place @ up))
        soles = [z - at_rest[name] for name, heights in found.items() for z in heights]
        beside = [z - np.median(heights) for heights in found.values() for z in heights]
        if beside and np.mean(np.abs(beside) <= _SAME) < 0.5:
            return cls(min(soles), dict(at_rest), flat=False)
        middle = float(np.median(soles)) if soles else 0.0
        made_on = 0.0 if abs(middle) <= _UNSURE else middle
        over = {
            name: max(float(np.median(heights)) - made_on, 0.0) if heights else at_rest[name]
            for name, heights in found.items()
        }
        return cls(made_on, over)

    def above(self, footprint: Footprint, up: Floats) -> float:
        """Return how high a joint is to be over the ground under its footprint [m].

        That is as high as in any other footprint, or as high as it was on something that stood
        on that ground.
        """
        usual = self.over[footprint.part[2:]]
        if not self.flat:
            return usual
        own = float(footprint.place @ up) - self.height
        return usual if abs(own - usual) <= _SAME else own


def treads_of(
    pose: Pose,
    legs: Sequence[Leg],
    stances: Sequence[Sequence[Stance]],
    level: Level,
    ground: Ground | None,
    *,
    times: Floats,
    up: Floats,
) -> list[Tread]:
    """Return the ways of both feet from footprint to footprint.

    Args:
        pose: The motion in the world.
        legs: Both.
        stances: Of each leg.
        level: The ground that the motion was made on.
        ground: What to stand on; None is the ground that the motion was made on.
        times: Seconds, shape (frame_count,).
        up: The direction away from the ground, shape (3,).
    """
    laid: list[list[_Laid]] = [[] for _ in legs]
    order = sorted(
        (int(each.frames.argmax()), foot, each) for foot, own in enumerate(stances) for each in own
    )
    risen = 0.0
    for _, foot, stance in order:
        one = _laid(pose, legs[foot], stance, level, ground, risen, times, up)
        laid[foot].append(one)
        if one.found:  # over a hole a foot does not forget how high it has climbed
            risen = float(one.rises[-1])
    return [
        _tread(pose, leg, own, -level.over[leg.stands_by] * up, times)
        for leg, own in zip(legs, laid, strict=True)
    ]


@dataclass(frozen=True, eq=False)
class _Laid:
    """A stance on the ground; everything is shape (stance_frame_count, …)."""

    stance: Stance
    drawn: Floats
    sloped: Floats
    contact: Floats
    rises: Floats
    """How much higher the ground is under it than that which the motion was made on [m]."""
    found: bool
    """Whether there is ground."""


def _laid(
    pose: Pose,
    leg: Leg,
    stance: Stance,
    level: Level,
    ground: Ground | None,
    risen: float,
    times: Floats,
    up: Floats,
) -> _Laid:
    """Return a stance on the ground under it, no higher than a step above where feet are now."""
    frames, footprint = stance.frames, stance.footprint
    joint = leg.ankle if footprint.part.endswith(ANKLE) else leg.stands_on
    drawn = stance.drawn(pose.positions[:, joint])
    level_turns = np.broadcast_to(_NONE, (len(drawn), 4))
    if ground is None:
        return _Laid(stance, drawn, level_turns, np.zeros_like(drawn), np.zeros(len(drawn)), True)
    contact = footprint.place - level.above(footprint, up) * up
    heading = leg.heading(pose.rotations[frames], up).mean(axis=0)
    heading /= max(float(np.linalg.norm(heading)), 1e-9)
    shape = (len(drawn), 3)
    lying = lie(
        ground,
        np.broadcast_to(contact + risen * up, shape),
        np.broadcast_to(heading, shape),
        leg.sole_from(joint),
        times[frames],
        up,
    )
    known = ~np.isnan(lying.heights)
    if known.mean() < 0.5:
        return _Laid(stance, drawn, level_turns, np.zeros_like(drawn), np.zeros(len(drawn)), False)
    heights = between(times[frames], known, lying.heights)
    rises = heights - contact @ up
    below = contact - (pose.positions[frames, leg.stands_on] + drawn)
    return _Laid(stance, drawn + rises[:, None] * up, lying.turns, below, rises, True)


def _tread(pose: Pose, leg: Leg, laid: Sequence[_Laid], below: Floats, times: Floats) -> Tread:
    """Return the way of one foot.

    Args:
        pose: The motion in the world.
        leg: Which.
        laid: Its stances.
        below: Where its sole is as it swings, seen from the joint that it stands on [m].
        times: Seconds, shape (frame_count,).
    """
    count = len(times)
    stands, drawn = np.zeros(count, dtype=np.bool_), np.zeros((count, 3))
    sloped, off = np.tile(_NONE, (count, 1)), np.zeros((count, 3))
    rises = np.zeros(count)
    for each in laid:
        stands |= each.stance.frames
        drawn[each.stance.frames] = each.drawn
        sloped[each.stance.frames] = each.sloped
        off[each.stance.frames] = each.contact - below
        rises[each.stance.frames] = each.rises
    if stands.any():
        drawn, sloped, off, rises = (
            between(times, stands, each) for each in (drawn, sloped, off, rises)
        )
    ankles = [one for each in laid for one in each.stance.turned]
    balls = [each.stance.footprint for each in laid if each.stance.footprint.part.endswith(BALL)]
    turned = _as_told(ankles, pose.rotations[:, leg.ankle], times)
    toes = _as_told(balls, pose.rotations[:, leg.stands_on], times)
    turned = np.tile(_NONE, (count, 1)) if turned is None else turned
    toes = turned if toes is None or leg.ball is None else toes
    drawn = _settled(drawn, laid, times)
    groundless = tuple(each.stance.footprint for each in laid if not each.found)
    return Tread(stands, drawn, turned, toes, sloped, below + off, rises, groundless)


def _as_told(footprints: Sequence[Footprint], turns: Floats, times: Floats) -> Floats | None:
    """Return by what a joint is turned to be as its footprints say; None if they say nothing.

    Args:
        footprints: Those of the joint.
        turns: How it is turned in the motion, xyzw, shape (frame_count, 4).
        times: Seconds, shape (frame_count,).
    """
    said, turned = np.zeros(len(times), dtype=np.bool_), np.tile(_NONE, (len(times), 1))
    for each in footprints:
        if each.rotation is not None:
            held = each.during(times)
            said |= held
            turned[held] = multiply(each.rotation, conjugate(turns[held]))
    return between(times, said, turned) if said.any() else None


def _settled(drawn: Floats, laid: Sequence[_Laid], times: Floats) -> Floats:
    """Return how a foot is moved, with what only its last instants asked for left behind.

    Before its first stance and after its last one a foot goes on as it stood there in the middle: a
    foot that is small for its leg rolls off nearer to the ground than it swings.
    """
    settled = np.array(drawn)
    for each, back in ((laid[0], True), (laid[-1], False)) if laid else ():
        frames = np.flatnonzero(each.stance.frames)
        edge = frames[0] if back else frames[-1]
        beyond = slice(None, edge) if back else slice(edge + 1, None)
        s = np.clip(np.abs(times[beyond] - times[edge]) / _SETTLES, 0.0, 1.0)
        s = (s * s * (3.0 - 2.0 * s))[:, None]
        settled[beyond] = drawn[edge] + s * (np.median(each.drawn, axis=0) - drawn[edge])
    return settled
