"""Markers of small files: where they are, what they are called, when they were seen."""

import sys

import numpy as np
import pytest
from usdmotion_c3d import C3dReader

from usdmotion import host, import_motion
from usdmotion.errors import FileError
from usdmotion.testing import check_reader


def test_the_reader_keeps_its_contract(write_c3d, standing) -> None:
    check_reader(C3dReader(), write_c3d(*standing))
    assert host().readers["c3d"] is C3dReader


def test_positions_come_back_in_metres(write_c3d, standing) -> None:
    points, labels = standing
    capture = C3dReader().read(write_c3d(points, labels))
    assert capture.markers.labels == tuple(labels)
    assert capture.name == "trial"
    assert capture.frame_rate == 100.0
    np.testing.assert_allclose(capture.markers.positions, 0.001 * points, atol=1e-6)


@pytest.mark.parametrize(
    ("unit", "metres"), [("mm", 0.001), ("m", 1.0), ("mete", 1.0), ("cm", 0.01), ("inch", 0.0254)]
)
def test_units_are_those_of_the_file(write_c3d, standing, unit, metres) -> None:
    points, labels = standing
    path = write_c3d(points, labels, parameters={"POINT": {"UNITS": [unit]}})
    markers = C3dReader().read(path).markers
    np.testing.assert_allclose(markers.positions, metres * points, rtol=1e-6, atol=1e-6)


def test_units_may_differ_from_point_to_point(write_c3d, standing) -> None:
    points, labels = standing
    units = ["mm", "m", "mm", "cm"]
    path = write_c3d(points, labels, parameters={"POINT": {"UNITS": units}})
    markers = C3dReader().read(path).markers
    metres = np.array([0.001, 1.0, 0.001, 0.01])[:, None]
    np.testing.assert_allclose(markers.positions, metres * points, rtol=1e-6, atol=1e-6)


def test_a_file_without_a_unit_is_judged_by_its_size_and_says_so(write_c3d, standing) -> None:
    points, labels = standing
    for scale, metres in ((1.0, 0.001), (0.001, 1.0)):
        path = write_c3d(scale * points, labels, parameters={"POINT": {"UNITS": [""]}})
        capture = C3dReader().read(path)
        wanted = metres * scale * points
        np.testing.assert_allclose(capture.markers.positions, wanted, rtol=1e-6, atol=1e-6)
        assert any("no unit is said" in note for note in capture.notes)
    capture = C3dReader(unit=0.5).read(path)
    np.testing.assert_allclose(capture.markers.positions, 0.0005 * points, rtol=1e-6)


def test_a_unit_that_is_no_length_is_refused(write_c3d, standing) -> None:
    path = write_c3d(*standing, parameters={"POINT": {"UNITS": ["deg"]}})
    with pytest.raises(FileError, match=r"trial\.c3d: POINT:UNITS is 'deg'.*set `unit`"):
        C3dReader().read(path)


@pytest.mark.parametrize(
    ("screen", "stage"),
    [("+Z", "Z"), ("+Y", "Y"), ("-Y", "Y"), ("-Z", "Z"), ("+X", "Y"), ("-X", "Y")],
)
def test_what_the_file_has_up_is_up_on_the_stage(write_c3d, standing, screen, stage) -> None:
    points, labels = standing
    # Turn the standing points so that their height is along the wanted axis of the file.
    axis, sign = "XYZ".index(screen[1]), float(f"{screen[0]}1")
    turned = np.roll(points, axis - 2, axis=2)
    turned[..., axis] *= sign
    path = write_c3d(turned, labels, parameters={"POINT": {"Y_SCREEN": [screen]}})
    capture = C3dReader().read(path)
    assert capture.up == stage
    heights = capture.markers.positions[..., "XYZ".index(stage)]
    np.testing.assert_allclose(heights, 0.001 * points[..., 2], atol=1e-6)
    # Axes are turned, never mirrored: distances and handedness stay.
    inside, outside = (each[0] - each[0, 0] for each in (0.001 * turned, capture.markers.positions))
    assert np.linalg.det(inside[1:]) == pytest.approx(np.linalg.det(outside[1:]))


def test_a_file_that_says_no_axis_stands_along_its_height(write_c3d, standing) -> None:
    points, labels = standing
    for roll, up in ((0, "Z"), (2, "Y")):
        capture = C3dReader().read(write_c3d(np.roll(points, roll, axis=2), labels))
        assert capture.up == up
        assert any("is up, as the markers stand along it" in note for note in capture.notes)
    assert C3dReader(up="X").read(write_c3d(points, labels)).up == "Y"


