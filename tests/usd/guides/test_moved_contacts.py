"""What is held is drawn where the prop is, also where the shot is put somewhere else, and later."""

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom

OFFSET, SCALE = 10.0, 2.0
PIPS = 0.15
"""What is marked are corners around a die and its pips, which stand out from it by this."""


@pytest.fixture(params=["later", "wrapped"])
def moved(request, dice, wrapped, tmp_path):
    """Return the dice under a layer offset, or referenced by what moves, and what is above them."""
    if request.param == "wrapped":
        return wrapped(dice, "Dice"), "/World"
    layer = Sdf.Layer.CreateNew(str(tmp_path / "later.usda"))
    layer.subLayerPaths.append(dice.GetRootLayer().realPath)
    layer.subLayerOffsets[0] = Sdf.LayerOffset(OFFSET, SCALE)
    return Usd.Stage.Open(layer), ""


def kind(contact):
    return contact.GetAttribute("usdmotion:kind").Get()


def world_points(prim, code):
    points = np.array(UsdGeom.PointBased(prim).GetPointsAttr().Get(code))
    matrix = np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(code))
    return points @ matrix[:3, :3] + matrix[3, :3]


def test_what_is_held_is_where_the_prop_is_while_it_is_held(moved, dice, contacts_of):
    stage, above = moved
    near = PIPS * (3.0 if above else 1.0)
    held = [each for each in contacts_of(dice) if kind(each) == "space"]
    assert len(held) >= 3
    for contact in held:
        own = [float(code) for code in contact.GetAttribute("usdmotion:times").Get()]
        first, start, end, _ = (OFFSET + SCALE * code for code in own)
        guides = stage.GetPrimAtPath(f"{above}{contact.GetPath()}/Guides")
        (prop,) = contact.GetRelationship("usdmotion:object").GetTargets()
        body = stage.GetPrimAtPath(f"{above}{prop}/Body")
        for code in (start, 0.5 * (start + end), end):
            there = world_points(body, code)
            marks = world_points(guides.GetChild("Held"), code)
            gaps = np.linalg.norm(marks[:, None] - there, axis=2)
            assert gaps.min(axis=0).max() < near > gaps.min(axis=1).max()
        opacity = UsdGeom.PrimvarsAPI(guides).GetPrimvar("displayOpacity")
        assert opacity.Get(first - SCALE)[0] < 0.5 < opacity.Get(start)[0] == 1.0
