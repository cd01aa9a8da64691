"""Force plates: a known force at a known place, through the channels of every type."""

import json
from pathlib import Path

import numpy as np
import pytest
from usdmotion_c3d import C3dReader

from usdmotion.arrays import Floats

ezc3d = pytest.importorskip("ezc3d")

FRAMES, FACTOR = 20, 5
SAMPLES = FRAMES * FACTOR
# A plate of 0.6 by 0.4 m that is turned in the floor; z of its axes points down.
MIDDLE = np.array((1.0, 2.0, 0.0))
TURN = np.deg2rad(30.0)
X = np.array((np.cos(TURN), np.sin(TURN), 0.0))
Z = np.array((0.0, 0.0, -1.0))
Y = np.cross(Z, X)
CORNERS = MIDDLE + np.array(
    [0.3 * X + 0.2 * Y, -0.3 * X + 0.2 * Y, -0.3 * X - 0.2 * Y, 0.3 * X - 0.2 * Y]
)
AXES = np.stack([X, Y, Z], axis=1)
SENSOR = np.array((0.002, -0.003, 0.04))
"""Where the sensors are from the middle of the face, in the plate's axes: below it."""
MATRIX = np.diag((2.0, 2.0, 5.0, 0.9, 0.8, 0.7)) + 0.01


@pytest.fixture
def push():
    """Return the force on the body, its place [m] and the free moment [N m], on every sample."""
    times = np.linspace(0.0, np.pi, SAMPLES)
    force = np.stack([60.0 * np.cos(times), -30.0 + 0.0 * times, 700.0 * np.sin(times)], axis=1)
    force *= np.where(times < 0.3, 0.0, 1.0)[:, None]
    place = MIDDLE + np.outer(np.linspace(-0.2, 0.2, SAMPLES), X) + 0.05 * Y
    return force, place, 3.0 * np.sin(times)


def channels(kind: int, force: Floats, place: Floats, free: Floats, length: float) -> Floats:
    """Return what a plate of a type writes, with moments in newtons times a length [m]."""
    inside, spot = force @ AXES, (place - MIDDLE) @ AXES
    twist = np.outer(free, (0.0, 0.0, -1.0))
    if kind == 1:
        return np.column_stack([inside, spot[:, :2] / length, twist[:, 2] / length])
    moment = np.cross(spot - SENSOR, inside) + twist
    six = np.column_stack([inside, moment / length])
    if kind == 4:
        return six @ np.linalg.inv(MATRIX).T
    if kind == 2:
        return six
    a, b, depth = 0.25, 0.15, SENSOR[2]
    moment = np.cross(spot - (0.0, 0.0, depth), inside) + twist
    # Four sensors at (a, b), (−a, b), (−a, −b), (a, −b) that share the load.
    sums = inside[:, 2], moment[:, 0] / b, moment[:, 1] / a
    z1, z2, z3, z4 = (
        0.25 * (sums[0] + p * sums[1] + q * sums[2])
        for p, q in ((1, -1), (1, 1), (-1, 1), (-1, -1))
    )
    half = 0.5 * inside
    lever = moment[:, 2] / (2.0 * b)
    return np.column_stack(
        [half[:, 0] - lever, half[:, 0] + lever, half[:, 1], half[:, 1], z1, z2, z3, z4]
    )


@pytest.fixture
def write_plate(write_c3d, standing):
    """Return what writes a file in millimetres with one plate."""

    def write(kind, values, *, origin=None, zero=(1, 0), **options):
        made_by = {1: (0.0, 0.0, 0.0), 3: (250.0, 150.0, -40.0)}
        origin = made_by.get(kind, tuple(-1000.0 * SENSOR)) if origin is None else origin
        facts = {
            "USED": [1],
            "TYPE": [kind],
            "CORNERS": 1000.0 * CORNERS.T[:, :, None],
            "ORIGIN": np.array(origin)[:, None],
            "CHANNEL": np.arange(1.0, values.shape[1] + 1.0)[:, None],
            "ZERO": list(zero),
        }
        if kind == 4:
            facts["CAL_MATRIX"] = MATRIX[:, :, None]
        return write_c3d(
            *standing, channels=values, parameters={"FORCE_PLATFORM": facts}, **options
        )

    return write


@pytest.mark.parametrize("kind", [1, 2, 3, 4])
@pytest.mark.parametrize("length", [0.001, 1.0])
def test_the_force_and_its_place_come_back(write_plate, push, kind, length) -> None:
    path = write_plate(kind, channels(kind, *push, length))
    (plate,) = C3dReader(force_rate=500.0).read(path).plates
    force, place, free = push
    np.testing.assert_allclose(plate.corners, CORNERS, atol=1e-6)
    np.testing.assert_allclose(plate.times, np.arange(SAMPLES) / 500.0, atol=1e-9)
    np.testing.assert_allclose(plate.forces, force, atol=1e-3)
    np.testing.assert_array_equal(plate.loaded, force[:, 2] > 20.0)
    held = plate.loaded
    np.testing.assert_allclose(plate.centers[held], place[held], atol=1e-4)
    moments = np.cross(place - MIDDLE, force) + np.outer(free, (0.0, 0.0, 1.0))
    np.testing.assert_allclose(plate.moments, moments, atol=2e-3)