def test_a_gap_holds_the_place_and_says_that_nothing_was_seen(write_c3d, standing) -> None:
    points, labels = standing
    seen = np.ones(points.shape[:2], dtype=bool)
    seen[:3, 0] = seen[8:12, 1] = seen[15:, 2] = False
    points[~seen] = np.nan
    markers = C3dReader().read(write_c3d(points, labels)).markers
    np.testing.assert_array_equal(markers.seen, seen)
    np.testing.assert_allclose(markers.positions[seen], 0.001 * points[seen], atol=1e-6)
    held = [(slice(0, 3), 0, 3), (slice(8, 12), 1, 7), (slice(15, 20), 2, 14)]
    for frames, marker, source in held:
        assert (markers.positions[frames, marker] == markers.positions[source, marker]).all()


def test_what_a_model_put_out_is_no_marker(write_c3d, standing) -> None:
    points, labels = standing
    outputs = ["LHipAngles", "Odd", "PELO", "PELA", "PELL", "PELP", "CentreOfMass"]
    extra = np.full((len(points), len(outputs), 3), 77.0)
    path = write_c3d(
        np.concatenate([points, extra, np.full_like(points[:, :1], np.nan)], axis=1),
        [*labels, *outputs, "LOST"],
        parameters={"POINT": {"POWERS": ["Odd"]}},
    )
    capture = C3dReader().read(path)
    assert capture.markers.labels == tuple(labels)
    assert sum("left out" in note for note in capture.notes) == 3


def test_labels_are_unique_even_where_the_file_has_none(write_c3d, standing) -> None:
    points, _ = standing
    capture = C3dReader().read(write_c3d(points, ["Matt:A", "Matt:A", "", ""]))
    labels = capture.markers.labels
    assert labels == ("Matt:A", "Matt:A_2", "Unlabelled_1", "Unlabelled_2")
    assert any("more than once" in note for note in capture.notes)


def test_events_count_from_the_first_frame_of_the_file(write_c3d, standing) -> None:
    events = {
        "USED": [3],
        "LABELS": ["Foot Off", "Foot Strike", "Turn"],
        "CONTEXTS": ["Left", "Right", "General"],
        "TIMES": np.array([[0.0, 0.0, 1.0], [2.55, 2.51, 0.5]]),
    }
    path = write_c3d(*standing, first=251, parameters={"EVENT": events})
    found = C3dReader().read(path).events
    assert [(each.label, each.context) for each in found] == [
        ("Foot Strike", "Right"),
        ("Foot Off", "Left"),
        ("Turn", "General"),
    ]
    np.testing.assert_allclose([each.time for each in found], [0.01, 0.05, 58.0], atol=1e-5)


def test_a_late_part_of_a_long_recording_is_read_whole(write_c3d, standing) -> None:
    points, labels = standing
    # Frame 70 000 of a recording: too many for the header, which has the lower 16 bits of it.
    fields = {"ACTUAL_START_FIELD": [4464.0, 1.0], "ACTUAL_END_FIELD": [4483.0, 1.0]}
    events = {"USED": [1], "LABELS": ["Off"], "TIMES": np.array([[11.0], [40.05]])}
    path = write_c3d(points, labels, first=65530, parameters={"TRIAL": fields, "EVENT": events})
    capture = C3dReader().read(path)
    np.testing.assert_allclose(capture.markers.positions, 0.001 * points, atol=1e-6)
    (event,) = capture.events
    assert event.time == pytest.approx(0.06, abs=1e-3)


@pytest.mark.parametrize("cut", [1, 100, 600, 1500])
def test_a_file_that_was_cut_off_is_read_as_far_or_refused(write_c3d, standing, cut) -> None:
    path = write_c3d(*standing)
    content = path.read_bytes()
    path.write_bytes(content[:-cut])
    try:
        capture = C3dReader().read(path)
    except FileError as error:
        assert path.name in str(error)
    else:
        assert len(capture.times) <= len(standing[0])
        assert any("but holds" in note for note in capture.notes) or cut < 512


@pytest.mark.parametrize("seed", range(12))
def test_a_damaged_file_never_takes_us_down(write_c3d, standing, seed) -> None:
    path = write_c3d(*standing)
    content = bytearray(path.read_bytes())
    random = np.random.default_rng(seed)
    for place in random.integers(0, 1536, size=20):
        content[place] = random.integers(256)
    path.write_bytes(content)
    try:
        C3dReader().read(path)
    except FileError as error:
        assert str(path) in str(error)
        assert "\n" not in str(error)


def test_without_ezc3d_a_sentence_says_what_to_install(
    write_c3d, standing, monkeypatch, tmp_path
) -> None:
    path = write_c3d(*standing)
    monkeypatch.setitem(sys.modules, "ezc3d", None)
    with pytest.raises(FileError, match=r"pip install 'usdmotion\[c3d\]'"):
        import_motion(path, tmp_path / "trial.usda")
