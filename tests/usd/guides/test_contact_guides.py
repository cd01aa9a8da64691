"""What is drawn of contacts is where things are in the world, and in nobody's way."""

from pathlib import Path

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom, UsdSkel

from usdmotion import usd
from usdmotion.demos.rolling import CORNERS
from usdmotion.guides import COLORS
from usdmotion.plugins import host

DETECTIONS = "/Dice/Detections"
NEAR = 0.1
"""How far a drawn point may be from where it is, besides what a contact leaves: a millimetre."""
WALKER = "/World/Walker/Skeleton"


def file_of(stage):
    return Path(stage.GetRootLayer().realPath)


def guide(contact, name):
    return contact.GetStage().GetPrimAtPath(f"{contact.GetPath()}/Guides/{name}")


def world_points(prim, code=0.0):
    """Return the points of a guide in the world, in stage units."""
    points = np.array(UsdGeom.PointBased(prim).GetPointsAttr().Get(code))
    matrix = np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(code))
    return points @ matrix[:3, :3] + matrix[3, :3]


def times(contact):
    return [float(code) for code in contact.GetAttribute("usdmotion:times").Get()]


def joint_place(stage, joint, code):
    """Return the matrix of a joint in the world, as UsdSkel has it."""
    skeleton = stage.GetPrimAtPath(WALKER)
    cache = UsdSkel.Cache()
    cache.Populate(UsdSkel.Root.Find(skeleton), Usd.TraverseInstanceProxies())
    query = cache.GetSkelQuery(UsdSkel.Skeleton(skeleton))
    place = UsdGeom.Xformable(skeleton).ComputeLocalToWorldTransform(code)
    matrices = query.ComputeJointSkelTransforms(Usd.TimeCode(code))
    return np.array(Gf.Matrix4d(matrices[list(query.GetJointOrder()).index(joint)]) * place)


def opacity(prim, code):
    primvar = UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance("displayOpacity")
    return primvar.Get(Usd.TimeCode(code))[0]


def color(stage, detection):
    trajectory = UsdGeom.Gprim(stage.GetPrimAtPath(f"{detection}/Guides/Trajectory"))
    return tuple(trajectory.GetDisplayColorAttr().Get()[0])


def drawn(stage):
    """Return the points and curves that are drawn, and ghosts that are meshes of their own."""
    return [
        prim
        for prim in stage.Traverse()
        if prim.IsA(UsdGeom.Gprim) and "/Guides/" in str(prim.GetPath())
    ]


@pytest.mark.parametrize("name", ["dice", "walk"])
def test_every_contact_is_drawn_with_all_there_is_to_see(name, request, contacts_of):
    contacts = contacts_of(request.getfixturevalue(name))
    assert len(contacts) >= 6
    for contact in contacts:
        kind = contact.GetAttribute("usdmotion:kind").Get()
        assert all(guide(contact, each) for each in ("Held", "Number", "Ghost"))
        assert bool(guide(contact, "Axis")) == (kind == "line")


def test_what_is_held_is_drawn_where_the_joint_is_however_it_is_carried(walk, contacts_of):
    for contact in contacts_of(walk):
        joint = contact.GetAttribute("usdmotion:joint").Get()
        _, start, end, _ = times(contact)
        place = joint_place(walk, joint, 0.5 * (start + end))[3, :3]
        marks = world_points(guide(contact, "Held"), 0.5 * (start + end))
        residual = contact.GetAttribute("usdmotion:residual").Get()
        assert np.linalg.norm(marks - place, axis=1).min() <= residual + NEAR


def test_the_trajectory_goes_where_the_joint_goes(walk, contacts_of):
    contact = contacts_of(walk)[0]
    detection, joint = contact.GetParent(), contact.GetAttribute("usdmotion:joint").Get()
    way = world_points(walk.GetPrimAtPath(f"{detection.GetPath()}/Guides/Trajectory"), 100.0)
    for end, code in ((0, walk.GetStartTimeCode()), (-1, walk.GetEndTimeCode())):
        place = joint_place(walk, joint, code)[3, :3]
        assert np.linalg.norm(way[end] - place) <= NEAR
    places = np.array([joint_place(walk, joint, code)[3, :3] for code in range(12, 301, 24)])
    shares = np.linspace(0.0, 1.0, 50)[:, None, None]
    drawn_way = ((1.0 - shares) * way[:-1] + shares * way[1:]).reshape(-1, 3)
    for place in places:
        assert np.linalg.norm(drawn_way - place, axis=1).min() < 0.5


