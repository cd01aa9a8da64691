"""What was missed is drawn in red where it was missed, and only then."""

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom

from usdmotion import demos
from usdmotion.plugins import host
from usdmotion.showing import shown
from usdmotion.usd import outcomes_of

EDIT = "/Walker/Skeleton/Reaching"
FARTHER = Gf.Vec3d(80.0, 60.0, 80.0)


@pytest.fixture(scope="module")
def strained(tmp_path_factory, solved, guided):
    """Return the stage of a walker who reaches for what is too far, and what is seen of him."""
    shot = demos.build("reaching", tmp_path_factory.mktemp("strained"))
    stage = Usd.Stage.Open(str(shot))
    place = stage.GetPrimAtPath(f"{EDIT}/LeftWrist/Reach").GetAttribute("xformOp:translate")
    place.Set(place.Get() + FARTHER)
    stage.Save()
    result = solved(shot)
    drawn = guided(result)
    (outcome,) = outcomes_of(drawn, result, host().constraints)
    return drawn, shown(outcome)


def test_it_is_seen_exactly_on_the_frames_on_which_it_is_missed(strained):
    stage, seen = strained
    misses = {miss.path: miss for miss in seen.edits[0].misses}
    assert {path for path, miss in misses.items() if miss.missed.any()} >= {f"{EDIT}/LeftWrist"}
    for path, miss in misses.items():
        guide = UsdGeom.Imageable(stage.GetPrimAtPath(f"{path}/Guides/Missed"))
        for code, missed in zip(seen.scene.time_codes, miss.missed, strict=True):
            visible = guide.ComputeVisibility(code) != UsdGeom.Tokens.invisible
            assert visible == missed, (path, code)


def test_it_goes_from_the_effector_to_where_that_is_wanted(strained):
    stage, seen = strained
    for miss in seen.edits[0].misses:
        guide = UsdGeom.PointBased(stage.GetPrimAtPath(f"{miss.path}/Guides/Missed"))
        for frame in np.flatnonzero(miss.missed):
            code = seen.scene.time_codes[frame]
            points = np.array(guide.GetPointsAttr().Get(code))
            ends = 100.0 * np.array([miss.places[frame], miss.wanted[frame]])
            assert np.linalg.norm(points - ends, axis=1).max() < 0.2


def test_it_goes_along_until_it_is_seen_no_more(strained):
    stage, seen = strained
    moved = []
    for miss in seen.edits[0].misses:
        guide = UsdGeom.PointBased(stage.GetPrimAtPath(f"{miss.path}/Guides/Missed"))
        for frame in np.flatnonzero(miss.missed[:-1] & ~miss.missed[1:]):
            code = 0.5 * (seen.scene.time_codes[frame] + seen.scene.time_codes[frame + 1])
            points = np.array(guide.GetPointsAttr().Get(code))
            ends = 100.0 * np.array([miss.places[frame:][:2], miss.wanted[frame:][:2]])
            assert np.linalg.norm(points - ends.mean(axis=1), axis=1).max() < 0.2
            moved.append(np.linalg.norm(np.diff(ends, axis=1)))
    assert max(moved) > 0.5


def test_it_is_red_and_nothing_else_is(strained):
    stage, _ = strained
    for prim in stage.Traverse():
        if prim.IsA(UsdGeom.Points) or prim.IsA(UsdGeom.BasisCurves):
            red, green, blue = UsdGeom.Gprim(prim).GetDisplayColorAttr().Get()[0]
            is_red = red > 0.7 and max(green, blue) < 0.05
            assert is_red == (prim.GetName() == "Missed") or prim.GetName() == "Axes"


def test_what_wants_no_place_is_a_point_at_the_effector(text, save, solved, guided, skel):
    kind = "MotionOrientationConstraint"
    turned = 'quatf xformOp:orient = {}\nuniform token[] xformOpOrder = ["xformOp:orient"]'

    def asked(name, rank, orient):
        goal = f'def MotionGoal "Goal" {{\n{turned.format(orient)}\n}}'
        return text.hold(goal, name, kind, f"int usdmotion:priority = {rank}")

    edit = text.edit(asked("First", 1, "(1, 0, 0, 0)") + asked("Second", 2, "(0, 1, 0, 0)"))
    header = "metersPerUnit = 0.01\ntimeCodesPerSecond = 24"
    stage = guided(solved(save(text.man(edit=edit), header=header)))
    assert not stage.GetPrimAtPath("/Man/Bones/Edit/First/Guides/Missed")
    guide = stage.GetPrimAtPath("/Man/Bones/Edit/Second/Guides/Missed")
    assert guide.IsA(UsdGeom.Points)
    for code in (1.0, 3.0, 5.0):
        places, _ = skel.truth(stage.GetRootLayer().realPath, "/Man/Bones", [code])
        (point,) = UsdGeom.PointBased(guide).GetPointsAttr().Get(code)
        np.testing.assert_allclose(0.01 * np.array(point), places[0, 2], atol=2e-3)
