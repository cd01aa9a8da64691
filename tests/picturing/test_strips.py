"""A strip shows each frame from each view, before and after."""

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom, UsdSkel

from usdmotion.asking import Span
from usdmotion.constraints import ContactConstraint
from usdmotion.errors import InputError
from usdmotion.picturing import look_at, strip_of
from usdmotion.picturing.strips import empty_panels
from usdmotion.usd import author

ASKED, WRIST = "/Asked/Skeleton", "base/shoulder/elbow/wrist"

ENDS = (2.0, 8.0)


@pytest.fixture(scope="module")
def compared(shots):
    """Return the strip of the shot beside its result, and what it is made of."""
    looked = look_at(shots.composed, frames=ENDS)
    return looked, strip_of(looked)


def test_columns_are_frames_and_rows_are_before_and_after(compared):
    _, strip = compared
    assert [row.title for row in strip.rows] == ["before", "after"]
    assert [[panel.title for panel in row.panels] for row in strip.rows] == [["2", "8"]] * 2


def test_who_is_solved_is_somewhere_else_and_nobody_else_is(compared):
    _, strip = compared
    for before, after in zip(*(row.panels for row in strip.rows), strict=True):
        asked, idle = (
            np.abs(one.pose[0] - other.pose[0]).max(axis=1)
            for one, other in zip(before.bodies, after.bodies, strict=True)
        )
        assert asked[-1] > 0.03
        assert not idle.any()


def test_input_result_and_others_are_told_apart(compared):
    _, strip = compared
    kinds = [[body.kind for body in row.panels[0].bodies] for row in strip.rows]
    assert kinds == [["before", "other"], ["after", "other"]]


def test_before_and_after_are_seen_from_one_place(compared):
    _, strip = compared
    first, second = (row.panels[0].eye for row in strip.rows)
    points = np.eye(3)
    np.testing.assert_array_equal(first.flat(points), second.flat(points))


def test_a_layer_over_the_shot_is_the_stage_that_shows_it(shots, compared):
    beside = strip_of(look_at(shots.shot, compare=shots.layer, frames=ENDS))
    above = strip_of(look_at(shots.shot, compare=shots.composed, frames=ENDS))
    for strip in (beside, above):
        for row, known in zip(strip.rows, compared[1].rows, strict=True):
            for body, other in zip(row.panels[1].bodies, known.panels[1].bodies, strict=True):
                np.testing.assert_array_equal(body.pose[0], other.pose[0])
                assert body.kind == other.kind


def test_what_is_asked_is_marked_in_both(compared):
    _, strip = compared
    for row in strip.rows:
        assert any(getattr(mark, "sign", "") == "goal" for mark in row.panels[0].marks)


def test_a_stage_without_results_is_one_row(shots):
    strip = strip_of(look_at(shots.shot, frames=ENDS))
    assert [row.title for row in strip.rows] == [""]
    assert {body.kind for body in strip.rows[0].panels[0].bodies} == {"after"}


def test_views_are_rows_each_before_and_after(shots):
    strip = strip_of(look_at(shots.composed, frames=ENDS, views=("top", "side")))
    titles = [row.title for row in strip.rows]
    assert titles == ["top, before", "top, after", "side, before", "side, after"]


def test_limbs_take_the_place_of_the_light_mesh_and_props_stay(compared):
    looked, strip = compared
    seen = [each.path for each in looked.sceneries[0].surfaces[0]]
    assert seen == ["/Asked/Guide", "/Idle/Guide", "/Box"]
    (box,) = strip.rows[0].panels[0].surfaces
    assert len(box.triangles) == 12
    assert not box.both_sides


def test_a_camera_shows_its_frame(shots):
    strip = strip_of(look_at(shots.composed, frames=ENDS, camera="/Camera"))
    panel = strip.rows[0].panels[0]
    left, bottom, right, top = panel.eye.window
    stage = Usd.Stage.Open(str(shots.shot))
    camera = UsdGeom.Camera(stage.GetPrimAtPath("/Camera"))
    assert (right - left) / (top - bottom) == pytest.approx(camera.GetCamera(2.0).aspectRatio)
    assert len({each.beyond for one in strip.rows[0].panels for each in one.surfaces}) == 1


def test_a_camera_that_sees_nothing_is_told_of(shots, tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "away.usda"))
    stage.GetRootLayer().subLayerPaths = [str(shots.composed)]
    moved = stage.OverridePrim("/Camera").GetAttribute("xformOp:translate")
    moved.Set((0.0, 0.5, 4.0), 2.0)
    moved.Set((0.0, 0.5, -40.0), 8.0)
    stage.GetRootLayer().Save()
    looked = look_at(tmp_path / "away.usda", frames=ENDS, camera="/Camera")
    (note,) = empty_panels(looked, strip_of(looked))
    assert note.startswith("nothing that is drawn is before </Camera> at 8; ")
    seen = look_at(shots.composed, frames=ENDS, camera="/Camera")
    assert empty_panels(seen, strip_of(seen)) == ()


def test_stages_with_nothing_in_common_are_told_of(shots, tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "other.usda"))
    UsdGeom.Cube.Define(stage, "/Elsewhere")
    stage.GetRootLayer().Save()
    (note,) = look_at(shots.shot, frames=ENDS, compare=tmp_path / "other.usda").notes
    assert "other.usda has no skeleton and no surface in common with" in note
    assert not look_at(shots.shot, frames=ENDS, compare=shots.layer).notes


