"""Every row of the tables of the scene description holds in the registry of USD."""

import pytest
from pxr import Gf, Sdf, Tf, Usd, UsdGeom

from usdmotion.usd import registration

registration.register()

EASED = """
double activity 1
uniform timecode[] times []
"""

CONSTRAINT = f"""
uniform int priority 1
double weight 1
{EASED}
uniform token joint ""
uniform point3d point (0,0,0)
uniform token[] recruits []
uniform double tolerance 0
"""

SCHEMAS = {
    "MotionEdit": (
        "UsdGeomImageable",
        """
        rel skeleton
        rel source
        rel ground
        uniform token solver ""
        uniform timecode[] range []
        uniform double sampleRate 0
        uniform double smoothing 0
        uniform int passes 1
        """,
    ),
    "MotionGoal": (
        "UsdGeomXformable",
        f"""
        uniform token mode "position"
        {EASED}
        rel space
        uniform token spaceJoint ""
        """,
    ),
    "MotionPositionConstraint": (
        "UsdMotionConstraint",
        f"""
        {CONSTRAINT}
        uniform token axes "xyz"
        """,
    ),
    "MotionOrientationConstraint": (
        "UsdMotionConstraint",
        f"""
        {CONSTRAINT}
        uniform quatf rotation (1,0,0,0)
        uniform vector3f freeAxis (0,0,0)
        """,
    ),
    "MotionAimConstraint": (
        "UsdMotionConstraint",
        f"""
        {CONSTRAINT}
        uniform vector3f aim (0,0,1)
        """,
    ),
    "MotionDistanceConstraint": (
        "UsdMotionConstraint",
        f"""
        {CONSTRAINT}
        rel otherSkeleton
        uniform token otherJoint ""
        uniform point3d otherPoint (0,0,0)
        double distance 0
        uniform token bound "equal"
        """,
    ),
    "MotionRegionConstraint": (
        "UsdMotionConstraint",
        f"""
        {CONSTRAINT}
        rel region
        uniform token side "outside"
        """,
    ),
    "MotionCenterOfMassConstraint": (
        "UsdMotionConstraint",
        f"""
        {CONSTRAINT}
        uniform token[] supports []
        uniform point3d[] supportPoints []
        vector3d displacement (0,0,0)
        uniform token axes "xyz"
        """,
    ),
    "MotionTrajectoryConstraint": (
        "UsdMotionConstraint",
        f"""
        {CONSTRAINT}
        uniform timecode[] keys []
        uniform timecode[] releases []
        uniform point3d[] points []
        uniform float[] tension []
        uniform float[] continuity []
        uniform float[] bias []
        rel space
        uniform token spaceJoint ""
        """,
    ),
    "MotionContactConstraint": (
        "UsdMotionConstraint",
        f"""
        {CONSTRAINT}
        uniform token kind "space"
        uniform point3d location (0,0,0)
        uniform quatd orientation (1,0,0,0)
        uniform vector3f axis (0,0,1)
        rel space
        rel object
        uniform bool template false
        uniform double residual 0
        """,
    ),
    "MotionDetection": (
        "UsdGeomImageable",
        """
        rel skeleton
        uniform token joint ""
        rel object
        uniform token detector ""
        uniform token[] kinds ["space"]
        uniform double step 0
        double sigmaMax 0
        double epsilonMax 0
        uniform double parallelAngle 0
        uniform double mergeDistance 0
        uniform double gap 0
        uniform double gapDistance 0
        uniform double minimum 0
        """,
    ),
    "MotionNormalized": (
        "UsdTyped",
        """
        rel source
        uniform token[] limbs []
        quatf[] limbFrames []
        double[] limbLengths []
        uniform token[] segments []
        quatf[] segmentRotations []
        point3f[] spine []
        point3f rootPosition (0,0,0)
        quatf rootHeading (1,0,0,0)
        quatf rootOrientation (1,0,0,0)
        uniform token[] extraJoints []
        quatf[] extraRotations []
        """,
    ),
    "MotionSkeletonAPI": (
        "UsdAPISchemaBase",
        """
        uniform token[] parts []
        uniform float[] masses []
        uniform point3f[] massCenters []
        uniform float3[] limitsMin []
        uniform float3[] limitsMax []
        uniform float[] stiffness []
        """,
    ),
    "MotionResultAPI": (
        "UsdAPISchemaBase",
        """
        rel result:edit
        rel result:source
        uniform token result:solver ""
        uniform string result:version ""
        uniform string result:inputHash ""
        """,
    ),
}

