"""Every check fires on a stage made for it, and is silent on a good one."""

import json
from pathlib import Path

import pytest
from pxr import Gf, Sdf, Ts, Usd, UsdGeom, UsdSkel

import usdmotion.usd.faults
from usdmotion.usd import registration
from usdmotion.usd.faults import CHECKS, find

registration.register()

JOINTS = ["hips", "hips/spine", "hips/spine/arm", "hips/spine/arm/hand", "hips/leg"]
SKELETON = "/Body/Skeleton"
EDIT = f"{SKELETON}/Edit"
GOOD = """#usda 1.0
def SkelRoot "Body"
{
    def SkelAnimation "Walk" (
        prepend apiSchemas = ["MotionResultAPI"]
    )
    {
        uniform token[] joints = @JOINTS@
        float3[] translations.timeSamples = {
            1: [(0, 1, 0), (0, 1, 0), (0, 1, 0), (0, 1, 0), (0, -1, 0)],
            2: [(1, 1, 0), (0, 1, 0), (0, 1, 0), (0, 1, 0), (0, -1, 0)],
        }
        quatf[] rotations = [(1,0,0,0), (1,0,0,0), (1,0,0,0), (1,0,0,0), (1,0,0,0)]
        half3[] scales = [(1,1,1), (1,1,1), (1,1,1), (1,1,1), (1,1,1)]
    }
    def Skeleton "Skeleton" (
        prepend apiSchemas = ["SkelBindingAPI", "MotionSkeletonAPI"]
    )
    {
        rel skel:animationSource = </Body/Walk>
        uniform token[] joints = @JOINTS@
        uniform token[] usdmotion:parts = ["humanoid_root", "vl5", "", "l_radiocarpal", "l_hip"]
        uniform float[] usdmotion:masses = [10, 20, 3, 1, 9]
        uniform float3[] usdmotion:limitsMin = [
            (-inf, -inf, -inf), (-9, 0, 0), (-9, 0, 0), (-9, 0, 0), (-9, 0, 0)
        ]
        uniform float3[] usdmotion:limitsMax = [
            (inf, inf, inf), (9, 0, 0), (9, 0, 0), (9, 0, 0), (9, 0, 0)
        ]
        uniform float[] usdmotion:stiffness = [0, 0.5, 0, 0, 1]
        def MotionEdit "Edit"
        {
            uniform timecode[] usdmotion:range = [1, 2]
            rel usdmotion:ground = [</Floor>, </Wall>]
            custom double usdmotion:option:gain = 0.3
            def MotionPositionConstraint "Foot"
            {
                uniform token usdmotion:joint = "hips/leg"
                uniform token[] usdmotion:recruits = ["hips", "hips/leg"]
            }
            def MotionPositionConstraint "Hand"
            {
                uniform int usdmotion:priority = 2
                uniform token usdmotion:joint = "hips/spine/arm/hand"
                uniform timecode[] usdmotion:times = [1, 1, 2, 2]
                def MotionGoal "Goal"
                {
                    rel usdmotion:space = </Body/Skeleton>
                    uniform token usdmotion:spaceJoint = "hips/spine"
                }
            }
            def MotionDistanceConstraint "Distance"
            {
                uniform int usdmotion:priority = 2
                uniform token usdmotion:joint = "hips/spine/arm"
                uniform token usdmotion:otherJoint = "hips/leg"
            }
            def MotionRegionConstraint "Region"
            {
                uniform int usdmotion:priority = 2
                uniform token usdmotion:joint = "hips/spine/arm"
                rel usdmotion:region = </Wall>
            }
            def MotionAimConstraint "Aim"
            {
                uniform int usdmotion:priority = 2
                uniform token usdmotion:joint = "hips/spine"
            }
            def MotionCenterOfMassConstraint "Balance"
            {
                uniform token[] usdmotion:supports = ["hips/leg"]
                uniform point3d[] usdmotion:supportPoints = [(0, 0, 0)]
            }
            def MotionTrajectoryConstraint "Curve"
            {
                uniform int usdmotion:priority = 2
                uniform token usdmotion:joint = "hips/spine/arm/hand"
                uniform timecode[] usdmotion:times = [1, 2]
                uniform timecode[] usdmotion:keys = [1.2, 1.6]
                uniform timecode[] usdmotion:releases = [1.4, 1.6]
                uniform point3d[] usdmotion:points = [(0, 0, 0), (1, 0, 0)]
                uniform float[] usdmotion:tension = [1, 0]
            }
            def MotionDetection "Detection"
            {
                uniform token usdmotion:joint = "hips/leg"
                def MotionContactConstraint "Contact"
                {
                    uniform token usdmotion:joint = "hips/leg"
                    uniform timecode[] usdmotion:times = [1, 2]
                }
            }
        }
    }
}
def Plane "Wall" {}
def Mesh "Floor" {}
def Xform "Prop" {}
def MotionDetection "PropContacts"
{
    rel usdmotion:object = </Prop>
    def MotionContactConstraint "Contact"
    {
        rel usdmotion:object = </Prop>
    }
}
def MotionNormalized "Normalized"
{
    rel usdmotion:source = </Body/Walk>
    uniform token[] usdmotion:limbs = ["l_hip"]
    quatf[] usdmotion:limbFrames = [(1, 0, 0, 0)]
    double[] usdmotion:limbLengths.timeSamples = { 1: [0.5], 2: [1] }
}
""".replace("@JOINTS@", json.dumps(JOINTS))


