"""A stage on which nothing is wrong, and every way to put something wrong on it."""

from pathlib import Path

import pytest
from pxr import Gf, Sdf, Ts, Usd, UsdGeom

from usdmotion.usd import registration

registration.register()

JOINTS = ["hips", "hips/spine", "hips/spine/arm", "hips/spine/arm/hand", "hips/leg"]
SKELETON = "/Body/Skeleton"
EDIT = f"{SKELETON}/Edit"


@pytest.fixture
def stage():
    """Return a stage that may be spoilt."""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    assert layer.Import(str(Path(__file__).with_name("good.usda")))
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


def half(stage):
    """Only one of the two curves of a noise pattern is there, whatever was."""
    put(f"{EDIT}/Detection", "usdmotion:sigmaMax", 0.1)(stage)
    epsilon = stage.GetPrimAtPath(f"{EDIT}/Detection").GetAttribute("usdmotion:epsilonMax")
    epsilon.Clear()


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
    ("ArrayLength", animate("/Normalized", "usdmotion:limbLengths", [0.5] * 4, [0.5, 0.5])),
    ("ArrayLength", put("/Normalized", "usdmotion:limbFrames", [Gf.Quatf(1)] * 2)),
    ("PartialMotion", forget("/Normalized", "usdmotion:rootPosition")),
    ("PartialMotion", forget("/Normalized", "usdmotion:limbs")),
    ("PartialMotion", forget("/Normalized", "usdmotion:spine")),
    ("PartialMotion", put("/Normalized", "usdmotion:spine", [(0, 0, 0)] * 4)),
    ("PartialMotion", put("/Normalized", "usdmotion:segments", ["vl5", "skullbase"])),
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
    ("UnknownToken", put(f"{EDIT}/Detection", "usdmotion:kinds", ["space", "sphere"])),
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
    ("WrongGround", point(EDIT, "usdmotion:ground", "/Body/Walk")),
    ("TooManyTargets", point(EDIT, "usdmotion:skeleton", SKELETON, "/Prop")),
    ("NoOtherEnd", put(f"{EDIT}/Distance", "usdmotion:otherJoint", "")),
    ("NoRegion", point(f"{EDIT}/Region", "usdmotion:region")),
    ("ZeroAxis", put(f"{EDIT}/Aim", "usdmotion:aim", (0, 0, 0))),
    ("NoObject", put(f"{EDIT}/Detection", "usdmotion:joint", "")),
    ("TwoObjects", point(f"{EDIT}/Detection", "usdmotion:object", "/Prop")),
    ("UnknownDetector", put(f"{EDIT}/Detection", "usdmotion:detector", "contact")),
    ("HalfAPattern", half),
    ("OutOfLimits", put(f"{EDIT}/Detection", "usdmotion:minimum", -1.0)),
    ("OutOfLimits", animate(f"{EDIT}/Detection", "usdmotion:sigmaMax", 0.1, -0.1)),
    ("RecruitingRule", put(f"{EDIT}/Foot", "usdmotion:recruits", ["hips/leg"])),
    ("RanksAboveBalance", put(f"{EDIT}/Balance", "usdmotion:priority", 9)),
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


@pytest.fixture(params=CASES, ids=[f"{index}-{name}" for index, (name, _) in enumerate(CASES)])
def case(request):
    """Return the name of a fault and what puts it on the stage."""
    return request.param


@pytest.fixture(scope="session")
def named():
    """Return the names of all faults that there is a case of."""
    return {name for name, _ in CASES}


@pytest.fixture(name="put", scope="session")
def put_():
    """Return `put`."""
    return put


@pytest.fixture(name="point", scope="session")
def point_():
    """Return `point`."""
    return point