def test_the_ghost_of_a_joint_is_what_follows_it_in_its_pose(walk, contacts_of):
    mesh = walk.GetPrimAtPath("/World/Walker/Guide")
    rest = np.array(UsdGeom.Mesh(mesh).GetPointsAttr().Get())
    follows = np.array(UsdSkel.BindingAPI(mesh).GetJointIndicesAttr().Get())
    skeleton = UsdSkel.Skeleton(walk.GetPrimAtPath(WALKER))
    joints = list(skeleton.GetJointsAttr().Get())
    for contact in contacts_of(walk):
        joint = contact.GetAttribute("usdmotion:joint").Get()
        _, start, end, _ = times(contact)
        middle = 0.5 * (start + end)
        index = joints.index(joint)
        bind = np.array(skeleton.GetBindTransformsAttr().Get()[index])
        own = rest[follows == index]
        matrix = np.linalg.inv(bind) @ joint_place(walk, joint, middle)
        skinned = own @ matrix[:3, :3] + matrix[3, :3]
        ghost = world_points(guide(contact, "Ghost"), middle)
        assert ghost.shape == skinned.shape
        residual = contact.GetAttribute("usdmotion:residual").Get()
        assert np.linalg.norm(ghost - skinned, axis=1).max() <= 4.0 * residual + NEAR


def test_the_ghost_of_a_prop_is_the_prop_in_its_pose(dice, contacts_of):
    for contact in contacts_of(dice):
        _, start, end, _ = times(contact)
        prop = contact.GetRelationship("usdmotion:object").GetTargets()[0]
        if contact.GetAttribute("usdmotion:kind").Get() == "space":
            body = dice.GetPrimAtPath(prop.AppendChild("Body"))
            there = world_points(body, 0.5 * (start + end))
            ghost = world_points(guide(contact, "Ghost/Body"), 0.5 * (start + end))
            np.testing.assert_allclose(ghost, there, atol=1e-4)
        # Its lowest corner is on the carpet, whatever it does.
        ghost = world_points(guide(contact, "Ghost/Body"))
        assert abs(ghost[:, 1].min()) < 1e-4
        assert len(ghost) == len(CORNERS)


def test_a_mesh_is_written_nowhere_again(dice, walk):
    text = dice.GetRootLayer().ExportToString()
    assert "faceVertexIndices" not in text
    text = walk.GetRootLayer().ExportToString()
    assert text.count("faceVertexIndices") == 2 + text.count('Mesh "Sole"')  # feet


@pytest.mark.parametrize("name", ["dice", "walk"])
def test_guides_are_for_people_and_bound_nothing(name, request):
    stage = request.getfixturevalue(name)
    assert drawn(stage)
    for prim in drawn(stage):
        assert UsdGeom.Imageable(prim).ComputePurpose() == UsdGeom.Tokens.guide
    shown = [UsdGeom.Tokens.default_, UsdGeom.Tokens.render, UsdGeom.Tokens.proxy]
    beneath = Usd.Stage.Open(
        stage.GetRootLayer().ComputeAbsolutePath(stage.GetRootLayer().subLayerPaths[0])
    )
    boxes = [
        UsdGeom.BBoxCache(Usd.TimeCode(60), shown).ComputeWorldBound(each.GetPseudoRoot())
        for each in (stage, beneath)
    ]
    assert boxes[0].ComputeAlignedRange() == boxes[1].ComputeAlignedRange()


@pytest.mark.parametrize("name", ["dice", "walk"])
def test_every_guide_says_how_large_it_is_and_what_it_looks_like(name, request):
    for prim in drawn(request.getfixturevalue(name)):
        boundable = UsdGeom.Boundable(prim)
        extent = np.array(boundable.GetExtentAttr().Get())
        computed = UsdGeom.Boundable.ComputeExtentFromPlugins(boundable, Usd.TimeCode(0))
        np.testing.assert_allclose(extent, np.array(computed), atol=1e-3)
        assert UsdGeom.Gprim(prim).GetDisplayColorAttr().HasAuthoredValue()
        assert 0.0 < opacity(prim, 0.0) <= 1.0
        if not prim.IsA(UsdGeom.Mesh):
            assert prim.GetAttribute("widths").Get()[0] > 0.0


@pytest.mark.parametrize("name", ["dice", "walk"])
def test_a_contact_stands_out_while_it_is_on(name, request, contacts_of):
    for contact in contacts_of(request.getfixturevalue(name)):
        before, start, end, after = times(contact)
        for part in ("Held", "Number", "Ghost"):
            assert opacity(guide(contact, part), start) == 1.0
            assert opacity(guide(contact, part), 0.5 * (start + end)) == 1.0
            assert opacity(guide(contact, part), end) == 1.0
            assert opacity(guide(contact, part), before - 2.0) < 0.5
            assert opacity(guide(contact, part), after + 2.0) < 0.5


@pytest.mark.parametrize("name", ["dice", "walk"])
def test_only_opacity_changes_over_time_and_what_undoes_the_way_of_a_carrier(name, request):
    layer = request.getfixturevalue(name).GetRootLayer()
    sampled = []
    layer.Traverse("/", lambda path: sampled.append(path) if path.IsPropertyPath() else None)
    sampled = [path for path in sampled if layer.GetNumTimeSamplesForPath(path)]
    changing = {str(path) for path in sampled if "/Guides" in str(path)}
    carried = {path for path in changing if path.endswith("/World.xformOp:transform:guide")}
    assert len(carried) == (name == "walk")
    assert {path.split(".")[-1] for path in changing - carried} == {"primvars:displayOpacity"}


