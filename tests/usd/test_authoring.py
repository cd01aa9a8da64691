"""What is authored from Python is read back as it was."""

import dataclasses

import numpy as np
import pytest
from pxr import Usd, UsdGeom

from usdmotion import usd
from usdmotion.constraints import (
    DistanceConstraint,
    Goal,
    OrientationConstraint,
    PositionConstraint,
    Region,
    RegionConstraint,
    TrajectoryConstraint,
    attributes,
    built_in,
    relations,
)
from usdmotion.errors import SceneError

EDIT = "/Man/Bones/Edit"
HALF = np.sqrt(0.5)
CODES = np.arange(1.0, 6.0)


@pytest.fixture
def there_and_back(text, save, read):
    """Return a function that authors a constraint on a stage and reads it from there."""

    def run(constraint, *, time_codes=None, **options):
        man = text.man(edit="", inside='def Cube "Rock" {}', **options)
        path = save(man, header="metersPerUnit = 0.01")
        stage = Usd.Stage.Open(str(path))
        usd.author_edit(stage, EDIT)
        usd.author(stage, f"{EDIT}/It", constraint, time_codes=time_codes)
        stage.Save()
        del stage
        (scene,) = read(path).scenes
        return scene.constraints[0]

    return run


def different(each):
    """Return a value for an attribute that is not its default."""
    by_name = {
        "times": (0.0, 1 / 24, 2 / 24, 4 / 24),
        "joint": "hip/knee/ankle",
        "recruits": ("hip/knee", "hip"),
        "axes": "xz",
        "mode": "offset",
        "supports": ("hip/knee/ankle", "hip"),
        "support_points": np.array([[0.1, 0.2, 0.3], [0.4, 0.5, 0.6]]),
        "keys": (1 / 24, 3 / 24),
        "releases": (2 / 24, 3 / 24),
        "points": np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]),
        "tension": (1.0, 0.5),
        "continuity": (0.25, -0.5),
        "bias": (0.0, 0.75),
        "kind": "line",
        "other_joint": "hip/head",
        "bound": "atMost",
        "side": "inside",
        "orientation": np.array((0.0, HALF, 0.0, HALF)),
        "template": True,
        "rotation": np.array((HALF, 0.0, 0.0, HALF), dtype=np.float32).astype(float),
    }
    if each.field in by_name:
        return by_name[each.field]
    if isinstance(each.default, np.ndarray):
        return np.linspace(0.25, 0.75, len(each.default))
    return type(each.default)(0.5 if isinstance(each.default, float) else 3)


def needed(kind):
    """Return the fields without which a kind cannot be read."""
    fields = {
        TrajectoryConstraint: {"times": (0.0, 2 / 24)},
        DistanceConstraint: {"other_joint": "hip/head"},
        RegionConstraint: {"region": Region(path="/Man/Rock", extent=np.full(3, 0.01))},
    }
    return fields.get(kind, {})


def differ(kind):
    """Return the fields of a kind, none at its default where the test knows another value."""
    return needed(kind) | {each.field: different(each) for each in attributes(kind)}


def assert_equal(found, wanted):
    assert type(found) is type(wanted)
    for each in attributes(type(wanted)):
        held = getattr(found, each.field)
        if isinstance(held, (str, int)) or (isinstance(held, tuple) and each.unit != "time"):
            assert held == getattr(wanted, each.field), each.field
        else:
            np.testing.assert_allclose(held, getattr(wanted, each.field), atol=1e-12)
    for each in relations(type(wanted)):
        named, meant = getattr(found, each.field), getattr(wanted, each.field)
        assert getattr(named, "path", named) == getattr(meant, "path", meant), each.field


@pytest.mark.parametrize("kind", built_in(), ids=lambda kind: kind.schema)
def test_every_kind_is_read_as_it_was_authored(there_and_back, kind):
    constraint = kind(path="", skeleton="/Man/Bones", **differ(kind))
    assert_equal(there_and_back(constraint), constraint)


