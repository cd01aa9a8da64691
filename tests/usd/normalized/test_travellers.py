"""What travels is written below its motion and read as it was, on a stage of any axis and unit."""

from dataclasses import fields

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom
from scipy.spatial.transform import Rotation

from usdmotion.constraints import (
    CenterOfMassConstraint,
    ContactConstraint,
    DistanceConstraint,
    Goal,
    OrientationConstraint,
    PositionConstraint,
    Region,
    RegionConstraint,
    Space,
    TrajectoryConstraint,
    built_in,
)
from usdmotion.travelling import Settings, Traveller
from usdmotion.usd.normalized.settings import author_settings, read_settings
from usdmotion.usd.normalized.travellers import author_travellers, read_travellers
from usdmotion.usd.stages import read_facts

CODES = np.array([1.0, 2.0, 3.0, 5.0])
WALK = "/Walk"


def turn(seed):
    return Rotation.random(random_state=seed).as_quat()


def a(kind, **fields):
    return kind(path="", skeleton=WALK, **{"joint": "r_radiocarpal", "point": np.ones(3)} | fields)


PLACED = Goal(path="A", translation=np.array([1.0, 2.0, 3.0]), rotation=turn(5))
MOVED = Goal(path="B", mode="offset", translation=np.arange(12.0).reshape(4, 3), times=(0.0, 0.5))
WITH_HEAD = Goal(path="C", translation=np.ones(3), rotation=turn(7), joint=(WALK, "skullbase"))

TRAVELLERS = (
    Traveller("Wrist", a(PositionConstraint, goals=(PLACED, MOVED), recruits=("l_elbow", "Tail"))),
    Traveller("Height", a(PositionConstraint, goals=(PLACED,), axes="y", activity=np.arange(4.0))),
    Traveller("Head", a(OrientationConstraint, goals=(WITH_HEAD,), rotation=turn(8))),
    Traveller("Clap", a(DistanceConstraint, other_joint="l_radiocarpal", distance=np.ones(4))),
    Traveller("Away", a(DistanceConstraint, other_skeleton="/B/S", other_joint="skullbase")),
    Traveller(
        "Balance", a(CenterOfMassConstraint, joint="", displacement=np.arange(12.0).reshape(4, 3))
    ),
    Traveller(
        "Way",
        a(TrajectoryConstraint, times=(0.0, 0.1), keys=(0.05,), points=np.ones((1, 3))),
    ),
    Traveller("On", a(RegionConstraint, region=Region(path="/World/Table"), side="inside")),
    Traveller("Feet/Left", a(ContactConstraint, location=np.ones(3), orientation=turn(9))),
    Traveller("Seen", a(TrajectoryConstraint, space=Space(joint=(WALK, "skullbase")))),
    Traveller("Held", a(ContactConstraint, location=np.ones(3)), {"": "/World/Box"}),
    Traveller("Follow", a(PositionConstraint, goals=(PLACED,)), {"A": "/World/Box"}),
)


def stage_of(up="Y", unit=1.0):
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, up)
    UsdGeom.SetStageMetersPerUnit(stage, unit)
    stage.SetTimeCodesPerSecond(24.0)
    stage.DefinePrim(WALK, "MotionNormalized")
    return stage


def read(stage):
    prim = stage.GetPrimAtPath(WALK)
    return read_travellers(prim, built_in(), CODES, read_facts(stage))


def assert_same(one, other):
    assert type(one) is type(other)
    for field in fields(one):
        found, wanted = getattr(one, field.name), getattr(other, field.name)
        if field.name == "goals":
            assert len(found) == len(wanted)
            for pair in zip(found, wanted, strict=True):
                assert_same(*pair)
        elif field.name in ("space", "region"):
            assert_same(found, wanted)
        elif field.name in ("rotation", "orientation", "axes") and np.ndim(wanted):  # either sign
            assert abs(np.dot(found, wanted)) == pytest.approx(1.0, abs=1e-6)
        elif isinstance(wanted, np.ndarray | float) or field.name in ("times", "keys"):
            np.testing.assert_allclose(found, wanted, atol=1e-6, err_msg=field.name)
        else:
            assert found == wanted, field.name


@pytest.mark.parametrize("traveller", TRAVELLERS, ids=lambda each: each.name)
@pytest.mark.parametrize(("up", "unit"), [("Y", 1.0), ("Z", 0.01)])
def test_what_is_authored_is_read(traveller, up, unit):
    stage = stage_of(up, unit)
    author_travellers(stage, WALK, [traveller], CODES)
    (found,), unknown = read(stage)
    assert not unknown
    assert (found.name, found.props) == (traveller.name, traveller.props)
    assert_same(found.constraint, traveller.constraint)


def test_the_up_axis_of_places_is_that_of_the_stage():
    stage = stage_of("Z")
    author_travellers(stage, WALK, [TRAVELLERS[1]], CODES)
    goal = UsdGeom.Xformable(stage.GetPrimAtPath("/Walk/Height/A"))
    assert goal.GetLocalTransformation().ExtractTranslation() == pytest.approx((1.0, -3.0, 2.0))
    assert stage.GetPrimAtPath("/Walk/Height").GetAttribute("usdmotion:axes").Get() == "z"


def test_an_offset_of_the_layer_changes_no_seconds():
    beneath = stage_of()
    author_travellers(beneath, WALK, TRAVELLERS[:1], CODES)
    stage = stage_of()
    root = stage.GetRootLayer()
    root.subLayerPaths.append(beneath.GetRootLayer().identifier)
    root.subLayerOffsets[0] = Sdf.LayerOffset(100.0)
    prim = stage.GetPrimAtPath(WALK)
    (found,), _ = read_travellers(prim, built_in(), CODES + 100.0, read_facts(stage))
    assert_same(found.constraint, TRAVELLERS[0].constraint)


def test_a_kind_that_nobody_knows_is_told_of():
    stage = stage_of()
    stage.DefinePrim("/Walk/Odd", "MotionSomebodysConstraint")
    assert read(stage) == ((), (("Odd", "MotionSomebodysConstraint"),))


def test_how_it_is_solved_travels_too():
    settings = Settings("ccd", (0.5, 1.0), 10.0, 4.0, 2, ("/Floor", "/Stairs"), {"rounds": 3})
    stage = stage_of()
    prim, facts = stage.GetPrimAtPath(WALK), read_facts(stage)
    author_settings(prim, settings, CODES, facts)
    assert read_settings(prim, CODES, facts) == settings
    assert read_settings(stage.DefinePrim("/E", "MotionEdit"), CODES, facts) == Settings()