@pytest.mark.parametrize("name", ["dice", "walk"])
def test_a_layer_with_guides_stays_small(name, request, contacts_of):
    stage = request.getfixturevalue(name)
    text = stage.GetRootLayer().ExportToString()
    assert len(text) < 200_000 * max(len(contacts_of(stage)), 15) / 30


def test_switching_a_contact_off_hides_its_guides(dice, over):
    path = f"{DETECTIONS}/First/Contact02"
    stage = Usd.Stage.Open(str(over(dice, lambda stage: stage.OverridePrim(path).SetActive(False))))
    shown = [str(prim.GetPath()) for prim in drawn(stage)]
    assert not any(path in each for each in shown)
    assert any("Contact03" in each for each in shown)


def test_each_object_has_a_colour_of_its_own(dice, walk, contacts_of):
    for stage in (dice, walk):
        detections = {str(contact.GetParent().GetPath()) for contact in contacts_of(stage)}
        colors = {color(stage, each) for each in detections}
        assert len(colors) == len(detections) == 2
        for contact in contacts_of(stage):
            own = color(stage, contact.GetParent().GetPath())
            for part in ("Held", "Number"):
                found = UsdGeom.Gprim(guide(contact, part)).GetDisplayColorAttr().Get()
                assert tuple(found[0]) == own


def test_an_object_keeps_its_colour_and_another_gets_another(dice_shot, detected):
    first = detected(dice_shot, prims=["/Dice/Second"])
    second = f"{DETECTIONS}/Second"
    np.testing.assert_allclose(color(first, second), COLORS[0], atol=1e-6)
    both = detected(file_of(first), prims=["/Dice/First"])
    assert color(both, second) == color(first, second)
    np.testing.assert_allclose(color(both, f"{DETECTIONS}/First"), COLORS[1], atol=1e-6)


def test_a_number_is_that_of_the_contact(dice, contacts_of):
    for contact in contacts_of(dice):
        counts = UsdGeom.BasisCurves(guide(contact, "Number")).GetCurveVertexCountsAttr().Get()
        assert len(counts) == len(str(int(contact.GetName().removeprefix("Contact"))))


def test_guides_are_read_as_nothing_that_is_asked_for(walk, walk_shot, detected):
    plain = detected(walk_shot, joints=("LeftFoot", "RightFoot"), minimum=0.1, guides=False)
    assert not drawn(plain)
    edits = [
        [
            (each.path, each.times)
            for scene in usd.read(file_of(stage), kinds=host().constraints).scenes
            for edit in scene.edits
            for each in edit.constraints
        ]
        for stage in (walk, plain)
    ]
    assert edits[0] == edits[1] != []


def test_what_is_drawn_again_is_what_the_contacts_say_now(dice, over, detected):
    path = f"{DETECTIONS}/First/Contact02"

    def edit(stage):
        contact = stage.GetPrimAtPath(path)
        contact.GetAttribute("usdmotion:kind").Set("point")
        contact.GetAttribute("usdmotion:location").Set(Gf.Vec3d(11.0, 22.0, 33.0))

    again = detected(over(dice, edit), prims=["/Dice/First"])
    contact = again.GetPrimAtPath(path)
    np.testing.assert_allclose(world_points(guide(contact, "Held")), [(11.0, 22.0, 33.0)], atol=0.1)
    assert not guide(contact, "Axis").IsActive()
    back = detected(
        over(
            again,
            lambda stage: stage.GetAttributeAtPath(f"{path}.usdmotion:kind").Set("line"),
            "again.usda",
        ),
        prims=["/Dice/First"],
    )
    assert guide(back.GetPrimAtPath(path), "Axis").IsActive()


def test_looking_again_draws_the_same(dice, detected):
    again = detected(file_of(dice), prims=["/Dice/First", "/Dice/Second"])
    before, after = ({str(prim.GetPath()): prim for prim in drawn(each)} for each in (dice, again))
    assert list(before) == list(after)
    for path, prim in before.items():
        np.testing.assert_allclose(world_points(prim), world_points(after[path]), atol=1e-3)


def test_numbers_are_upright_where_z_is_up(dice_shot, over, detected, contacts_of):
    def edit(stage):
        stage.SetMetadata("upAxis", "Z")

    stage = detected(over(Usd.Stage.Open(str(dice_shot)), edit), prims=["/Dice/First"])
    for contact in contacts_of(stage):
        points = world_points(guide(contact, "Number"))
        assert np.ptp(points @ (1.0, -1.0, 0.0)) < 0.1 < np.ptp(points[:, 2])
