"""Lines and points: found where an axis stays, and nowhere else."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from usdmotion_contacts.pattern import constant

from usdmotion import Search, Template

AXIS = np.array([1.0, 2.0, -2.0]) / 3.0
SECONDS = np.arange(241) / 60.0


def swinging() -> Rotation:
    """Return four seconds to and fro about one axis."""
    return Rotation.from_rotvec(0.8 * np.sin(2.7 * SECONDS + 0.3)[:, None] * AXIS)


def rolling() -> Rotation:
    """Return four seconds of turns about changing axes."""
    angles = [0.5 * np.sin(3.0 * SECONDS), 0.4 * np.sin(2.1 * SECONDS + 1.0), np.cos(SECONDS)]
    return Rotation.from_rotvec(np.stack(angles, axis=1))


def test_a_hinge_is_one_line_although_it_turns_to_and_fro(detect, held) -> None:
    search = held(swinging())
    (line,) = detect(search).contacts
    assert (line.kind, line.start, line.end) == ("line", 0.0, search.times[-1])
    assert abs(line.axis @ AXIS) == pytest.approx(1.0)
    assert line.residual < 1e-9
    # Its point is the one of the axis that is nearest to the object.
    expected = np.array((0.1, 0.2, 0.0))
    assert np.allclose(line.point, expected - AXIS * (AXIS @ expected), atol=1e-9)
    assert np.allclose(np.cross(line.location - (1.0, 2.0, 3.0), AXIS), 0.0, atol=1e-9)


def test_a_ball_joint_is_one_point(detect, held) -> None:
    (point,) = detect(held(rolling())).contacts
    assert (point.kind, point.start, point.end) == ("point", 0.0, 4.0)
    assert np.allclose(point.point, (0.1, 0.2, 0.0), atol=1e-9)
    assert np.allclose(point.location, (1.0, 2.0, 3.0), atol=1e-9)


@pytest.mark.parametrize(("turns", "kind"), [(swinging(), "line"), (rolling(), "point")])
def test_noise_does_not_cut_them(detect, held, turns, kind) -> None:
    search = held(turns, noise=3e-4, templates=(Template(kind, 0.5, 1.0),))
    (contact,) = detect(search).contacts
    assert contact.kind == kind
    assert contact.end - contact.start > 3.9
    assert np.linalg.norm(np.cross(contact.location - (1.0, 2.0, 3.0), AXIS)) < 0.003 or (
        kind == "point" and np.linalg.norm(contact.location - (1.0, 2.0, 3.0)) < 0.003
    )


def test_what_flies_and_spins_has_an_axis_at_every_moment_and_no_contact(detect) -> None:
    way = np.stack([SECONDS, SECONDS - 0.3 * SECONDS**2, 0.0 * SECONDS], axis=1)
    turns = Rotation.from_rotvec(np.outer(3.0 * SECONDS, (0.0, 0.0, 1.0)))
    search = Search(
        name="die", times=SECONDS, translations=way, rotations=turns.as_quat(),
        kinds=("line", "point"), pattern=constant(1e-5, 1e-5),
    )  # fmt: skip
    assert not detect(search).contacts


def test_without_points_asked_for_a_ball_joint_is_none(detect, held) -> None:
    kinds = {each.kind for each in detect(held(rolling(), kinds=("line",))).contacts}
    assert kinds <= {"line"}
    (point,) = detect(held(rolling(), kinds=("point",))).contacts
    assert point.kind == "point"


def test_lines_that_meet_are_a_point(detect, held) -> None:
    first = Rotation.from_rotvec(np.outer(np.linspace(0.0, 1.0, 40), (0.0, 0.0, 1.0)))
    then = Rotation.from_rotvec(np.outer(np.linspace(0.0, 1.0, 40)[1:], (0.0, 1.0, 0.0)))
    turns = Rotation.concatenate([first, then * first[-1]])
    (point,) = detect(held(turns)).contacts
    assert point.kind == "point"
    assert np.allclose(point.location, (1.0, 2.0, 3.0), atol=1e-9)
    first_line, second_line = detect(held(turns, kinds=("line",))).contacts
    # The step across the corner turns about something between the two.
    assert np.allclose(first_line.axis, (0.0, 0.0, 1.0), atol=0.01)
    assert np.allclose(second_line.axis, (0.0, 1.0, 0.0), atol=0.01)


def test_a_line_and_another_beside_it_stay_two(detect, held) -> None:
    turn = Rotation.from_rotvec(np.outer(np.linspace(0.0, 1.0, 40), (0.0, 0.0, 1.0)))
    one = held(turn)
    far = np.array((0.0, 0.035, 0.0))
    place = np.array((1.0, 2.0, 3.0)) + turn[-1].apply(far)
    back = held(turn[::-1], point=(0.1, 0.235, 0.0), place=place)
    search = Search(
        name="door", times=np.arange(79) / 60.0, kinds=("line",), pattern=one.pattern,
        translations=np.concatenate([one.translations, back.translations[1:]]),
        rotations=np.concatenate([one.rotations, back.rotations[1:]]),
    )  # fmt: skip
    first, second = detect(search).contacts
    assert np.allclose(second.point - first.point, far, atol=1e-9)
    assert first.end == pytest.approx(second.start, abs=0.02)


def test_what_swings_about_something_far_from_it_touches_nothing(detect, held) -> None:
    corners = np.array([[0.0, 0.0, 0.0], [0.1, 0.1, 0.1]])
    assert len(detect(held(swinging(), points=corners + np.array([0.1, 0.2, 0.0]))).contacts) == 1
    far = held(swinging(), points=corners + np.array([0.6, 0.2, 0.5]))
    assert not detect(far).contacts
    assert len(detect(far, reach=10.0).contacts) == 1
    assert len(detect(far, reach=0.0).contacts) == 1


def jolted(search: Search, *frames: int) -> Search:
    """Return the motion with some frames somewhere else."""
    places = np.array(search.translations)
    places[list(frames)] += (0.2, -0.3, 0.1)
    return replace(search, translations=places)


def test_a_hinge_with_outliers_is_one_line(detect, held) -> None:
    (line,) = detect(jolted(held(swinging()), 50, 51, 120)).contacts
    assert (line.kind, line.start, line.end) == ("line", 0.0, 4.0)
    assert np.allclose(np.cross(line.location - (1.0, 2.0, 3.0), AXIS), 0.0, atol=1e-6)


def test_a_hinge_that_slides_along_its_axis_is_none(detect, held) -> None:
    search = held(swinging())
    sliding = search.translations + np.outer(0.2 * SECONDS, AXIS)
    assert not detect(replace(search, translations=sliding)).contacts


def test_a_hinge_that_stops_is_a_line_with_a_space_in_it(detect, held) -> None:
    angles = np.interp(SECONDS, [0.0, 1.5, 2.5, 4.0], [0.0, 1.0, 1.0, 2.5])
    search = held(Rotation.from_rotvec(np.outer(angles, AXIS)))
    kinds = [(each.kind, each.start, each.end) for each in detect(search).contacts]
    assert kinds[1] == ("space", pytest.approx(1.5, abs=0.04), pytest.approx(2.5, abs=0.04))
    assert [kind for kind, *_ in kinds] == ["line", "space", "line"]
    longer = detect(replace(search, gap=1.5)).contacts
    assert sorted(each.kind for each in longer) == ["line", "space"]


def test_over_uneven_samples_a_ball_joint_is_still_one_point(detect, held) -> None:
    kept = np.sort(np.random.default_rng(0).permutation(len(SECONDS))[:150])
    search = held(rolling())
    (point,) = detect(replace(
        search, times=search.times[kept] - search.times[kept[0]],
        translations=search.translations[kept], rotations=search.rotations[kept],
    )).contacts  # fmt: skip
    assert point.kind == "point"
    assert np.allclose(point.location, (1.0, 2.0, 3.0), atol=1e-9)
