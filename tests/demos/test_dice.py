"""The dice have the contacts that they are said to have, and no others."""

from itertools import combinations, pairwise

import numpy as np
import pytest
from pxr import Usd, UsdGeom
from scipy.spatial.transform import Rotation

from usdmotion import demos
from usdmotion.demos import dice
from usdmotion.demos.rolling import CORNERS, EDGE, RATE

SLIDE = 0.008
"""How far a die in the air moves along the axis of its turn from frame to frame, at least [m]."""
GAP = 0.4
"""The longest time that detection bridges between contacts at one place [s]."""


@pytest.fixture(scope="module", params=["first", "second"])
def die(request):
    return getattr(dice, request.param)()


@pytest.fixture(scope="module")
def stage(tmp_path_factory):
    return Usd.Stage.Open(str(demos.build("dice", tmp_path_factory.mktemp("dice"))))


def frames(contact):
    return round(contact.start * RATE), round(contact.end * RATE)


def during(die, contact):
    first, last = frames(contact)
    chosen = slice(first, last + 1)
    return die.translations[chosen], Rotation.from_quat(die.rotations[chosen])


def along(die):
    """Return how a die turns from frame to frame, and how far it slides along the axis of that."""
    turns = Rotation.from_quat(die.rotations)
    steps = (turns[1:] * turns[:-1].inv()).as_rotvec()
    angles = np.linalg.norm(steps, axis=1)
    axes = steps / np.maximum(angles, 1e-9)[:, None]
    return angles, axes, np.abs((axes * np.diff(die.translations, axis=0)).sum(axis=1))


def test_there_are_as_many_frames_as_in_the_paper(die):
    assert len(die.times) == len(die.translations) == len(die.rotations) == 141
    assert die.contacts[-1].end == die.times[-1]


def test_every_kind_of_contact_occurs_on_each_die(die):
    assert {each.kind for each in die.contacts} == {"space", "line", "point"}


def test_what_is_held_stays_where_it_is(die):
    for contact in die.contacts:
        places, turns = during(die, contact)
        held = turns.apply(np.array(contact.point)) + places
        np.testing.assert_allclose(held, np.broadcast_to(contact.location, held.shape), atol=1e-12)


def test_a_space_contact_holds_the_whole_frame_and_others_do_not(die):
    for contact in die.contacts:
        _, turns = during(die, contact)
        turned = (turns[1:] * turns[:-1].inv()).magnitude()
        assert turned.max() < 1e-9 if contact.kind == "space" else turned.min() > np.radians(2.0)


def test_a_line_contact_turns_about_its_axis_alone(die):
    for contact in die.contacts:
        if contact.kind == "line":
            _, turns = during(die, contact)
            axis = np.tile(contact.axis, (len(turns), 1))
            inside = turns.inv().apply(axis)
            np.testing.assert_allclose(inside, np.broadcast_to(inside[0], axis.shape), atol=1e-12)


def test_the_axis_of_a_point_contact_is_another_on_every_frame(die):
    angles, axes, _ = along(die)
    for contact in die.contacts:
        if contact.kind == "point":
            first, last = frames(contact)
            cosines = (axes[first + 1 : last] * axes[first : last - 1]).sum(axis=1)
            assert np.degrees(np.arccos(cosines)).min() > 4.0
            assert np.degrees(angles[first:last]).min() > 2.0


def test_in_the_air_nothing_is_held(die):
    _, _, slides = along(die)
    held = np.zeros(len(slides), dtype=bool)
    for contact in die.contacts:
        held[slice(*frames(contact))] = True
    assert slides[~held].min() > SLIDE
    assert slides[held].max() < 1e-9


def distance(first, second):
    """Return how far two places are apart; lines are endless and lie on the carpet [m]."""
    lines = [each.axis for each in (first, second) if each.kind == "line"]
    if len(lines) == 2 and np.linalg.norm(np.cross(*lines)) > 1e-9:
        return 0.0
    apart = second.location - first.location
    return np.linalg.norm(np.cross(apart, lines[0]) if lines else apart)


def test_contacts_do_not_overlap(die):
    assert all(first.end <= second.start for first, second in pairwise(die.contacts))


def test_no_two_contacts_could_be_one(die):
    # A line that meets another, or a point, at the same time is a turn about what they share.
    turns = [each for each in die.contacts if each.kind != "space"]
    for first, second in pairwise(turns):
        assert second.start - first.end > GAP or distance(first, second) > 0.5 * EDGE


def test_a_die_is_never_in_the_carpet_and_stands_on_it_in_every_contact(die):
    lowest = die.corners()[..., 1].min(axis=1)
    assert lowest.min() > -1e-9
    for contact in die.contacts:
        first, last = frames(contact)
        assert lowest[first : last + 1].max() < 1e-9


def test_the_dice_keep_clear_of_each_other():
    apart = np.linalg.norm(dice.first().translations - dice.second().translations, axis=1)
    assert apart.min() > np.sqrt(3.0) * EDGE


def test_the_stage_shows_the_same_motion(stage):
    for name in ("First", "Second"):
        rolled = getattr(dice, name.lower())()
        body = UsdGeom.Mesh(stage.GetPrimAtPath(f"/Dice/{name}/Body"))
        points = np.array(body.GetPointsAttr().Get())
        np.testing.assert_allclose(points, 100.0 * CORNERS, atol=1e-5)
        for frame in (0, 40, 140):
            code = Usd.TimeCode(frame + dice.FIRST)
            matrix = np.array(body.ComputeLocalToWorldTransform(code))
            world = (np.c_[points, np.ones(8)] @ matrix)[:, :3]
            np.testing.assert_allclose(world, 100.0 * rolled.corners()[frame], atol=1e-5)


def test_the_faces_look_outwards_and_opposite_ones_make_seven(stage):
    body, pips = (
        UsdGeom.Mesh(stage.GetPrimAtPath(f"/Dice/First/{name}")) for name in ("Body", "Pips")
    )
    counts = {}
    for mesh in (body, pips):
        points = np.array(mesh.GetPointsAttr().Get())
        corners = np.array(mesh.GetFaceVertexIndicesAttr().Get())
        for face in corners.reshape(len(mesh.GetFaceVertexCountsAttr().Get()), -1):
            a, b, c = points[face[:3]]
            normal = np.cross(b - a, c - b)
            assert normal @ a > 0.0
            side = tuple(np.round(normal / np.linalg.norm(normal)).astype(int).tolist())
            counts[side] = counts.get(side, -1) + 1
    assert sorted(counts.values()) == [1, 2, 3, 4, 5, 6]
    for one, other in combinations(counts, 2):
        if np.dot(one, other) == -1:
            assert counts[one] + counts[other] == 7


def test_what_to_run_next_is_detection_and_not_a_solve(tmp_path):
    assert demos.following("dice", tmp_path / "dice.usda").startswith("usdmotion detect ")
    assert demos.following("reaching", tmp_path / "a.usda") == f"usdmotion solve {tmp_path}/a.usda"