@pytest.mark.parametrize("kind", built_in(), ids=lambda kind: kind.schema)
def test_every_kind_at_its_defaults_is_read_as_such(there_and_back, kind):
    constraint = kind(path="", skeleton="/Man/Bones", joint="hip", **needed(kind))
    assert_equal(there_and_back(constraint), constraint)


@pytest.mark.parametrize("kind", built_in(), ids=lambda kind: kind.schema)
def test_what_may_be_animated_is_read_frame_by_frame(there_and_back, kind):
    frames = np.linspace(0.1, 0.9, 5)
    animated = {
        each.field: frames if np.ndim(each.default) == 0 else np.outer(frames, (1.0, 2.0, 3.0))
        for each in attributes(kind)
        if each.animated
    }
    constraint = kind(path="", skeleton="/Man/Bones", joint="hip", **animated, **needed(kind))
    assert_equal(there_and_back(constraint, time_codes=CODES), constraint)


SCALED = """double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 5: (50, 0, 0) }
    double xformOp:rotateZ = 90
    float3 xformOp:scale = (2, 2, 2)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ", "xformOp:scale"]"""


@pytest.mark.parametrize(
    "goal",
    [
        Goal(translation=np.array((1.0, 2.0, 3.0))),
        Goal(translation=np.array((1.0, 2.0, 3.0)), rotation=np.array((0.0, 0.6, 0.0, 0.8))),
        Goal(translation=np.array((0.1, 0.0, 0.0)), mode="offset", activity=0.5),
        Goal(rotation=np.array((0.6, 0.0, 0.0, 0.8)), mode="offset"),
        Goal(translation=np.arange(15.0).reshape(5, 3), activity=np.linspace(0, 1, 5)),
        Goal(translation=np.array((0.1, 0.2, 0.3)), joint=("/Man/Bones", "hip/head")),
        Goal(translation=np.arange(15.0).reshape(5, 3), joint=("/Man/Bones", "hip/head")),
        Goal(times=(0.0, 1 / 24)),
    ],
)
@pytest.mark.parametrize("xform", ["", SCALED])
def test_a_goal_is_read_as_it_was_authored_wherever_it_hangs(there_and_back, goal, xform):
    constraint = PositionConstraint(
        path="", skeleton="/Man/Bones", joint="hip", point=np.array((0.1, 0.0, 0.2)), goals=(goal,)
    )
    found = there_and_back(constraint, time_codes=CODES, xform=xform)
    np.testing.assert_allclose(found.point, constraint.point, atol=1e-12)
    (back,) = found.goals
    assert_equal(back, goal)
    assert back.joint == goal.joint
    np.testing.assert_allclose(back.translation, goal.translation, atol=1e-9)
    np.testing.assert_allclose(back.rotation, goal.rotation, atol=1e-9)
    np.testing.assert_allclose(back.axes, goal.axes, atol=1e-9)


def test_goals_keep_their_names_and_others_are_given_one(text, save):
    stage = Usd.Stage.Open(str(save(text.man(edit=""))))
    goals = (Goal(path="/old/Wrist"), Goal())
    constraint = PositionConstraint(path="", skeleton="/Man/Bones", joint="hip", goals=goals)
    usd.author_edit(stage, EDIT)
    usd.author(stage, f"{EDIT}/It", constraint)
    names = [prim.GetName() for prim in stage.GetPrimAtPath(f"{EDIT}/It").GetChildren()]
    assert names == ["Wrist", "Goal2"]


def test_what_is_authored_is_a_guide_that_nobody_renders(text, save):
    stage = Usd.Stage.Open(str(save(text.man(edit=""))))
    usd.author_edit(stage, EDIT)
    usd.author(
        stage,
        f"{EDIT}/It",
        OrientationConstraint(path="", skeleton="/Man/Bones", joint="hip", goals=(Goal(),)),
    )
    for path in (EDIT, f"{EDIT}/It", f"{EDIT}/It/Goal1"):
        assert UsdGeom.Imageable(stage.GetPrimAtPath(path)).ComputePurpose() == "guide"