def test_an_origin_that_points_the_wrong_way_is_turned(write_plate, push) -> None:
    values = channels(2, *push, 0.001)
    (right,) = C3dReader().read(write_plate(2, values)).plates
    (turned,) = C3dReader().read(write_plate(2, values, origin=1000.0 * SENSOR)).plates
    np.testing.assert_allclose(right.centers, turned.centers, atol=1e-9)


def test_the_force_on_the_plate_is_turned_to_that_on_the_body(write_plate, push) -> None:
    capture = C3dReader().read(write_plate(2, -channels(2, *push, 0.001)))
    assert capture.plates[0].forces[:, 2].max() > 600.0
    assert any("holds the force on it" in note for note in capture.notes)


def test_an_empty_plate_is_zeroed_and_a_loaded_one_is_not(write_plate, push) -> None:
    offset = 13.0 * np.arange(6)
    values = channels(2, *push, 0.001)
    (plain,) = C3dReader().read(write_plate(2, values)).plates
    (zeroed,) = C3dReader().read(write_plate(2, values + offset, zero=(1, 1))).plates
    np.testing.assert_allclose(zeroed.forces, plain.forces, atol=1e-3)
    (stood_on,) = C3dReader().read(write_plate(2, values, zero=(8, 12))).plates
    np.testing.assert_allclose(stood_on.forces, plain.forces, atol=1e-3)


def test_one_value_a_frame_is_the_mean_around_it(write_plate, push) -> None:
    path = write_plate(2, channels(2, *push, 0.001))
    (slow,) = C3dReader().read(path).plates
    (fast,) = C3dReader(force_rate=500.0).read(path).plates
    assert len(slow.times) == FRAMES
    for frame in range(1, FRAMES):
        around = fast.forces[FACTOR * frame - 2 : FACTOR * frame + 3]
        np.testing.assert_allclose(slow.forces[frame], around.mean(axis=0), atol=1e-9)


def test_the_floor_under_the_markers_says_what_is_up(write_plate, push) -> None:
    path = write_plate(2, channels(2, *push, 0.001), name="floor.c3d")
    capture = C3dReader().read(path)
    assert capture.up == "Z"
    assert any("across the force plates" in note for note in capture.notes)


def test_a_plate_that_is_not_known_is_left_out_and_said(write_plate, push) -> None:
    capture = C3dReader().read(write_plate(7, channels(2, *push, 0.001)))
    assert not capture.plates
    assert any("of type 7" in note for note in capture.notes)


def test_stances_are_where_others_found_them(mocap: Path) -> None:
    listed = json.loads((mocap / "contacts/c3d_contacts.json").read_text())
    stances = 0
    for trial in listed:
        capture = C3dReader().read(mocap / "c3d" / trial["file"])
        plates = {plate.name: plate for plate in capture.plates}
        frame = 1.0 / capture.frame_rate
        for stance in trial["plate_contacts"]:
            plate = plates[f"Plate{stance['plate']}"]
            on = plate.times[plate.loaded]
            on = on[(on > stance["start"] - 0.2) & (on < stance["end"] + 0.2)]
            assert on[0] == pytest.approx(stance["start"], abs=1.5 * frame)
            assert on[-1] == pytest.approx(stance["end"], abs=1.5 * frame)
            height = plate.forces[:, "XYZ".index(capture.up)]
            assert height.max() == pytest.approx(stance["peak_N"], rel=0.1)
            stances += 1
    assert stances > 20


@pytest.mark.parametrize("name", ["BTS", "Gait", "ADemo1_rewrite_c3d_pc_float", "PiG_Motion3_FF"])
def test_pressure_is_where_ezc3d_has_it(mocap: Path, name: str) -> None:
    path = mocap / f"c3d/{name}.c3d"
    capture = C3dReader(force_rate=1e6).read(path)
    theirs = ezc3d.c3d(str(path), extract_forceplat_data=True)["data"]["platform"]
    up = "XYZ".index(capture.up)
    for plate, other in zip(capture.plates, theirs, strict=True):
        heavy = plate.forces[:, up] > 300.0
        found, wanted = plate.centers[heavy], 0.001 * other["center_of_pressure"].T[heavy]
        # They do not take off what an empty plate shows, here up to 16 N of 300.
        away = np.linalg.norm(found - wanted, axis=1)
        assert np.all(away < 0.04)
        assert not heavy.any() or np.median(away) < (0.02 if name == "Gait" else 1e-3)