def test_telling_frames_are_within_the_clip_and_in_order(shots):
    codes = look_at(shots.composed).codes
    assert (codes[0], codes[-1]) == (1.0, 12.0)
    assert (np.diff(codes) > 0.0).all()


def test_a_skin_takes_the_place_of_limbs(shots, tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "skinned.usda"))
    stage.GetRootLayer().subLayerPaths = [str(shots.shot)]
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    _skin(stage)
    stage.GetRootLayer().Save()
    strip = strip_of(look_at(tmp_path / "skinned.usda", frames=Span(2.0, 8.0)))
    panel = strip.rows[0].panels[0]
    assert len(panel.bodies) == 1
    skin, box = panel.surfaces
    assert skin.color != box.color


def _skin(stage: Usd.Stage) -> None:
    """Give one arm a skin of a triangle at each joint."""
    mesh = UsdGeom.Mesh.Define(stage, "/Asked/Skin")
    count = len(UsdSkel.Skeleton.Get(stage, "/Asked/Skeleton").GetJointsAttr().Get())
    corners = [(0.0, 0.3 * joint, 0.1 * side) for joint in range(count) for side in range(3)]
    mesh.CreatePointsAttr([(x + 0.1 * y, y, z) for x, y, z in corners])
    mesh.CreateFaceVertexCountsAttr([3] * count)
    mesh.CreateFaceVertexIndicesAttr(list(range(3 * count)))
    binding = UsdSkel.BindingAPI.Apply(mesh.GetPrim())
    binding.CreateSkeletonRel().SetTargets([Sdf.Path("/Asked/Skeleton")])
    indices = [joint for joint in range(count) for _ in range(3)]
    binding.CreateJointIndicesPrimvar(False, 1).Set(indices)
    binding.CreateJointWeightsPrimvar(False, 1).Set([1.0] * len(indices))


REFUSED = {
    "an unknown view": ({"views": ("behind",)}, "--view 'behind' is no view; name some of front"),
    "no such camera": ({"camera": "/Nobody"}, r"</Nobody> is not on the stage; there are </Camera"),
    "no camera": ({"camera": "/Box"}, "</Box> is no Camera; there are </Camera>"),
    "a camera and a view": ({"camera": "/Camera", "views": ("top",)}, "leave one of them out"),
    "a frame outside": ({"frames": (900.0,)}, "900, which is outside of the clip; it goes from 1"),
    "no frames": ({"frames": ()}, "names no frame"),
}


@pytest.mark.parametrize("what", REFUSED)
def test_what_cannot_be_looked_at_is_refused(shots, what):
    asked, sentence = REFUSED[what]
    with pytest.raises(InputError, match=sentence):
        look_at(shots.shot, **asked)


def test_a_stage_with_nothing_to_see_is_refused(tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "empty.usda"))
    UsdGeom.Cube.Define(stage, "/Hidden").CreateVisibilityAttr("invisible")
    UsdGeom.Cube.Define(stage, "/Guide").CreatePurposeAttr("guide")
    stage.GetRootLayer().Save()
    with pytest.raises(InputError, match=r"empty.usda: there is nothing to see at 0"):
        look_at(tmp_path / "empty.usda")


def test_who_stays_at_rest_is_left_out_while_others_move(shots, tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "waiting.usda"))
    stage.GetRootLayer().subLayerPaths = [str(shots.shot)]
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    rest = stage.DefinePrim("/Idle/Rest", "SkelAnimation")
    stage.GetPrimAtPath("/Idle/Skeleton").GetRelationship("skel:animationSource").SetTargets(
        [rest.GetPath()]
    )
    stage.GetRootLayer().Save()
    looked = look_at(tmp_path / "waiting.usda", frames=ENDS)
    panel = strip_of(looked).rows[0].panels[0]
    assert [len(panel.bodies), len(panel.surfaces)] == [1, 1]
    assert looked.notes == ("left out, because in their rest pose: </Idle/Skeleton>",)


def test_a_stage_at_fault_is_drawn_all_the_same_and_told_of(shots, tmp_path):
    text = shots.shot.read_text()
    (tmp_path / "wrong.usda").write_text(text.replace(f'joint = "{WRIST}"', 'joint = "nobody"'))
    looked = look_at(tmp_path / "wrong.usda", frames=ENDS)
    assert len(strip_of(looked).rows[0].panels[0].bodies) == 2
    (note,) = looked.notes
    assert note.startswith("what </Asked/Skeleton/Edit> asks is not seen: ")
    assert "nobody" in note


def test_contacts_are_marked_while_they_are_near_in_time(shots, tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "held.usda"))
    stage.GetRootLayer().subLayerPaths = [str(shots.shot)]
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    stage.SetTimeCodesPerSecond(24.0)
    held = ContactConstraint(path="", skeleton=ASKED, joint=WRIST, times=(0.0, 1.0 / 24.0))
    author(stage, f"{ASKED}/Edit/Held", held)
    stage.GetRootLayer().Save()
    strip = strip_of(look_at(tmp_path / "held.usda", frames=ENDS))
    numbers = [
        [mark for mark in panel.marks if getattr(mark, "sign", "") == "number"]
        for panel in strip.rows[0].panels
    ]
    assert [[each.text for each in one] for one in numbers] == [["1"], ["1"]]
    assert numbers[0][0].opacity == 1.0 > numbers[1][0].opacity
