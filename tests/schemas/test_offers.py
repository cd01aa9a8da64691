"""What the library offers whoever authors with it: words, choices, limits, and a fallback."""

import pytest
from pxr import Gf, Plug, Usd, UsdGeom

from usdmotion.usd import registration

registration.register()

DECLARED = Plug.Registry().GetPluginWithName("usdMotion").metadata["Types"]
SCHEMAS = [name.removeprefix("Usd") for name in DECLARED if name != "UsdMotionConstraint"]
PRIMS = [name for name in SCHEMAS if not name.endswith("API")]

ALLOWED = {
    ("MotionGoal", "mode"): "position offset",
    ("MotionPositionConstraint", "axes"): "x y z xy xz yz xyz",
    ("MotionCenterOfMassConstraint", "axes"): "x y z xy xz yz xyz",
    ("MotionDistanceConstraint", "bound"): "equal atLeast atMost",
    ("MotionRegionConstraint", "side"): "inside outside",
    ("MotionContactConstraint", "kind"): "space line point plane slide",
    ("MotionDetection", "kinds"): "space line point plane slide",
}


def definition(schema):
    registry = Usd.SchemaRegistry()
    find = registry.FindConcretePrimDefinition
    if schema.endswith("API"):
        find = registry.FindAppliedAPIPrimDefinition
    return find(schema)


@pytest.mark.parametrize("schema", SCHEMAS)
def test_everything_is_documented_in_whole_sentences_and_has_a_place_in_the_editor(schema):
    prim = definition(schema)
    docs = {name: prim.GetPropertyDocumentation(name) for name in prim.GetPropertyNames()}
    docs = {name: doc for name, doc in docs.items() if name.startswith("usdmotion:")}
    assert prim.GetDocumentation()
    # usdGenSchema cuts a long first sentence off with an ellipsis.
    assert all(doc.endswith(".") and not doc.endswith("..") for doc in docs.values()), docs
    assert all(prim.GetPropertyMetadata(name, "displayGroup") for name in docs)


@pytest.mark.parametrize("schema", PRIMS)
def test_a_usd_without_the_schema_shows_a_scope_or_an_xform(schema):
    fallback = Usd.SchemaRegistry().GetFallbackPrimTypes()[schema]
    assert list(fallback) == ["Xform" if schema == "MotionGoal" else "Scope"]


def test_a_stage_writes_the_fallback_types_into_its_root():
    stage = Usd.Stage.CreateInMemory()
    stage.DefinePrim("/Goal", "MotionGoal")
    stage.WriteFallbackPrimTypes()
    assert list(stage.GetMetadata("fallbackPrimTypes")["MotionGoal"]) == ["Xform"]


@pytest.mark.parametrize("schema, name", ALLOWED)
def test_tokens_are_offered_to_choose_from(schema, name):
    allowed = definition(schema).GetPropertyMetadata(f"usdmotion:{name}", "allowedTokens")
    assert list(allowed) == ALLOWED[schema, name].split()


def test_parts_are_offered_by_their_h_anim_names():
    allowed = definition("MotionSkeletonAPI").GetPropertyMetadata(
        "usdmotion:parts", "allowedTokens"
    )
    assert len(allowed) == len(set(allowed)) == 1 + 152  # the joints of all levels of articulation
    assert {"", "humanoid_root", "l_hip", "r_radiocarpal", "vl5", "skullbase"} <= set(allowed)
    lefts = {name[2:] for name in allowed if name.startswith("l_")}
    assert lefts == {name[2:] for name in allowed if name.startswith("r_")}


@pytest.mark.skipif(not hasattr(Usd, "AttributeLimits"), reason="this USD has no limits yet")
@pytest.mark.parametrize("schema", PRIMS)
def test_limits_are_limits_as_usd_understands_them(schema):
    stage = Usd.Stage.CreateInMemory()
    prim = stage.DefinePrim("/Prim", schema)
    for attribute in prim.GetAttributes():
        for key, found in (attribute.GetMetadata("limits") or {}).items():
            assert attribute.GetLimits(key).Validate(found).success, attribute


@pytest.mark.skipif(not hasattr(Usd, "AttributeLimits"), reason="this USD has no limits yet")
def test_activity_is_limited_to_the_unit_interval():
    stage = Usd.Stage.CreateInMemory()
    prim = stage.DefinePrim("/Goal", "MotionGoal")
    limits = prim.GetAttribute("usdmotion:activity").GetHardLimits()
    assert (limits.GetMinimum(), limits.GetMaximum()) == (0.0, 1.0)


def test_the_api_schemas_are_each_for_one_type_of_prim():
    only = Usd.SchemaRegistry.GetAPISchemaCanOnlyApplyToTypeNames
    assert list(only("MotionSkeletonAPI")) == ["Skeleton"]
    assert list(only("MotionResultAPI")) == ["SkelAnimation"]


def test_a_goal_can_be_transformed():
    stage = Usd.Stage.CreateInMemory()
    goal = UsdGeom.Xformable(stage.DefinePrim("/Goal", "MotionGoal"))
    goal.AddTranslateOp().Set((1, 2, 3))
    assert goal.ComputeLocalToWorldTransform(0).ExtractTranslation() == Gf.Vec3d(1, 2, 3)
