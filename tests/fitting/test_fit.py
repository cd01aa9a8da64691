"""A skeleton that is fitted to markers is the one that wore them."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion.capture import Capture, Markers
from usdmotion.fitting import fit
from usdmotion.kernels import forward

JOINTS = ["Head", "Neck"] + [
    side + joint
    for side in ("Left", "Right")
    for joint in ("UpLeg", "Leg", "Foot", "Arm", "ForeArm", "Hand")
]


def joints_of(recording):
    """Return the world positions of a recording's joints by name."""
    motion = recording.motion
    positions, _ = forward(recording.skeleton.parents, motion.translations, motion.rotations)
    names = [token.rpartition("/")[2] for token in recording.skeleton.joints]
    return dict(zip(names, positions.transpose(1, 0, 2), strict=True))


def apart(found, wearer, name):
    return np.linalg.norm(found[name] - wearer.joint(name), axis=1)


@pytest.fixture(scope="module")
def fitted(wearer):
    recording, (note,) = fit(wearer.capture)
    assert "fitted to 34 markers" in note
    return recording


@pytest.mark.parametrize("name", JOINTS)
def test_joints_are_where_they_were(fitted, wearer, name) -> None:
    off = apart(joints_of(fitted), wearer, name)
    assert np.median(off) < 0.005
    assert off.max() < 0.02


def test_markers_are_met_to_millimetres_and_a_note_says_so(wearer) -> None:
    _, (note,) = fit(wearer.capture)
    assert float(note.partition("they are ")[2].partition(" mm")[0]) < 3.0


def test_at_rest_it_stands_on_the_floor_with_arms_out(fitted) -> None:
    skeleton = fitted.skeleton
    rest = forward(
        skeleton.parents, skeleton.rest_translations[None], skeleton.rest_rotations[None]
    )
    places = dict(zip(fitted.original_names, rest[0][0], strict=True))
    assert places["LeftHand"][0] > 0.5 and places["RightHand"][0] < -0.5
    assert 0.0 < places["LeftFoot"][1] < 0.12
    assert places["Head"][1] > 1.4
    soles = rest[0][0][fitted.tip_joints] + fitted.tip_points
    assert min(rest[0][0][:, 1].min(), soles[:, 1].min()) == pytest.approx(0.0, abs=1e-9)


def test_a_world_with_z_up_is_no_other(fitted, wearer) -> None:
    markers = wearer.capture.markers
    turn = np.array(((1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)))
    turned = replace(markers, positions=markers.positions @ turn.T)
    other, _ = fit(replace(wearer.capture, up="Z", markers=turned))
    one, two = joints_of(fitted), joints_of(other)
    for name in JOINTS:
        np.testing.assert_allclose(two[name], one[name] @ turn.T, atol=1e-4)


def test_a_hidden_marker_does_not_pull(fitted, wearer) -> None:
    markers = wearer.capture.markers
    seen = np.array(markers.seen)
    for label, frames in (("LKNE", slice(20, 40)), ("RWRA", slice(0, 30)), ("LASI", slice(60, 70))):
        seen[frames, markers.labels.index(label)] = False
    hidden = np.where(seen[..., None], markers.positions, 50.0)
    recording, _ = fit(replace(wearer.capture, markers=Markers(markers.labels, hidden, seen)))
    found, whole = joints_of(recording), joints_of(fitted)
    for name in JOINTS:
        assert np.linalg.norm(found[name] - whole[name], axis=1).max() < 0.02, name


def test_frames_on_which_nothing_is_seen_are_gone_through_evenly_and_told(fitted, wearer) -> None:
    markers = wearer.capture.markers
    seen = np.array(markers.seen)
    seen[40:44] = False
    recording, notes = fit(replace(wearer.capture, markers=replace(markers, seen=seen)))
    assert "on 4 of 101 frames no marker" in notes[1]
    found, whole = joints_of(recording), joints_of(fitted)
    for name in JOINTS:
        assert np.linalg.norm(found[name] - whole[name], axis=1).max() < 0.05


def test_of_two_subjects_no_body_is_made_of_both(fitted, wearer) -> None:
    markers = wearer.capture.markers
    labels = ["Ann:LASI", "Ann:LKNE", "Ann:RKNE", *(f"Matt:{label}" for label in markers.labels)]
    positions = np.concatenate([markers.positions[:, :3] + 3.0, markers.positions], axis=1)
    seen = np.ones(positions.shape[:2], dtype=bool)
    both = replace(wearer.capture, markers=Markers(tuple(labels), positions, seen))
    recording, notes = fit(both)
    assert "the skeleton is that of Matt" in notes[-1]
    np.testing.assert_allclose(recording.motion.rotations, fitted.motion.rotations, atol=1e-9)


def only(capture: Capture, labels) -> Capture:
    markers = capture.markers
    kept = [markers.labels.index(label) for label in labels]
    some = Markers(tuple(labels), markers.positions[:, kept], markers.seen[:, kept])
    return replace(capture, markers=some)


def test_a_lower_body_is_fitted_alone(wearer) -> None:
    labels = ["LASI", "RASI", "LPSI", "RPSI"]
    labels += [side + mark for side in "LR" for mark in ("THI", "KNE", "TIB", "ANK", "HEE", "TOE")]
    recording, _ = fit(only(wearer.capture, labels))
    found = joints_of(recording)
    assert len(found) == 7
    for name in ("LeftLeg", "RightFoot"):
        assert apart(found, wearer, name).max() < 0.01


def test_without_wands_and_heels_the_pelvis_tells_which_way_a_knee_is(wearer) -> None:
    labels = ["LASI", "RASI", "LPSI", "RPSI"]
    labels += [side + mark for side in "LR" for mark in ("KNE", "ANK", "TOE")]
    recording, _ = fit(only(wearer.capture, labels))
    found = joints_of(recording)
    for name in ("LeftLeg", "RightFoot"):
        assert np.median(apart(found, wearer, name)) < 0.03


def test_labels_that_tell_no_body_get_none(wearer) -> None:
    recording, (note,) = fit(only(wearer.capture, ["LASI", "RASI", "LKNE", "RKNE"]))
    assert recording is None
    assert "no label says which marker is" in note


def test_markers_that_do_not_move_like_a_body_get_none(wearer) -> None:
    markers = wearer.capture.markers
    random = np.random.default_rng(1).normal(size=markers.positions.shape)
    recording, (note,) = fit(replace(wearer.capture, markers=replace(markers, positions=random)))
    assert recording is None
    assert "do not move like a body" in note


def test_markers_that_are_never_seen_together_get_none(wearer) -> None:
    markers = wearer.capture.markers
    seen = np.array(markers.seen)
    seen[50:, markers.labels.index("LKNE")] = seen[:50, markers.labels.index("RKNE")] = False
    recording, (note,) = fit(replace(wearer.capture, markers=replace(markers, seen=seen)))
    assert recording is None
    assert "never seen all together" in note
