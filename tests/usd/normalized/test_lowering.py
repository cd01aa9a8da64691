"""Who kneels does it on other bodies too: on the knee that was on the ground."""

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdSkel

from usdmotion import pipeline

LEG = 0.786
"""Length of a leg of the body that the motion is put on [m]."""


@pytest.fixture(scope="module")
def kneeling(mocap, tmp_path_factory):
    """Return a clip of somebody who kneels down and gets up, put on longer shanks."""
    folder = tmp_path_factory.mktemp("kneeling")
    clip, body, output = (folder / f"{name}.usda" for name in ("clip", "body", "output"))
    pipeline.import_motion(mocap / "other/mocapbank_crouch.bvh", clip)
    pipeline.import_motion(mocap / "cmu/mb/12_01.bvh", body)
    return pipeline.retarget(clip, body, output), output


def test_knees_are_held_where_they_are_on_the_ground_only(kneeling):
    told, _ = kneeling
    knees = [row for row in told.travellers if row.found and "Knee" in row.name]
    assert len(knees) == 1


def test_the_knee_is_on_the_ground_of_another_body(kneeling):
    _, output = kneeling
    stage = Usd.Stage.Open(str(output))
    (contact,) = (
        prim
        for prim in stage.Traverse()
        if prim.GetTypeName() == "MotionContactConstraint" and "Knee" in str(prim.GetPath())
    )
    _, first, last, _ = contact.GetAttribute("usdmotion:times").Get()
    assert last - first > 4.0 * stage.GetTimeCodesPerSecond()
    (prim,) = (each for each in stage.Traverse() if each.IsA(UsdSkel.Skeleton))
    cache = UsdSkel.Cache()
    cache.Populate(UsdSkel.Root.Find(prim), Usd.TraverseInstanceProxies())
    query = cache.GetSkelQuery(UsdSkel.Skeleton(prim))
    joint = list(query.GetJointOrder()).index(contact.GetAttribute("usdmotion:joint").Get())
    heights = [
        query.ComputeJointSkelTransforms(code)[joint].ExtractTranslation()[1]
        for code in np.linspace(first, last, 20)
    ]
    assert max(heights) * UsdGeom.GetStageMetersPerUnit(stage) < 0.08 * LEG