@pytest.fixture
def stage():
    layer = Sdf.Layer.CreateAnonymous(".usda")
    assert layer.ImportFromString(GOOD)
    return Usd.Stage.Open(layer)


def put(path, name, value):
    """Return what sets an attribute of a prim, with the type that its schema says."""

    def change(stage):
        prim = stage.GetPrimAtPath(path)
        kind = prim.GetAttribute(name).GetTypeName()
        times = [Sdf.TimeCode(time) for time in value] if kind == "timecode[]" else value
        prim.GetAttribute(name).Set(Sdf.TimeCodeArray(times) if kind == "timecode[]" else value)

    return change


def point(path, name, *targets):
    """Return what sets the targets of a relationship of a prim."""
    return lambda stage: stage.GetPrimAtPath(path).GetRelationship(name).SetTargets(list(targets))


def animate(path, name, *values):
    """Return what gives an attribute of a prim one sample a frame."""

    def change(stage):
        for time, value in enumerate(values, 1):
            stage.GetPrimAtPath(path).GetAttribute(name).Set(value, time)

    return change


def define(path, kind):
    return lambda stage: stage.DefinePrim(path, kind)


def apply(path, api):
    return lambda stage: stage.GetPrimAtPath(path).AddAppliedSchema(api)


def author(path, name, kind, value):
    """Return what writes an attribute with a type of its own."""

    def change(stage):
        spec = stage.GetRootLayer().GetPrimAtPath(path)
        if name in spec.attributes:
            del spec.properties[name]
        Sdf.AttributeSpec(spec, name, kind).default = value

    return change


def overshoot(stage):
    """A spline that is inside the limits at its knots and far outside between them."""
    spline = Ts.Spline("double")
    for time in (0.0, 8.0):
        knot = Ts.Knot(time=time, value=1.0, nextInterp=Ts.InterpCurve)
        knot.SetPreTanWidth(2.0)
        knot.SetPostTanWidth(2.0)
        knot.SetPreTanSlope(-1.0)
        knot.SetPostTanSlope(1.0)
        spline.SetKnot(knot)
    stage.GetPrimAtPath(f"{EDIT}/Hand").GetAttribute("usdmotion:activity").SetSpline(spline)


def stretch(stage):
    UsdGeom.Xformable(stage.GetPrimAtPath("/Body")).AddScaleOp().Set(Gf.Vec3f(1, 2, 1))


def forget(path, name):
    return lambda stage: stage.GetPrimAtPath(path).RemoveProperty(name)


