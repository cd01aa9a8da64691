"""What is meant by what is selected."""

import pytest
from pxr import Usd

from usdmotion import SceneError
from usdmotion.usdview.selection import Selection

TWO = """#usda 1.0
def Xform "World" {
    def SkelRoot "Man" {
        def Skeleton "Bones" (prepend apiSchemas = ["SkelBindingAPI"]) {
            uniform token[] joints = ["hips", "hips/hand"]
            rel skel:animationSource = </World/Man/Walk>
            def MotionEdit "Edit" {
                def MotionPositionConstraint "Hand" {
                    uniform token usdmotion:joint = "hips/hand"
                    def MotionGoal "Reach" {}
                    def Xform "Guides" { def Mesh "Reach" {} }
                }
                def MotionDetection "hand" {
                    uniform token usdmotion:joint = "hips/hand"
                    def MotionContactConstraint "Contact01" { def Mesh "Footprint" {} }
                    def MotionContactConstraint "Contact02" {}
                }
            }
        }
        def SkelAnimation "Walk" { uniform token[] joints = ["hips", "hips/hand"] }
        def Mesh "Body" {}
    }
    def SkelRoot "Woman" {
        def Skeleton "Bones" { uniform token[] joints = ["hips"] }
    }
    def Mesh "Skin" (prepend apiSchemas = ["SkelBindingAPI"]) {
        rel skel:skeleton = </World/Man/Bones>
    }
    def MotionEdit "Away" { rel usdmotion:skeleton = </World/Woman/Bones> }
    def Xform "Set" { def Cube "Box" {} }
    def MotionDetection "Box" { rel usdmotion:object = </World/Set/Box> }
    def Scope "Looks" {}
}
"""
ONE = """#usda 1.0
def Skeleton "Bones" {
    uniform token[] joints = ["hips"]
    def MotionEdit "Edit" {
        def Xform "Guides" {
            uniform token purpose = "guide"
            def Skeleton "Ghost" {}
        }
    }
}
def Cube "Box" {}
"""
MAN, WOMAN = "/World/Man/Bones", "/World/Woman/Bones"
EDIT = f"{MAN}/Edit"


@pytest.fixture
def selected():
    """Return what selects prims, on the stage with two characters or on another."""
    stages = []  # prims live as long as their stage

    def select(*paths, text=TWO):
        stages.append(Usd.Stage.CreateInMemory())
        stages[-1].GetRootLayer().ImportFromString(text.replace(" }", "\n}").replace("{ ", "{\n"))
        prims = tuple(stages[-1].GetPrimAtPath(path) for path in paths)
        assert all(prims)
        return Selection(stages[-1], prims, 1.0)

    return select


@pytest.mark.parametrize(
    "path",
    [
        EDIT,
        f"{EDIT}/Hand",
        f"{EDIT}/Hand/Reach",
        f"{EDIT}/Hand/Guides/Reach",
        f"{EDIT}/hand/Contact01/Footprint",
        MAN,
        "/World/Man",
        "/World/Man/Body",
        "/World/Man/Walk",
        "/World/Skin",
    ],
)
def test_whatever_belongs_to_a_character_means_its_skeleton_and_its_edit(selected, path):
    selection = selected(path)
    assert (selection.skeletons, selection.edits, selection.props) == ((MAN,), (EDIT,), ())


def test_an_edit_elsewhere_means_the_skeleton_that_it_names(selected):
    assert selected("/World/Away").skeletons == (WOMAN,)
    assert selected(WOMAN).edits == ("/World/Away",)


def test_several_act_together_each_once(selected):
    selection = selected("/World/Man/Body", f"{EDIT}/Hand", "/World/Woman")
    assert selection.skeletons == (MAN, WOMAN)
    assert selection.edits == (EDIT, "/World/Away")


def test_what_holds_all_of_them_means_all_of_them(selected):
    assert selected("/World").skeletons == (MAN, WOMAN)


@pytest.mark.parametrize("paths", [(), ("/Box",)])
def test_the_only_one_is_meant_where_nothing_else_is(selected, paths):
    selection = selected(*paths, text=ONE)
    assert (selection.skeleton, selection.edits) == ("/Bones", ("/Bones/Edit",))


def test_of_several_one_has_to_be_selected(selected):
    with pytest.raises(SceneError, match=f"select a Skeleton; there are <{MAN}>, <{WOMAN}>"):
        _ = selected().skeletons
    with pytest.raises(SceneError, match=r"select a MotionEdit; there are .*</World/Away>"):
        _ = selected("/World/Looks").edits
    with pytest.raises(SceneError, match=r"select one Skeleton only, not .*Woman"):
        _ = selected("/World").skeleton


def test_a_skeleton_without_an_edit_does_not_mean_that_of_another(selected):
    text = ONE + 'def SkelRoot "Other" { def Skeleton "Bones" {} }'
    with pytest.raises(SceneError, match="</Other/Bones> has no MotionEdit"):
        _ = selected("/Other", text=text).edits


def test_a_stage_without_any(selected):
    for asked in ("skeletons", "edits"):
        with pytest.raises(SceneError, match="the stage has no"):
            getattr(selected("/Box", text='#usda 1.0\ndef Cube "Box" {}'), asked)


@pytest.mark.parametrize("path", ["", "/Reach", "/Guides/Reach"])
def test_a_constraint_is_meant_by_all_that_is_in_it(selected, path):
    selection = selected(f"{EDIT}/Hand{path}")
    assert (selection.constraint, selection.joint) == (f"{EDIT}/Hand", "hips/hand")


def test_no_constraint_and_two(selected):
    with pytest.raises(SceneError, match=r"^select a constraint$"):
        _ = selected().constraint
    with pytest.raises(SceneError, match=f"select a constraint; <{EDIT}> is none"):
        _ = selected(EDIT).constraint
    with pytest.raises(SceneError, match="select one constraint only"):
        _ = selected(f"{EDIT}/Hand", f"{EDIT}/hand/Contact01").constraint


def test_contacts_are_meant_together(selected):
    detection = f"{EDIT}/hand"
    selection = selected(f"{detection}/Contact01/Footprint", f"{detection}/Contact02")
    assert selection.contacts == (f"{detection}/Contact01", f"{detection}/Contact02")
    with pytest.raises(SceneError, match=r"select a MotionContactConstraint; .* is none"):
        _ = selected(f"{EDIT}/Hand").contacts


@pytest.mark.parametrize("path", ["/World/Set/Box", "/World/Box"])
def test_a_prop_is_meant_by_itself_and_by_its_detection(selected, path):
    selection = selected(MAN, path)
    assert (selection.prop, selection.skeleton) == ("/World/Set/Box", MAN)
    assert selected(MAN, "/World/Looks").prop == ""


def test_two_props_are_one_too_many(selected):
    with pytest.raises(SceneError, match="select one prim beside the Skeleton only"):
        _ = selected("/World/Set", "/World/Set/Box").prop


def test_nothing_is_selected_where_usdview_focuses_the_root(seat):
    here = seat("dice")
    here.select()
    assert Selection.of(here.api).prims == ()
    assert Selection.of(here.api).time_code == here.stage.GetStartTimeCode()
    here.api.dataModel.currentFrame = Usd.TimeCode(7.5)
    assert Selection.of(here.api).time_code == 7.5