def test_what_is_animated_needs_a_time_code_for_each_frame(text, save):
    stage = Usd.Stage.Open(str(save(text.man(edit=""))))
    constraint = PositionConstraint(
        path="", skeleton="/Man/Bones", joint="hip", activity=np.linspace(0, 1, 5)
    )
    with pytest.raises(SceneError, match="is given 5 values for 1 time codes"):
        usd.author(stage, f"{EDIT}/It", constraint)


def test_an_edit_is_read_as_it_was_authored(text, save, read):
    path = save(text.man(edit=""))
    stage = Usd.Stage.Open(str(path))
    usd.author_edit(
        stage,
        "/Edit",
        skeleton="/Man/Bones",
        source="/Man/Walk",
        solver="ccd",
        frames=(2, 4),
        sample_rate=48,
        smoothing=2.5,
        passes=3,
        options={"iterations": 3, "gain": 0.5, "finish": True, "mode": "fast"},
    )
    stage.Save()
    del stage
    shot = read(path)
    (edit,) = shot.scenes[0].edits
    assert (edit.skeleton, edit.solver) == ("/Man/Bones", "ccd")
    assert (edit.smoothing, edit.passes) == (2.5, 3)
    assert edit.options == {"iterations": 3, "gain": 0.5, "finish": True, "mode": "fast"}
    assert shot.scenes[0].time_codes.tolist() == [2, 2.5, 3, 3.5, 4]
    assert shot.takes[0].source == "/Man/Walk"


def test_authoring_again_changes_what_is_there(text, save, read):
    path = save(text.man(edit=""))
    stage = Usd.Stage.Open(str(path))
    usd.author_edit(stage, EDIT)
    first = PositionConstraint(path="", skeleton="/Man/Bones", joint="hip", priority=3)
    for constraint in (first, dataclasses.replace(first, priority=2, axes="x")):
        usd.author(stage, f"{EDIT}/It", constraint)
    stage.Save()
    del stage
    found = read(path).scenes[0].constraints[0]
    assert (found.priority, found.axes) == (2, "x")


@pytest.mark.parametrize("path", ["", "Edit", "/Man/", "/Man.joints", "/a b"])
def test_what_is_no_path_is_refused(text, save, path):
    stage = Usd.Stage.Open(str(save(text.man())))
    with pytest.raises(SceneError, match="is no path of a prim"):
        usd.author_edit(stage, path)


def test_a_distance_between_two_characters_is_read_as_it_was_authored(text, save, read):
    path = save(text.man("Ann", edit="") + text.man("Bob", edit="", xform=text.SCALED))
    stage = Usd.Stage.Open(str(path))
    constraint = DistanceConstraint(
        path="",
        skeleton="/Ann/Bones",
        joint="hip",
        other_skeleton="/Bob/Bones",
        other_joint="hip/head",
        other_point=np.array((0.2, 0.4, 0.6)),
    )
    usd.author_edit(stage, "/Ann/Bones/Edit")
    usd.author(stage, "/Ann/Bones/Edit/It", constraint)
    stage.Save()
    point = stage.GetAttributeAtPath("/Ann/Bones/Edit/It.usdmotion:otherPoint").Get()
    np.testing.assert_allclose(point, (0.1, 0.2, 0.3))  # Bob is scaled by two
    del stage
    (scene,) = read(path).scenes
    assert [each.path for each in scene.characters] == ["/Ann/Bones", "/Bob/Bones"]
    assert scene.constraints[0].other_skeleton == "/Bob/Bones"
    assert_equal(scene.constraints[0], constraint)


def test_a_region_without_a_prim_cannot_be_authored(text, save):
    stage = Usd.Stage.Open(str(save(text.man(edit=""))))
    constraint = RegionConstraint(path="", skeleton="/Man/Bones", joint="hip", region=Region())
    with pytest.raises(SceneError, match="usdmotion:region whose path nobody says"):
        usd.author(stage, f"{EDIT}/It", constraint)