CASES = [
    ("UnknownJoint", put(f"{EDIT}/Hand", "usdmotion:joint", "hand")),
    ("UnknownJoint", put(f"{EDIT}/Hand", "usdmotion:recruits", ["hips/nothing"])),
    ("UnknownJoint", put(f"{EDIT}/Balance", "usdmotion:supports", ["hips/lag"])),
    ("UnknownJoint", put(f"{EDIT}/Hand/Goal", "usdmotion:spaceJoint", "head")),
    ("UnknownJoint", put(f"{EDIT}/Distance", "usdmotion:otherJoint", "head")),
    ("UnknownJoint", put(f"{EDIT}/Detection", "usdmotion:joint", "head")),
    ("UnknownSkeleton", point(f"{EDIT}/Hand/Goal", "usdmotion:space", "/Prop")),
    ("UnknownSkeleton", point(f"{EDIT}/Hand/Goal", "usdmotion:space")),
    ("UnknownSkeleton", define("/Edit", "MotionEdit")),
    ("MissingJoint", put(f"{EDIT}/Hand", "usdmotion:joint", "")),
    ("NoEdit", define("/Lost", "MotionAimConstraint")),
    ("NoConstraint", define("/Lost", "MotionGoal")),
    ("UnknownPart", put(SKELETON, "usdmotion:parts", ["pelvis", "", "", "", ""])),
    ("DuplicatePart", put(SKELETON, "usdmotion:parts", ["vl5", "vl5", "", "", ""])),
    ("ArrayLength", put(SKELETON, "usdmotion:parts", ["vl5", "vl4"])),
    ("ArrayLength", put(SKELETON, "usdmotion:masses", [1.0, 2.0])),
    ("ArrayLength", put(SKELETON, "usdmotion:stiffness", [1.0] * 6)),
    ("ArrayLength", put(f"{EDIT}/Curve", "usdmotion:points", [(0, 0, 0)])),
    ("ArrayLength", put(f"{EDIT}/Curve", "usdmotion:points", [])),
    ("ArrayLength", put(f"{EDIT}/Curve", "usdmotion:releases", [1.2])),
    ("ArrayLength", put(f"{EDIT}/Curve", "usdmotion:tension", [1.0])),
    ("ArrayLength", put(f"{EDIT}/Balance", "usdmotion:supportPoints", [(0, 0, 0)] * 2)),
    ("ArrayLength", animate("/Normalized", "usdmotion:limbLengths", [0.5], [0.5, 0.5])),
    ("ArrayLength", put("/Normalized", "usdmotion:limbFrames", [Gf.Quatf(1)] * 2)),
    ("LimitsCrossed", put(SKELETON, "usdmotion:limitsMin", [(10, 10, 10)] * 5)),
    ("KeyTimesCount", put(f"{EDIT}/Hand", "usdmotion:times", [1, 2, 3])),
    ("KeyTimesCount", put(f"{EDIT}/Hand/Goal", "usdmotion:times", [1])),
    ("KeyTimesCount", put(EDIT, "usdmotion:range", [1])),
    ("KeyTimesCount", put(f"{EDIT}/Curve", "usdmotion:times", [])),
    ("KeyTimesOrder", put(f"{EDIT}/Hand", "usdmotion:times", [1, 3, 2, 4])),
    ("KeyTimesOrder", put(f"{EDIT}/Hand/Goal", "usdmotion:times", [2, 1])),
    ("KeyTimesOrder", put(EDIT, "usdmotion:range", [2, 1])),
    ("KeyTimesOrder", put(f"{EDIT}/Curve", "usdmotion:keys", [1.6, 1.6])),
    ("KeyTimesOrder", put(f"{EDIT}/Curve", "usdmotion:releases", [1.1, 1.6])),
    ("KeyTimesOrder", put(f"{EDIT}/Curve", "usdmotion:releases", [1.7, 1.8])),
    ("KeyOutside", put(f"{EDIT}/Curve", "usdmotion:keys", [1.3, 2.5])),
    ("MisappliedAPI", apply("/Body/Walk", "MotionSkeletonAPI")),
    ("MisappliedAPI", apply("/Prop", "MotionResultAPI")),
    ("MissingAPI", author("/Body/Walk", "usdmotion:parts", Sdf.ValueTypeNames.TokenArray, [])),
    ("UnknownToken", put(f"{EDIT}/Hand", "usdmotion:axes", "zyx")),
    ("UnknownToken", put(f"{EDIT}/Hand/Goal", "usdmotion:mode", "relative")),
    ("UnknownToken", put(f"{EDIT}/Detection", "usdmotion:kinds", ["space", "plane"])),
    ("OutOfLimits", put(f"{EDIT}/Hand", "usdmotion:activity", 1.5)),
    ("OutOfLimits", put(f"{EDIT}/Hand", "usdmotion:activity", float("nan"))),
    ("OutOfLimits", put(EDIT, "usdmotion:passes", 0)),
    ("OutOfLimits", put(SKELETON, "usdmotion:stiffness", [0, 0, 0, 0, 1.5])),
    ("OutOfLimits", put(SKELETON, "usdmotion:masses", [1, 1, -1, 1, 1])),
    ("OutOfLimits", animate(f"{EDIT}/Hand/Goal", "usdmotion:activity", 0.5, -0.5)),
    ("OutOfLimits", overshoot),
    ("UniformAnimated", animate(f"{EDIT}/Hand", "usdmotion:priority", 1, 2)),
    ("WrongType", author(EDIT, "usdmotion:range", Sdf.ValueTypeNames.DoubleArray, [1.0, 2.0])),
    ("WrongType", author(f"{EDIT}/Hand", "usdmotion:joint", Sdf.ValueTypeNames.Int, 3)),
    ("UnknownProperty", author(EDIT, "usdmotion:solvers", Sdf.ValueTypeNames.Token, "ccd")),
    ("MissingTarget", point(EDIT, "usdmotion:skeleton", "/Nobody")),
    ("MissingTarget", point(EDIT, "usdmotion:ground", "/Nowhere")),
    ("WrongTarget", point(EDIT, "usdmotion:source", "/Prop")),
    ("WrongTarget", point(f"{EDIT}/Region", "usdmotion:region", "/Prop")),
    ("TooManyTargets", point(EDIT, "usdmotion:skeleton", SKELETON, "/Prop")),
    ("NoOtherEnd", put(f"{EDIT}/Distance", "usdmotion:otherJoint", "")),
    ("NoRegion", point(f"{EDIT}/Region", "usdmotion:region")),
    ("ZeroAxis", put(f"{EDIT}/Aim", "usdmotion:aim", (0, 0, 0))),
    ("RecruitingRule", put(f"{EDIT}/Foot", "usdmotion:recruits", ["hips/leg"])),
    ("NoJoints", put(SKELETON, "joints", [])),
    ("NoJoints", put("/Body/Walk", "joints", [])),
    ("DuplicateJoint", put(SKELETON, "joints", [*JOINTS[:4], "hips"])),
    ("DuplicateJoint", put("/Body/Walk", "joints", [*JOINTS[:4], "hips"])),
    ("WrongTopology", put(SKELETON, "joints", JOINTS[::-1])),
    ("TransformCount", put(SKELETON, "restTransforms", [Gf.Matrix4d(1)] * 2)),
    ("TransformCount", put(SKELETON, "bindTransforms", [Gf.Matrix4d(1)] * 6)),
    ("TransformCount", put("/Body/Walk", "rotations", [Gf.Quatf(1)])),
    ("TransformCount", animate("/Body/Walk", "scales", [Gf.Vec3h(1)] * 5, [Gf.Vec3h(1)])),
    ("MissingTransforms", forget("/Body/Walk", "scales")),
    ("NoAnimation", point(SKELETON, "skel:animationSource")),
    ("AnimationJoints", put("/Body/Walk", "joints", ["a", "b", "c", "d", "e"])),
    ("UnevenScale", stretch),
]


