"""Captured markers, clusters, plates and events on a stage."""

import numpy as np
import pytest
from pxr import Gf, Sdf, Usd, UsdGeom

from usdmotion import usd
from usdmotion.capture import Capture, Cluster, Event, ForcePlate, Markers

FRAMES = 6
SEEN = np.ones((FRAMES, 3), dtype=bool)
SEEN[2:4, 1] = False


def markers():
    positions = np.random.default_rng(2).normal(size=(FRAMES, 3, 3))
    positions[2:4, 1] = positions[1, 1]
    return Markers(("Matt:LASI", "RASI", "*17"), positions, SEEN)


def cluster():
    angles = np.linspace(0.0, 1.0, FRAMES)
    rotations = np.stack(
        [np.zeros(FRAMES), np.zeros(FRAMES), np.sin(angles), np.cos(angles)], axis=1
    )
    translations = np.linspace((0.0, 1.0, 0.0), (1.0, 1.2, 0.3), FRAMES)
    placed = np.array([True, True, False, False, True, True])
    return Cluster("Pelvis", ("A", "B", "C"), np.eye(3), translations, rotations, placed)


def plate():
    times = np.arange(2 * FRAMES) / 40.0
    forces = np.outer(np.sin(np.arange(2 * FRAMES) / 4.0), (10.0, 20.0, 700.0))
    loaded = forces[:, 2] > 20.0
    corners = np.array([(0.0, 0.0, 0.0), (0.4, 0.0, 0.0), (0.4, 0.6, 0.0), (0.0, 0.6, 0.0)])
    centers = np.linspace((0.1, 0.1, 0.0), (0.1, 0.5, 0.0), len(times))
    return ForcePlate("Plate1", corners, times, forces, 0.1 * forces, centers, loaded)


@pytest.fixture
def stage(tmp_path):
    capture = Capture(
        name="trial",
        up="Z",
        frame_rate=20.0,
        times=np.arange(FRAMES) / 20.0,
        markers=markers(),
        clusters=(cluster(),),
        plates=(plate(),),
        events=(Event("Foot Strike", 0.07, "Left"), Event("Foot Strike", 0.21, "Left")),
    )
    usd.write_capture(capture, tmp_path / "trial.usda", first=101.0)
    return Usd.Stage.Open(str(tmp_path / "trial.usda"))


def test_the_stage_has_the_time_and_axis_of_the_capture(stage) -> None:
    assert UsdGeom.GetStageUpAxis(stage) == "Z"
    assert stage.GetTimeCodesPerSecond() == 20.0
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (101.0, 106.0)
    assert stage.GetDefaultPrim().GetPath() == "/trial"


def test_markers_are_points_that_keep_their_order(stage) -> None:
    points = UsdGeom.Points.Get(stage, "/trial/Markers")
    labels = UsdGeom.PrimvarsAPI(points).GetPrimvar("label").Get()
    assert tuple(labels) == markers().labels
    assert len(points.GetIdsAttr().Get()) == 3
    for frame in range(FRAMES):
        found = 0.01 * np.array(points.GetPointsAttr().Get(101.0 + frame))
        np.testing.assert_allclose(found, markers().positions[frame], atol=1e-5)


def test_a_marker_out_of_sight_has_no_width_and_says_so(stage) -> None:
    points = UsdGeom.Points.Get(stage, "/trial/Markers")
    seen = UsdGeom.PrimvarsAPI(points).GetPrimvar("seen")
    for frame in range(FRAMES):
        widths = np.array(points.GetWidthsAttr().Get(101.0 + frame))
        np.testing.assert_array_equal(widths > 0.0, SEEN[frame])
        np.testing.assert_array_equal(np.array(seen.Get(101.0 + frame)) == 1, SEEN[frame])


def test_a_cluster_is_an_xform_that_moves_through_its_gaps(stage) -> None:
    prim = stage.GetPrimAtPath("/trial/Clusters/Pelvis")
    assert tuple(prim.GetAttribute("usdmotion:markers").Get()) == cluster().labels
    for frame in range(FRAMES):
        matrix = UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(101.0 + frame)
        place = 0.01 * np.array(matrix.ExtractTranslation())
        np.testing.assert_allclose(place, cluster().translations[frame], atol=1e-6)
        x, y, z, w = cluster().rotations[frame]
        turn = matrix.ExtractRotationQuat()
        if cluster().placed[frame]:
            assert abs(Gf.Dot(turn, Gf.Quatd(w, x, y, z))) == pytest.approx(1.0, abs=1e-6)
        shown = UsdGeom.Imageable(prim).ComputeVisibility(101.0 + frame) == "inherited"
        assert shown == cluster().placed[frame]


def test_a_plate_stands_in_the_floor_with_what_it_measured(stage) -> None:
    prim = stage.GetPrimAtPath("/trial/Plates/Plate1")
    matrix = UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(101.0)
    face = UsdGeom.Mesh.Get(stage, "/trial/Plates/Plate1/Face").GetPointsAttr().Get()
    corners = [0.01 * np.array(matrix.Transform(Gf.Vec3d(each))) for each in face]
    np.testing.assert_allclose(corners, plate().corners, atol=1e-6)
    for sample, time in enumerate(plate().times):
        code = 101.0 + 20.0 * time
        force = prim.GetAttribute("usdmotion:force").Get(code)
        np.testing.assert_allclose(force, plate().forces[sample], rtol=1e-6)
        if plate().loaded[sample]:
            center = Gf.Vec3d(prim.GetAttribute("usdmotion:centerOfPressure").Get(code))
            world = 0.01 * np.array(matrix.Transform(center))
            np.testing.assert_allclose(world, plate().centers[sample], atol=1e-6)


def test_the_arrow_of_a_plate_shows_only_under_load(stage) -> None:
    arrow = UsdGeom.BasisCurves.Get(stage, "/trial/Plates/Plate1/Force")
    for sample, time in enumerate(plate().times):
        code = 101.0 + 20.0 * time
        shown = arrow.ComputeVisibility(code) == "inherited"
        assert shown == plate().loaded[sample]
        if shown:
            start, end = np.array(arrow.GetPointsAttr().Get(code))
            np.testing.assert_allclose(end - start, 0.1 * plate().forces[sample], rtol=1e-4)


def test_events_are_prims_whose_time_goes_along_with_the_clip(stage) -> None:
    names = [prim.GetName() for prim in stage.GetPrimAtPath("/trial/Events").GetChildren()]
    assert names == ["LeftFootStrike1", "LeftFootStrike2"]
    prim = stage.GetPrimAtPath("/trial/Events/LeftFootStrike2")
    assert float(prim.GetAttribute("usdmotion:time").Get()) == pytest.approx(101.0 + 4.2)
    assert prim.GetAttribute("usdmotion:label").Get() == "Foot Strike"
    assert prim.GetAttribute("usdmotion:context").Get() == "Left"
    shot = Usd.Stage.CreateInMemory()
    shot.SetTimeCodesPerSecond(20.0)
    held = shot.DefinePrim("/Shot")
    held.GetReferences().AddReference(
        stage.GetRootLayer().identifier, layerOffset=Sdf.LayerOffset(50.0)
    )
    moved = shot.GetPrimAtPath("/Shot/Events/LeftFootStrike2").GetAttribute("usdmotion:time")
    assert float(moved.Get()) == pytest.approx(155.2)
