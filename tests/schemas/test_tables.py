"""Every row of the tables of the scene description holds in the registry of USD."""

import pytest
from pxr import Gf, Plug, Sdf, Tf, Usd

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
        uniform double cleaning 0
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
        rel ground
        uniform token[] limbs []
        quatf[] limbFrames []
        double[] limbLengths []
        double[] limbTwists []
        uniform token[] segments []
        quatf[] segmentRotations []
        point3f[] spine []
        point3f rootPosition (0,0,0)
        quatf rootHeading (1,0,0,0)
        quatf rootOrientation (1,0,0,0)
        uniform token[] carriers []
        double[] carrierShares []
        uniform token[] extraJoints []
        quatf[] extraRotations []
        uniform token[] offsetJoints []
        vector3f[] offsets []
        uniform token solver ""
        uniform timecode[] range []
        uniform double cleaning 0
        uniform double smoothing 0
        uniform int passes 1
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
        uniform int[] priorities []
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


def test_every_schema_of_the_library_has_a_table():
    declared = Plug.Registry().GetPluginWithName("usdMotion").metadata["Types"]
    assert set(declared) - {"UsdMotionConstraint"} == {f"Usd{schema}" for schema in SCHEMAS}