@pytest.mark.parametrize("name, change", CASES, ids=[f"{n}-{c[0]}" for n, c in enumerate(CASES)])
def test_a_fault_is_found_and_named_with_its_prim_and_what_would_do(stage, name, change):
    change(stage)
    found = [fault for fault in find(stage) if fault.name == name]
    assert found, find(stage)
    for fault in found:
        assert fault.sentence.startswith(f"<{fault.path}> ")
        assert stage.GetPrimAtPath(fault.path)
        assert "\n" not in fault.sentence and len(fault.sentence) < 300
        # What is wrong, and after the last of these what would do.
        assert any(mark in fault.sentence for mark in ("; ", ", so ", "?"))


def test_nothing_is_found_on_a_good_stage(stage):
    assert find(stage) == []


def test_every_fault_that_can_be_found_has_a_case():
    folder = Path(usdmotion.usd.faults.__file__).parent
    source = "".join(path.read_text() for path in sorted(folder.glob("*.py")))
    calls = source.split("yield error(")[1:] + source.split("yield warning(")[1:]
    assert {call.split('"')[1] for call in calls} == {name for name, _ in CASES}


def test_one_fault_of_a_skeleton_is_not_told_by_everything_that_uses_it(stage):
    put(SKELETON, "joints", [])(stage)
    assert [fault.name for fault in find(stage)] == ["NoJoints"]


def test_an_unknown_joint_is_answered_with_what_was_meant(stage):
    put(f"{EDIT}/Hand", "usdmotion:joint", "hand")(stage)
    (fault,) = find(stage)
    assert fault.path == f"{EDIT}/Hand"
    assert "'hand'" in fault.sentence
    assert "did you mean 'hips/spine/arm/hand'?" in fault.sentence


def test_a_broken_recruiting_rule_names_the_joints_that_mend_it(stage):
    put(f"{EDIT}/Foot", "usdmotion:recruits", ["hips/leg"])(stage)
    found = [fault for fault in find(stage) if fault.path == f"{EDIT}/Hand"]
    assert [fault.severity for fault in found] == ["warning"]
    assert "'hips'" in found[0].sentence and f"<{EDIT}/Foot>" in found[0].sentence


