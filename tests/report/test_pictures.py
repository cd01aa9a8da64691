"""The pictures: there when there is something to be seen, small, and the same each time."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion import Goal, PositionConstraint
from usdmotion.constraints import CenterOfMassConstraint
from usdmotion.drawing.eyes import Camera
from usdmotion.drawing.mannequin import Mannequin, facing, outlines
from usdmotion.drawing.style import stretches, thinned
from usdmotion.report.findings import findings_of
from usdmotion.report.pictures import drawing, pictures_of, postures_of
from usdmotion.testing import HUMANOID

UP = np.array([0.0, 1.0, 0.0])


@pytest.fixture
def reaching(outcome):
    """Return what makes an outcome of so many frames in which a wrist misses its goal."""

    def make(frame_count=24, **said):
        goal = Goal(mode="offset", translation=np.array((0.0, 0.05, 0.0)))
        wrist = PositionConstraint(
            path=f"{HUMANOID}/Edit/Wrist",
            skeleton=HUMANOID,
            joint=outcome.token("left_wrist"),
            goals=(goal,),
        )
        supports = tuple(map(outcome.token, ("left_ankle", "right_ankle")))
        balance = CenterOfMassConstraint(
            path=f"{HUMANOID}/Edit/Balance", skeleton=HUMANOID, priority=2, supports=supports
        )
        turns = {"left_elbow": (0.0, 0.2, 0.0)}
        return outcome([wrist, balance], turns=turns, frame_count=frame_count, **said)

    return make


def drawn(given):
    findings = findings_of(given)
    (edit,) = findings.edits
    groups = pictures_of(findings, edit)
    return groups | {"frames": [*postures_of(findings, edit)]}


def test_each_thing_has_its_picture(reaching):
    with drawing():
        found = drawn(reaching())
        assert {name: len(group) for name, group in found.items()} == {
            "overview": 1,
            "errors": 1,
            "changes": 1,
            "balance": 1,
            "feet": 1,
            "jerk": 1,
            "frames": 3,
        }
        for group in found.values():
            for picture in group:
                assert picture.caption.endswith(".")
                assert picture.png().startswith(b"\x89PNG")
                assert picture.svg().startswith("<svg") and picture.svg().endswith("</svg>")


def test_nothing_to_be_seen_is_no_picture(outcome):
    given = outcome(frame_count=3)
    nobody = tuple(replace(each, parts=None) for each in given.scene.characters)
    with drawing():
        found = drawn(replace(given, scene=replace(given.scene, characters=nobody)))
    assert [name for name, group in found.items() if group] == ["overview"]


@pytest.mark.parametrize("frame_count", [1, 2, 4])
def test_short_clips_are_drawn_too(reaching, frame_count):
    with drawing():
        for group in drawn(reaching(frame_count)).values():
            for picture in group:
                assert picture.svg().startswith("<svg")


def test_a_picture_is_the_same_whatever_is_written_first(reaching):
    with drawing():
        first, second = (drawn(reaching())["jerk"][0] for _ in range(2))
        svg = first.svg()
        png = first.png()
        assert (png, svg) == (second.png(), second.svg())


def test_a_root_that_was_only_moved_is_drawn(outcome):
    with drawing():
        assert drawn(outcome(lift=0.1))["changes"][0].svg()


def test_a_body_that_nobody_knows_is_drawn(reaching):
    given = reaching()
    nobody = tuple(replace(each, parts=None) for each in given.scene.characters)
    with drawing():
        found = drawn(replace(given, scene=replace(given.scene, characters=nobody)))
        assert found["overview"] and found["frames"]


def test_many_constraints_make_several_pictures(outcome):
    asked = [
        PositionConstraint(path=f"{HUMANOID}/Edit/C{each}", skeleton=HUMANOID, joint=token)
        for each, token in enumerate(outcome.joints)
    ]
    with drawing():
        assert [picture.name for picture in drawn(outcome(asked))["errors"]] == [
            "errors1",
            "errors2",
        ]


@pytest.mark.parametrize("count", [5, 10_000])
def test_a_long_curve_is_thinned_and_keeps_its_peaks(count):
    x, y = np.arange(float(count)), np.random.default_rng(0).normal(size=count)
    y[count // 3] = 99.0
    places, seen = thinned(x, y)
    assert len(places) == len(seen) <= max(1300, 5)
    assert seen.max() == 99.0 and seen.min() == y.min()
    assert np.all(np.diff(places) >= 0.0)


def test_stretches_meet_between_the_samples():
    x = np.array((1.0, 2.0, 4.0, 5.0))
    mask = np.array((False, True, False, True))
    assert stretches(x, mask) == [(1.5, 1.5), (4.5, 0.5)]
    assert stretches(x[:1], mask[1:2]) == [(0.5, 1.0)]


def test_a_camera_sees_a_face_from_the_front_and_the_left_side_from_the_left():
    ahead, left = np.array((0.0, 0.0, 1.0)), np.array((1.0, 0.0, 0.0))
    front, side = (Camera.at(ahead, UP, turn, 0.0) for turn in (0.0, 90.0))
    assert np.allclose(front.flat(np.stack([left, UP])), [(1, 0), (0, 1)])
    assert np.allclose(front.towards, ahead)
    assert np.allclose(side.towards, left)
    for camera in (front, side, Camera.at(ahead, UP, 35.0, 12.0)):
        axes = np.stack([camera.right, camera.up, camera.towards])
        assert np.allclose(axes @ axes.T, np.eye(3))
        assert np.linalg.det(axes) == pytest.approx(1.0)


def test_a_body_looks_ahead_of_its_hips(outcome):
    given = outcome()
    (character,) = given.scene.characters
    positions = given.scene.cast.positions[0, 1:]
    ahead = facing(character, positions, UP)
    hips = [positions[outcome.joints.index(outcome.token(f"{s}_hip"))] for s in ("left", "right")]
    assert abs(ahead @ UP) < 1e-12 and np.linalg.norm(ahead) == pytest.approx(1.0)
    assert np.cross(UP, ahead) @ (hips[0] - hips[1]) > 0.0


def test_capsules_reach_from_joint_to_joint_and_the_nearest_is_drawn_last(outcome):
    given = outcome()
    (character,) = given.scene.characters
    mannequin = Mannequin.of(character)
    cast = given.scene.cast
    starts, ends = mannequin.capsules(cast.positions[0, 1:], cast.orientations[0, 1:])
    known = [index for index, tip in enumerate(mannequin.tips) if tip >= 0]
    assert np.array_equal(starts, cast.positions[0, 1:][mannequin.nodes])
    assert np.array_equal(ends[known], cast.positions[0, 1:][[mannequin.tips[k] for k in known]])
    camera = Camera.at(np.array((0.0, 0.0, 1.0)), UP, 20.0, 5.0)
    polygons, order = outlines(camera, starts, ends, mannequin.radii)
    near = (0.5 * (starts + ends) @ camera.towards)[order]
    assert np.all(np.diff(near) >= 0.0) and sorted(order) == list(range(len(starts)))
    first, last = camera.flat(starts[order]), camera.flat(ends[order])
    middle = 0.5 * (first + last)
    reach = np.linalg.norm(last - first, axis=1) + 2.0 * mannequin.radii[order]
    assert (np.linalg.norm(polygons - middle[:, None], axis=2).max(axis=1) <= reach).all()
