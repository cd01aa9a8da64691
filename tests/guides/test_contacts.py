"""What is drawn of a contact is where it is held, whatever its kind."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from usdmotion.demos import dice
from usdmotion.demos.rolling import CORNERS, EDGE, RATE
from usdmotion.guides import Held, apart, contact_guide, size_of, trajectory

RIGHT, UP = np.array((1.0, 0.0, 0.0)), np.array((0.0, 1.0, 0.0))


def held_of(rolled, contact):
    first, last = round(contact.start * RATE), round(contact.end * RATE) + 1
    return Held(
        kind=contact.kind,
        point=contact.point,
        location=contact.location,
        orientation=contact.orientation,
        axis=contact.axis,
        translations=rolled.translations[first:last],
        rotations=rolled.rotations[first:last],
        way=rolled.translations[max(first - 4, 0) : last + 4],
    )


def drawn(kind):
    """Return the contacts of a kind of both dice, with what is drawn of them."""
    for rolled in (dice.first(), dice.second()):
        for contact in rolled.contacts:
            if contact.kind == kind:
                held = held_of(rolled, contact)
                yield held, contact_guide(held, CORNERS, 12, RIGHT, UP)


def turned(rotation, vectors):
    return Rotation.from_quat(rotation).apply(np.array(vectors))


def test_of_a_space_contact_all_points_of_the_object_are_marked_where_they_stay():
    for held, guide in drawn("space"):
        for translation, rotation in zip(held.translations, held.rotations, strict=True):
            there = turned(rotation, CORNERS) + translation
            gaps = np.linalg.norm(there[:, None] - guide.marks, axis=2)
            assert gaps.shape == (8, 8)
            assert gaps.min(axis=0).max() < 1e-9 > gaps.min(axis=1).max()


@pytest.mark.parametrize("kind", ["line", "point"])
def test_of_others_the_point_that_is_held(kind):
    for held, guide in drawn(kind):
        np.testing.assert_array_equal(guide.marks, held.location[None])


def test_an_axis_is_drawn_through_its_place_and_beyond_the_object():
    for held, guide in drawn("line"):
        ends = guide.axis - held.location
        np.testing.assert_allclose(np.cross(ends, held.axis), 0.0, atol=1e-12)
        low, high = sorted(ends @ held.axis)
        assert low < -0.5 * EDGE
        assert high > 0.5 * EDGE


@pytest.mark.parametrize("kind", ["space", "point"])
def test_what_has_no_axis_has_none_drawn(kind):
    assert all(not len(guide.axis) for _, guide in drawn(kind))


@pytest.mark.parametrize("kind", ["space", "line", "point"])
def test_the_ghost_stands_in_a_pose_of_the_contact(kind):
    for held, guide in drawn(kind):
        point = turned(guide.rotation, held.point) + guide.translation
        np.testing.assert_allclose(point, held.location, atol=1e-9)


@pytest.mark.parametrize("kind", ["space", "line", "point"])
def test_a_number_is_read_above_the_object(kind):
    for held, guide in drawn(kind):
        ghost = turned(guide.rotation, CORNERS) + guide.translation
        strokes = np.concatenate(guide.number)
        assert strokes[:, 1].min() > ghost[:, 1].max()
        np.testing.assert_allclose(strokes[:, 2], held.location[2])
        assert guide.number[0][:, 0].max() < guide.number[1][:, 0].min()


def slide(kind, axis):
    """Return what slides by 0.3 m along X."""
    places = np.linspace((1.0, 0.5, 2.0), (1.3, 0.5, 2.0), 10)
    still = np.array((0.0, 0.0, 0.0, 1.0))
    return Held(
        kind=kind,
        point=np.zeros(3),
        location=places[0],
        orientation=still,
        axis=np.array(axis),
        translations=places,
        rotations=np.tile(still, (10, 1)),
        way=places,
    )


def test_a_slide_is_drawn_as_far_as_it_goes():
    axis = contact_guide(slide("slide", (1.0, 0.0, 0.0)), CORNERS, 1, RIGHT, UP).axis
    assert axis[:, 0].min() < 1.0
    assert axis[:, 0].max() > 1.3
    np.testing.assert_allclose(axis[:, 1:], [(0.5, 2.0)] * 2)


def test_a_plane_is_an_outline_in_it_around_all_places():
    outline = contact_guide(slide("plane", (0.0, 2.0, 0.0)), CORNERS, 1, RIGHT, UP).axis
    np.testing.assert_allclose(outline[:, 1], 0.5)
    np.testing.assert_array_equal(outline[0], outline[-1])
    assert (outline.min(axis=0)[[0, 2]] < (1.0, 2.0)).all()
    assert (outline.max(axis=0)[[0, 2]] > (1.3, 2.0)).all()


def test_what_is_drawn_goes_with_the_world():
    turn, shift = Rotation.from_rotvec((0.0, 0.7, 0.0)), np.array((30.0, 0.0, -20.0))

    def go(points):
        return turn.apply(np.array(points)) + shift

    for held, guide in drawn("line"):
        moved = replace(
            held,
            location=go(held.location),
            axis=turn.apply(np.array(held.axis)),
            translations=go(held.translations),
            rotations=(turn * Rotation.from_quat(held.rotations)).as_quat(),
            way=go(held.way),
        )
        there = contact_guide(moved, CORNERS, 12, turn.apply(RIGHT), UP)
        for name in ("marks", "axis"):
            expected = go(getattr(guide, name))
            np.testing.assert_allclose(getattr(there, name), expected, atol=1e-9)
        np.testing.assert_allclose(
            np.concatenate(there.number), go(np.concatenate(guide.number)), atol=1e-9
        )


def test_an_object_that_is_a_point_has_a_size_all_the_same():
    assert size_of(np.zeros((1, 3))) > 0.0
    assert size_of(CORNERS) == pytest.approx(np.sqrt(0.75) * EDGE)


def test_the_trajectory_has_few_points_and_is_where_the_object_was():
    rolled = dice.first()
    way = trajectory(rolled.translations, CORNERS)
    assert len(way) < 0.6 * len(rolled.times)
    assert all((point == rolled.translations).all(axis=1).any() for point in way)


def test_numbers_of_contacts_at_one_place_are_read_one_above_the_other():
    ((_, guide), *_) = drawn("space")
    lifted = apart([guide] * 3, UP)
    tops = [np.concatenate(each.number)[:, 1].max() for each in lifted]
    feet = [np.concatenate(each.number)[:, 1].min() for each in lifted]
    assert all(top < foot for top, foot in zip(tops[:-1], feet[1:], strict=True))


def test_a_number_that_is_alone_stays():
    ((_, guide), *_) = drawn("space")
    (lifted,) = apart([guide], UP)
    np.testing.assert_allclose(np.concatenate(lifted.number), np.concatenate(guide.number))


def test_above_a_heap_of_contacts_numbers_stay_near():
    ((_, guide), *_) = drawn("space")
    lifted = apart([guide] * 60, UP)
    height = np.ptp(np.concatenate(guide.number)[:, 1])
    tops = [np.concatenate(each.number)[:, 1].max() for each in lifted]
    assert max(tops) - min(tops) < 15.0 * height


@pytest.mark.parametrize(("ground", "sole"), [(0.02, 0.0), (-0.02, 0.0), (0.4, 0.4)])
def test_a_sole_is_on_the_plane_of_the_origin_where_joints_are_just_above_it(ground, sole):
    ankle, toes = np.array((0.3, 0.08, 0.1)), np.array((0.0, -0.08, 0.2))
    still = Held(
        kind="space",
        point=np.zeros(3),
        location=ankle + ground * UP,
        orientation=np.array((0.0, 0.0, 0.0, 1.0)),
        axis=np.zeros(3),
        translations=(ankle + ground * UP)[None],
        rotations=np.array(((0.0, 0.0, 0.0, 1.0),)),
        way=(ankle + ground * UP)[None],
        is_foot=True,
        ground=ground,
    )
    drawn = contact_guide(still, np.array((np.zeros(3), toes)), 1, RIGHT, UP)
    np.testing.assert_allclose(drawn.sole @ UP, sole, atol=1e-9)
