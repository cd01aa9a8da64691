"""The short verbs on a stage that is open: show, worst, a new constraint, a template, a report."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom, UsdSkel

from usdmotion import onstage
from usdmotion.asking import Asked
from usdmotion.errors import SceneError
from usdmotion.usd import author_edit

Shot = Callable[..., Path]
SKELETON = "/Arm/Skeleton"
EDIT = f"{SKELETON}/Edit"
WRIST = "base/shoulder/elbow/wrist"


@pytest.fixture
def stage(arm_shot: Shot) -> Usd.Stage:
    """Return the open stage of an arm, whose edit target is its session layer."""
    opened = Usd.Stage.Open(str(arm_shot()))
    opened.SetEditTarget(opened.GetSessionLayer())
    return opened


def bound(stage: Usd.Stage) -> str:
    skeleton = UsdSkel.BindingAPI(stage.GetPrimAtPath(SKELETON))
    return str(skeleton.GetInheritedAnimationSource().GetPath())


def said(stage: Usd.Stage) -> list[str]:
    return [layer.ExportToString() for layer in stage.GetLayerStack()]


def place(stage: Usd.Stage, code: float, joint: str = WRIST) -> np.ndarray:
    """Return where a joint is in the world, as UsdSkel shows it."""
    skeleton = UsdSkel.Skeleton(stage.GetPrimAtPath(SKELETON))
    query = UsdSkel.Cache().GetSkelQuery(skeleton)
    joints = query.ComputeJointSkelTransforms(code)
    world = UsdGeom.XformCache(code).GetLocalToWorldTransform(skeleton.GetPrim())
    found = joints[list(query.GetJointOrder()).index(joint)] * world
    return np.array(found.ExtractTranslation())


def codes(stage: Usd.Stage, path: str) -> list[float]:
    return [float(t) for t in stage.GetPrimAtPath(path).GetAttribute("usdmotion:times").Get()]


def test_a_result_is_hidden_and_shown_again(stage: Usd.Stage) -> None:
    source = bound(stage)
    onstage.solve(stage)
    before = said(stage)
    assert onstage.shown(stage, EDIT)
    onstage.show(stage, EDIT, False)
    assert bound(stage) == source and not onstage.shown(stage, EDIT)
    onstage.show(stage, f"{EDIT}/Wrist", True)
    assert said(stage) == before


def test_a_stacked_result_is_hidden_with_what_it_was_made_from(stage: Usd.Stage) -> None:
    source, second = bound(stage), f"{SKELETON}/Second"
    author_edit(stage, second, source=f"{EDIT}_result")
    onstage.solve(stage, [EDIT])
    onstage.add_position_constraint(stage, second, "wrist", time_code=3.0)
    onstage.solve(stage, [second])
    assert bound(stage) == f"{second}_result"
    assert onstage.shown(stage, EDIT) and onstage.shown(stage, second)
    onstage.show(stage, second, False)
    assert bound(stage) == f"{EDIT}_result"
    assert onstage.shown(stage, EDIT) and not onstage.shown(stage, second)
    onstage.show(stage, second, True)
    onstage.show(stage, EDIT, False)
    assert bound(stage) == source
    for edits in ([EDIT, second], [second, EDIT]):
        onstage.show(stage, edits, True)
        assert bound(stage) == f"{second}_result"
        onstage.show(stage, edits, False)
        assert bound(stage) == source


@pytest.mark.parametrize(
    ("path", "sentence"),
    [
        (EDIT, f"arm.usda: <{EDIT}> has no result; solve it first"),
        (SKELETON, f"arm.usda: <{SKELETON}> is in no MotionEdit; name one"),
        ("/Nobody", "arm.usda: </Nobody> is in no MotionEdit; name one"),
    ],
)
def test_what_has_no_result_is_not_shown(stage: Usd.Stage, path: str, sentence: str) -> None:
    before = said(stage)
    with pytest.raises(SceneError) as told:
        onstage.show(stage, path, True)
    assert str(told.value) == sentence
    assert said(stage) == before


def test_the_worst_time_is_that_of_the_report(stage: Usd.Stage) -> None:
    goal = stage.GetPrimAtPath(f"{EDIT}/Wrist").GetChildren()[0]
    goal.GetAttribute("xformOp:translate").Set(Gf.Vec3d(0.0, 3.0, 0.0))
    (told,) = onstage.solve(stage).edits[0].constraints
    found = onstage.worst(stage, str(goal.GetPath()))
    assert (found.path, found.time_code, found.unit) == (told.path, told.worst_time, "m")
    assert found.error == pytest.approx(told.max, abs=1e-6)
    assert not found.met and found.error > found.tolerance == pytest.approx(1e-3)


def test_there_is_no_worst_time_without_a_result(stage: Usd.Stage) -> None:
    with pytest.raises(
        SceneError, match=r"^arm\.usda: there is no result of a MotionEdit; solve it first"
    ):
        onstage.worst(stage, f"{EDIT}/Wrist")
    onstage.solve(stage)
    with pytest.raises(
        SceneError, match=r"^arm\.usda: .* is no constraint of an edit that has a result"
    ):
        onstage.worst(stage, EDIT)
    constraint = stage.GetPrimAtPath(f"{EDIT}/Wrist")
    constraint.GetAttribute("usdmotion:activity").Set(0.5)
    with pytest.raises(SceneError, match=r"^arm\.usda: .* is never fully on"):
        onstage.worst(stage, f"{EDIT}/Wrist")


def test_a_new_constraint_asks_for_what_is_there_and_takes_nothing_from_others(
    stage: Usd.Stage,
) -> None:
    onstage.solve(stage)
    before = [place(stage, code) for code in (1.0, 5.0, 9.0)]
    path = onstage.add_position_constraint(stage, SKELETON, "elbow", time_code=5.0)
    assert path == f"{EDIT}/ReachElbow"
    prim = stage.GetPrimAtPath(path)
    assert prim.GetAttribute("usdmotion:priority").Get() == 2
    assert list(prim.GetAttribute("usdmotion:recruits").Get()) == [
        "base/shoulder",
        "base/shoulder/elbow",
    ]
    assert onstage.inspect(stage).faults == ()
    report = onstage.solve(stage)
    after = [place(stage, code) for code in (1.0, 5.0, 9.0)]
    np.testing.assert_allclose(after, before, atol=1e-3)
    assert report.edits[0].constraints[0].met


def test_its_goal_offsets_the_motion_around_its_time_and_nowhere_else(stage: Usd.Stage) -> None:
    stage.GetPrimAtPath(f"{EDIT}/Wrist").SetActive(False)
    path = onstage.add_position_constraint(stage, SKELETON, WRIST, time_code=12.0)
    goal = stage.GetPrimAtPath(f"{path}/Goal")
    assert goal.GetAttribute("usdmotion:mode").Get() == "offset"
    goal.GetAttribute("xformOp:translate").Set(Gf.Vec3d(0.0, -0.05, 0.02))
    assert codes(stage, path) == [1.0, 6.0, 12.0, 12.0]
    before = [place(stage, code) for code in (12.0, 1.0)]
    report = onstage.solve(stage)
    after = [place(stage, code) for code in (12.0, 1.0)]
    assert report.met
    np.testing.assert_allclose(after[0] - before[0], (0.0, -0.05, 0.02), atol=1e-3)
    np.testing.assert_allclose(after[1], before[1], atol=1e-6)


def test_a_prop_as_its_space_is_followed(stage: Usd.Stage) -> None:
    prop = UsdGeom.Xform.Define(stage, "/Prop")
    move = prop.AddTranslateOp()
    for code in (1.0, 40.0):
        x, y, z = place(stage, code)
        move.Set(Gf.Vec3d(x, y - 0.03, z + 0.01), code)
    stage.GetPrimAtPath(f"{EDIT}/Wrist").SetActive(False)
    path = onstage.add_position_constraint(stage, SKELETON, "wrist", time_code=1.0, space="/Prop")
    assert onstage.solve(stage).met
    world = UsdGeom.XformCache(1.0).GetLocalToWorldTransform(prop.GetPrim())
    np.testing.assert_allclose(place(stage, 1.0), world.ExtractTranslation(), atol=2e-3)
    assert onstage.inspect(stage).faults == ()
    assert path == f"{EDIT}/ReachWrist"


def test_an_edit_is_made_where_there_is_none_and_names_are_never_taken(stage: Usd.Stage) -> None:
    stage.GetPrimAtPath(EDIT).SetActive(False)
    paths = [
        onstage.add_position_constraint(stage, SKELETON, "wrist", time_code=code)
        for code in (1.0, 1e6)
    ]
    assert paths == [f"{SKELETON}/Edit2/ReachWrist", f"{SKELETON}/Edit2/ReachWrist2"]
    ends = stage.GetStartTimeCode(), stage.GetEndTimeCode()
    assert codes(stage, paths[0])[0] == codes(stage, paths[0])[1] == ends[0]
    assert codes(stage, paths[1])[2:] == [ends[1], ends[1]]
    assert onstage.solve(stage).met


@pytest.mark.parametrize(
    ("asked", "sentence"),
    [
        ({"joint": "nose"}, "there is no joint 'nose' on </Arm/Skeleton>"),
        ({"joint": "/Arm"}, "</Arm> is no joint; name one of the Skeleton"),
        ({"skeleton": "/Arm"}, "</Arm> is no Skeleton that anything moves"),
        ({"space": "/Nobody"}, "</Nobody> is no Xformable prim"),
    ],
)
def test_a_constraint_of_nothing_is_refused_and_nothing_is_written(
    stage: Usd.Stage, asked: dict[str, str], sentence: str
) -> None:
    before = said(stage)
    given = {"skeleton": SKELETON, "joint": "wrist", **asked}
    with pytest.raises(SceneError, match=sentence) as told:
        onstage.add_position_constraint(stage, time_code=1.0, **given)
    assert str(told.value).startswith("arm.usda: ")
    assert said(stage) == before


def test_a_template_is_what_the_next_detection_learns_from(stage: Usd.Stage) -> None:
    asked = Asked(joints=("base",))
    path = onstage.detect(stage, asked).objects[0].contacts[0].path
    onstage.make_template(stage, path)
    assert onstage.inspect(stage).contacts[0].template
    (again,) = onstage.detect(stage, asked).objects
    assert again.contacts[0].state == "template"


def test_what_is_no_contact_is_no_template(stage: Usd.Stage) -> None:
    before = said(stage)
    with pytest.raises(SceneError, match="is a MotionPositionConstraint, and no contact"):
        onstage.make_template(stage, f"{EDIT}/Wrist")
    assert said(stage) == before
    stage.DefinePrim(f"{EDIT}/Foot", "MotionContactConstraint")
    with pytest.raises(SceneError, match="is in no MotionDetection"):
        onstage.make_template(stage, f"{EDIT}/Foot")


def test_of_several_of_which_one_is_at_fault_none_is_changed(stage: Usd.Stage) -> None:
    contact = onstage.detect(stage, Asked(joints=("base",))).objects[0].contacts[0].path
    onstage.solve(stage)
    author_edit(stage, f"{SKELETON}/Unsolved")
    before = said(stage)
    with pytest.raises(SceneError, match="and no contact"):
        onstage.make_template(stage, [contact, f"{EDIT}/Wrist"])
    with pytest.raises(SceneError, match="is in no MotionEdit"):
        onstage.show(stage, [EDIT, SKELETON], False)
    with pytest.raises(SceneError, match="has no result"):
        onstage.show(stage, [EDIT, f"{SKELETON}/Unsolved"], True)
    assert said(stage) == before


def test_a_report_tells_of_what_is_open(stage: Usd.Stage, tmp_path: Path) -> None:
    with pytest.raises(SceneError, match=r"arm\.usda: there is no result"):
        onstage.report(stage, tmp_path / "report.html")
    onstage.solve(stage)
    (found,) = onstage.report(stage, tmp_path / "report.html")
    assert found.edits[0].edit.path == EDIT
    assert "arm.usda" in (tmp_path / "report.html").read_text()


def test_guides_are_drawn_anew_in_the_place_of_what_was_drawn(stage: Usd.Stage) -> None:
    onstage.solve(stage)
    solved = said(stage)
    told = onstage.guides(stage)
    assert [edit.path for edit in told.edits] == [EDIT]
    drawn = said(stage)
    assert drawn[0] != solved[0] and drawn[1:] == solved[1:]
    assert stage.GetPrimAtPath(f"{EDIT}/Wrist/Guides/After").GetTypeName() == "BasisCurves"
    onstage.guides(stage)
    assert said(stage) == drawn
    assert onstage.inspect(stage).faults == ()


def test_where_there_is_nothing_to_draw_nothing_is_drawn(stage: Usd.Stage) -> None:
    stage.GetPrimAtPath(EDIT).SetActive(False)
    before = said(stage)
    with pytest.raises(SceneError, match=r"^arm\.usda: there is nothing to draw"):
        onstage.guides(stage)
    assert said(stage) == before


def test_guides_that_others_would_hide_are_not_drawn(stage: Usd.Stage) -> None:
    onstage.guides(stage)
    stage.SetEditTarget(stage.GetRootLayer())
    before = said(stage)
    with pytest.raises(SceneError, match=r"Guides> is authored in the session layer"):
        onstage.guides(stage)
    assert said(stage) == before