ROWS = [
    (schema, *row.split())
    for schema, (_, table) in SCHEMAS.items()
    for row in table.splitlines()
    if row.strip()
]

ALLOWED = {
    ("MotionGoal", "mode"): "position offset",
    ("MotionPositionConstraint", "axes"): "x y z xy xz yz xyz",
    ("MotionCenterOfMassConstraint", "axes"): "x y z xy xz yz xyz",
    ("MotionDistanceConstraint", "bound"): "equal atLeast atMost",
    ("MotionRegionConstraint", "side"): "inside outside",
    ("MotionContactConstraint", "kind"): "space line point",
    ("MotionDetection", "kinds"): "space line point",
}


def definition(schema):
    registry = Usd.SchemaRegistry()
    find = registry.FindConcretePrimDefinition
    if schema.endswith("API"):
        find = registry.FindAppliedAPIPrimDefinition
    return find(schema)


def written(value):
    """Return a value as the tables write it."""
    if isinstance(value, (Gf.Quatf, Gf.Quatd)):
        value = (value.real, *value.imaginary)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, (int, float)):
        return f"{value:g}"
    items = ",".join(written(item) for item in value)
    is_vector = isinstance(value, (tuple, Gf.Vec3f, Gf.Vec3d))
    return f"({items})" if is_vector else f"[{items}]"


@pytest.mark.parametrize("row", ROWS, ids=" ".join)
def test_every_property_has_the_type_the_default_and_the_variability_of_its_row(row):
    schema, *details = row
    is_uniform = details[0] == "uniform"
    kind, name, *default = details[is_uniform:]
    prim = definition(schema)
    name = f"usdmotion:{name}"
    assert name in prim.GetPropertyNames()
    if kind == "rel":
        assert prim.GetSpecType(name) == Sdf.SpecTypeRelationship
        return
    meta = {
        field: prim.GetPropertyMetadata(name, field)
        for field in ("typeName", "variability", "default")
    }
    assert meta["typeName"] == kind
    assert (meta["variability"] == Sdf.VariabilityUniform) == is_uniform
    assert [written(meta["default"])] == default


@pytest.mark.parametrize("schema", SCHEMAS)
def test_a_schema_has_the_properties_of_its_table_and_no_others(schema):
    ours = {name for name in definition(schema).GetPropertyNames() if name.startswith("usdmotion:")}
    rows = {row for row in ROWS if row[0] == schema}
    assert ours == {f"usdmotion:{row[2 + (row[1] == 'uniform')]}" for row in rows}


@pytest.mark.parametrize("schema", SCHEMAS)
def test_a_schema_is_a_tftype_with_our_prefix_and_the_base_it_should_have(schema):
    found = Tf.Type.FindByName(f"Usd{schema}")
    assert Usd.SchemaRegistry.GetSchemaTypeName(found) == schema
    assert [base.typeName for base in found.baseTypes] == [SCHEMAS[schema][0]]


def test_the_constraint_that_all_kinds_are_is_abstract():
    constraint = Tf.Type.FindByName("UsdMotionConstraint")
    assert Usd.SchemaRegistry.IsAbstract(constraint)
    assert [base.typeName for base in constraint.baseTypes] == ["UsdGeomImageable"]


@pytest.mark.parametrize("schema", SCHEMAS)
def test_everything_is_documented_in_whole_sentences_and_has_a_place_in_the_editor(schema):
    prim = definition(schema)
    docs = {name: prim.GetPropertyDocumentation(name) for name in prim.GetPropertyNames()}
    docs = {name: doc for name, doc in docs.items() if name.startswith("usdmotion:")}
    assert prim.GetDocumentation()
    # usdGenSchema cuts a long first sentence off with an ellipsis.
    assert all(doc.endswith(".") and not doc.endswith("..") for doc in docs.values()), docs
    assert all(prim.GetPropertyMetadata(name, "displayGroup") for name in docs)


@pytest.mark.parametrize("schema", [name for name in SCHEMAS if not name.endswith("API")])
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
@pytest.mark.parametrize("schema", [name for name in SCHEMAS if not name.endswith("API")])
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