def test_mending_the_recruits_as_told_silences_the_rule(stage):
    put(f"{EDIT}/Foot", "usdmotion:recruits", ["hips/leg"])(stage)
    put(f"{EDIT}/Foot", "usdmotion:recruits", ["hips/leg", "hips"])(stage)
    assert find(stage) == []


def test_the_default_recruits_end_at_the_joint_that_travels_where_no_part_names_the_root(stage):
    # Of the five joints only the hips travel; a foot that recruits from them down keeps the rule.
    put(SKELETON, "usdmotion:parts", ["", "", "", "", ""])(stage)
    assert find(stage) == []


def test_joints_above_the_root_of_the_solve_are_not_recruited_by_default(stage):
    put(SKELETON, "usdmotion:parts", ["", "humanoid_root", "", "", ""])(stage)
    put(f"{EDIT}/Foot", "usdmotion:recruits", ["hips/leg"])(stage)
    # The arm now ends at the spine, and only what crosses over to the leg needs the hips.
    lows = {fault.path for fault in find(stage) if fault.name == "RecruitingRule"}
    assert f"{EDIT}/Aim" not in lows


def test_an_inactive_constraint_is_not_looked_at(stage):
    put(f"{EDIT}/Aim", "usdmotion:aim", (0, 0, 0))(stage)
    stage.GetPrimAtPath(f"{EDIT}/Aim").SetActive(False)
    assert find(stage) == []


def test_a_skeleton_inside_an_instance_is_looked_at(stage):
    inner = stage.DefinePrim("/Class/Skeleton", "Skeleton")
    UsdSkel.Skeleton(inner).CreateJointsAttr(["a/b", "a"])
    stage.GetPrimAtPath("/Class").SetSpecifier(Sdf.SpecifierClass)
    instance = stage.DefinePrim("/Instance", "SkelRoot")
    instance.GetReferences().AddInternalReference("/Class")
    instance.SetInstanceable(True)
    assert "/Instance/Skeleton" in {fault.path for fault in find(stage)}


def test_an_edit_without_any_motion_cannot_be_solved_but_a_skeleton_may_rest(stage):
    point(SKELETON, "skel:animationSource")(stage)
    severities = {fault.path: fault.severity for fault in find(stage)}
    assert severities == {SKELETON: "warning", EDIT: "error"}


def test_only_a_line_needs_an_axis(stage):
    contact = f"{EDIT}/Detection/Contact"
    put(contact, "usdmotion:axis", (0, 0, 0))(stage)
    assert find(stage) == []
    put(contact, "usdmotion:kind", "line")(stage)
    assert [fault.name for fault in find(stage)] == ["ZeroAxis"]


def test_the_validators_that_usd_lists_are_the_checks():
    plugin = Path(usdmotion.usd.faults.__file__).parent.parent / "validation" / "plugInfo.json"
    (declared,) = json.loads(plugin.read_text())["Plugins"]
    validators = declared["Info"]["Validators"]
    assert validators.pop("keywords") == ["UsdMotion"]
    assert declared["Type"] == "python"
    assert validators == {
        check.name: {"doc": check.find.__doc__, "schemaTypes": list(check.types)}
        for check in CHECKS
    }


needs_validators = pytest.mark.skipif(
    not registration.has_python_validators(), reason="validators in Python need USD 26.5"
)


def validate(stage):
    """Return path, name and sentence of what USD's own validation finds with our validators."""
    from pxr import UsdValidation

    errors = UsdValidation.ValidationContext(keywords=["UsdMotion"]).Validate(stage)
    return {
        (str(error.GetSites()[0].GetPrim().GetPath()), error.GetName(), error.GetMessage())
        for error in errors
    }


@needs_validators
@pytest.mark.parametrize("name, change", CASES, ids=[f"{n}-{c[0]}" for n, c in enumerate(CASES)])
def test_usds_own_validation_finds_the_same(stage, name, change):
    change(stage)
    same = {(fault.path, fault.name, fault.sentence) for fault in find(stage)}
    assert name in {fault[1] for fault in same}
    assert validate(stage) == same


@needs_validators
def test_usds_own_validation_is_silent_on_a_good_stage(stage):
    assert validate(stage) == set()


@needs_validators
def test_a_validator_says_which_it_is_and_how_bad_it_is(stage):
    from pxr import UsdValidation

    put(f"{EDIT}/Foot", "usdmotion:recruits", ["hips/leg"])(stage)
    context = UsdValidation.ValidationContext(keywords=["UsdMotion"])
    error = context.Validate(stage)[0]
    assert error.GetIdentifier() == "usdmotion.usd.validation:Recruiting.RecruitingRule"
    assert error.GetType() == UsdValidation.ValidationErrorType.Warn
