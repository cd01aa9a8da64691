"""Beside a contact a motion goes where it went, but for what lets it come to rest."""

import numpy as np
import pytest

from usdmotion.constraints import ContactConstraint, Space
from usdmotion.constraints.approach import FASTEST, gone, turned
from usdmotion.kernels import from_vector, multiply, rotate, to_vector
from usdmotion.testing import HUMANOID, humanoid_scene

TIMES = np.linspace(0.0, 2.0, 241)
KEYS = (0.4, 0.6, 1.2, 1.5)
HELD = (TIMES >= KEYS[1] - 1e-9) & (TIMES <= KEYS[2] + 1e-9)
COURSE = 0.2 * np.stack([np.sin(3.0 * TIMES), TIMES**2, np.cos(2.0 * TIMES)], axis=1)
TURNS = from_vector(3.5 * COURSE)


def at(time):
    return int(np.argmin(np.abs(TIMES - time)))


def test_nothing_is_gone_while_a_contact_holds_and_where_it_does_not_ease():
    assert not gone(TIMES, KEYS, COURSE)[HELD].any()
    assert np.array_equal(turned(TIMES, KEYS, TURNS)[HELD], np.tile([0, 0, 0, 1.0], (73, 1)))
    for keys in ((), KEYS[1:3]):
        assert not gone(TIMES, keys, COURSE).any()


def test_at_the_far_end_of_an_ease_it_is_as_far_as_the_motion_itself():
    far, away = gone(TIMES, KEYS, COURSE), turned(TIMES, KEYS, TURNS)
    for off, on in ((0, 1), (3, 2)):
        there, here = at(KEYS[off]), at(KEYS[on])
        np.testing.assert_allclose(far[there], COURSE[there] - COURSE[here], atol=1e-12)
        np.testing.assert_allclose(multiply(TURNS[here], away[there]), TURNS[there], atol=1e-12)


def test_it_comes_to_rest_and_sets_off_from_rest():
    speed = np.abs(np.gradient(COURSE, TIMES, axis=0))
    far = gone(TIMES, KEYS, COURSE)
    steps = np.abs(np.diff(far, axis=0)) / np.diff(TIMES)[:, None]
    turning = np.abs(np.diff(to_vector(turned(TIMES, KEYS, TURNS)), axis=0)) / TIMES[1]
    for first in (at(KEYS[1]) - 1, at(KEYS[2])):
        assert steps[first].max() < 0.1 * speed[first].max()
        assert turning[first].max() < 0.35 * speed[first].max()


def test_a_jump_of_the_motion_is_nothing_to_slow_down_from():
    jumping = COURSE + (TIMES < KEYS[1] - 1e-9)[:, None]
    here = at(KEYS[1])
    far = gone(TIMES, KEYS, jumping)
    slowed = far[:here] - (jumping[:here] - jumping[here])
    longest = FASTEST * (KEYS[1] - KEYS[0]) * 4.0 / 27.0
    assert np.linalg.norm(slowed, axis=1).max() <= longest + 1e-9


def test_what_rests_stays_where_it_is():
    still = np.tile(COURSE[7], (len(TIMES), 1))
    turns = np.tile(TURNS[7], (len(TIMES), 1))
    assert np.abs(gone(TIMES, KEYS, still)).max() < 1e-12
    assert np.abs(to_vector(turned(TIMES, KEYS, turns))).max() < 1e-9


def test_it_goes_along_wherever_the_motion_is():
    turn, shift = from_vector(np.array([0.4, -1.1, 0.3])), np.array([30.0, -5.0, 11.0])
    moved = rotate(np.broadcast_to(turn, TURNS.shape), COURSE) + shift
    far = gone(TIMES, KEYS, COURSE)
    wanted = rotate(np.broadcast_to(turn, TURNS.shape), far)
    np.testing.assert_allclose(gone(TIMES, KEYS, moved), wanted, atol=1e-12)
    away = turned(TIMES, KEYS, multiply(np.broadcast_to(turn, TURNS.shape), TURNS))
    np.testing.assert_allclose(away, turned(TIMES, KEYS, TURNS), atol=1e-12)


def test_an_end_between_two_samples_is_where_the_motion_is_between_them():
    line = TIMES[:, None] * np.array([1.0, 2.0, -1.0])
    keys = (0.4, 0.6037, 1.2049, 1.5)
    far = gone(TIMES, keys, line)
    for off, on in ((0, 1), (3, 2)):
        np.testing.assert_allclose(
            far[at(keys[off])], line[at(keys[off])] - keys[on] * line[-1] / 2.0, atol=1e-9
        )


@pytest.mark.parametrize("kind", ["space", "line", "point", "plane", "slide"])
@pytest.mark.parametrize("space", [Space(), Space(joint=(HUMANOID, "pelvis/spine/chest"))])
def test_part_of_a_clip_is_asked_what_the_whole_is(kind, space):
    scene = humanoid_scene(frame_count=48)
    times = scene.cast.times
    joint = next(token for _, token in scene.cast.joints if token.endswith("left_ankle"))
    contact = ContactConstraint(
        path="/Contact",
        skeleton=HUMANOID,
        joint=joint,
        kind=kind,
        times=(times[6] - 0.01, times[12] - 0.02, times[20] + 0.03, times[27]),
        location=np.array([0.1, 0.2, 0.3]),
        space=space,
    )
    frames = slice(23, 31)
    seen = contact.needs(times, frames)
    part = scene.during(seen).cast
    wanted, found = contact.demand(scene.cast), contact.demand(part)
    for whole, cut in zip(wanted.tasks, found.tasks, strict=True):
        inner = slice(frames.start - seen.start, frames.stop - seen.start)
        targets = (
            (whole.target, cut.target)
            if hasattr(whole, "target")
            else (whole.goals[0].rotation, cut.goals[0].rotation)
        )
        np.testing.assert_allclose(targets[1][inner], targets[0][frames], atol=1e-12)
