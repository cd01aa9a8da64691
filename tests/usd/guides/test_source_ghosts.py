"""The ghost of what an edit starts from is moved by UsdSkel, wherever skeleton and edit are."""

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdSkel

TIMES = (1.0, 2.0, 4.0, 5.0)
WALK = 'def SkelAnimation "Walk" {\n%s\n}'
INSTANCE = """
class "Assets" {
%s
}
def Xform "One" (
    instanceable = true
    prepend references = </Assets/Man>
    prepend apiSchemas = ["SkelBindingAPI"]
) {
    rel skel:animationSource = </Walk>
%s
}
"""


@pytest.fixture
def ghost_of(save, solved, guided):
    """Return what solves and draws a stage: what it was before, and the ghost of an edit."""
    kept = []

    def run(body, edit, header='metersPerUnit = 1\nupAxis = "Y"\ntimeCodesPerSecond = 24'):
        shot = save(body, header=header)
        before, after = Usd.Stage.Open(str(shot)), guided(solved(shot))
        kept.extend((before, after))
        return before, after.GetPrimAtPath(f"{edit}/Guides/Ghost")

    return run


def joints(stage, path, code):
    prim = stage.GetPrimAtPath(path)
    query = UsdSkel.Cache().GetSkelQuery(UsdSkel.Skeleton(prim))
    place = np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(code))
    return (np.array(query.ComputeJointSkelTransforms(code)) @ place)[:, 3, :3]


def ends(ghost, code):
    """Return where segments start and end in the world, as UsdSkel skins them."""
    mesh = UsdGeom.Mesh(ghost.GetChild("Segments"))
    skeleton = UsdSkel.Skeleton(ghost.GetChild("Skeleton"))
    cache = UsdSkel.Cache()
    cache.Populate(UsdSkel.Root.Find(mesh.GetPrim()), Usd.TraverseInstanceProxies())
    query, skinning = cache.GetSkelQuery(skeleton), cache.GetSkinningQuery(mesh.GetPrim())
    points = mesh.GetPointsAttr().Get()
    assert skinning.ComputeSkinnedPoints(query.ComputeSkinningTransforms(code), points, code)
    place = np.array(UsdGeom.Xformable(skeleton).ComputeLocalToWorldTransform(code))
    found = np.array(points) @ place[:3, :3] + place[3, :3]
    return found.reshape(-1, 6, 3)[:, [0, 5]].reshape(-1, 3)


def assert_shows(before, ghost, skeleton):
    for code in TIMES:
        places, found = joints(before, skeleton, code), ends(ghost, code)
        gaps = np.linalg.norm(places[:, None] - found, axis=2)
        assert gaps.min(axis=0).max() < 2e-3 and gaps.min(axis=1).max() < 2e-3


def held(text):
    return text.hold(text.goal())


def below(text, **options):
    return text.man(edit=text.edit(held(text)), **options)


def elsewhere(text, path):
    return text.edit(held(text), attributes=f"rel usdmotion:skeleton = <{path}>")


@pytest.mark.parametrize(
    "options",
    [
        {},
        {"xform": "MOVING"},
        {"xform": "SCALED"},
        {"bind": ""},
        {"rest": ""},
        {"bind": "", "rest": ""},
        {"animation": ("hip/head", "hip")},
    ],
    ids=["plain", "moving", "scaled", "no-bind", "no-rest", "neither", "few-joints"],
)
def test_below_its_skeleton(text, ghost_of, options):
    known = {"MOVING": text.MOVING, "SCALED": text.SCALED}
    options = {name: known.get(value, value) for name, value in options.items()}
    if "animation" in options:
        options["animation"] = text.poses(joints=options["animation"])
    before, ghost = ghost_of(below(text, **options), "/Man/Bones/Edit")
    assert_shows(before, ghost, "/Man/Bones")
    assert not ghost.IsA(UsdSkel.Root)
    binding = UsdSkel.BindingAPI(ghost.GetChild("Skeleton"))
    assert binding.GetInheritedAnimationSource().GetPath() == "/Man/Walk"


@pytest.mark.parametrize("xform", ["", "MOVING"])
def test_of_an_edit_that_stands_elsewhere(text, ghost_of, xform):
    body = text.man(edit="", xform=text.MOVING if xform else "") + elsewhere(text, "/Man/Bones")
    before, ghost = ghost_of(body, "/Edit")
    assert ghost.IsA(UsdSkel.Root)
    assert_shows(before, ghost, "/Man/Bones")
    sampled = UsdGeom.Xformable(ghost).TransformMightBeTimeVarying()
    assert sampled == bool(xform)


def test_of_a_skeleton_in_an_instance(text, ghost_of):
    asset = text.man(edit="", on_skeleton="")
    body = INSTANCE % (asset, text.MOVING) + elsewhere(text, "/One/Bones") + WALK % text.poses()
    before, ghost = ghost_of(body, "/Edit")
    assert_shows(before, ghost, "/One/Bones")


def test_of_a_motion_in_an_instance(text, ghost_of):
    asset = text.man(edit="", home="Assets/Man")
    named = "rel usdmotion:skeleton = </Other/Bones>\nrel usdmotion:source = </One/Walk>"
    other = text.man("Other", edit="", home="Other")
    body = (
        f'class "Assets" {{\n{asset}\n}}\n'
        'def Xform "One" (instanceable = true\nreferences = </Assets/Man>) {}\n'
        + other
        + text.edit(held(text), attributes=named)
    )
    before, ghost = ghost_of(body, "/Edit")
    assert_shows(before, ghost, "/One/Bones")


def test_of_scaled_joints(text, ghost_of):
    scales = {1: [(1, 1, 1)] * 4, 3: [(2, 2, 2), (0.5, 0.5, 0.5), (1, 1, 1), (3, 3, 3)]}
    moves = text.poses(scales=False) + f"\nhalf3[] scales.timeSamples = {text.sampled(scales)}"
    before, ghost = ghost_of(below(text, animation=moves), "/Man/Bones/Edit")
    assert_shows(before, ghost, "/Man/Bones")


def test_of_an_input_that_is_cleaned_first(text, ghost_of):
    edit = text.edit(held(text), attributes="uniform double usdmotion:cleaning = 2")
    before, ghost = ghost_of(text.man(edit=edit), "/Man/Bones/Edit")
    assert_shows(before, ghost, "/Man/Bones")


def test_there_is_none_of_what_is_not_solved(text, save, guided):
    stage = guided(save(below(text), header="metersPerUnit = 1\ntimeCodesPerSecond = 24"))
    assert stage.GetPrimAtPath("/Man/Bones/Edit/Guides")
    assert not stage.GetPrimAtPath("/Man/Bones/Edit/Guides/Ghost")
    assert stage.GetPrimAtPath("/Man/Bones/Edit/Hold/Guides/Before")
    assert not stage.GetPrimAtPath("/Man/Bones/Edit/Hold/Guides/After")
