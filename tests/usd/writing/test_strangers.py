"""A USD that has never heard of usdmotion composes what was written, and shows the motion."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest
from pxr import Usd, UsdSkel

from usdmotion import demos, pipeline

LOOK = """
import json, sys
from pxr import Usd, UsdGeom, UsdSkel
stage = Usd.Stage.Open(sys.argv[1])
assert not Usd.SchemaRegistry().FindConcretePrimDefinition("MotionEdit")
prims = [prim for prim in stage.Traverse() if str(prim.GetTypeName()).startswith("Motion")]
skeleton = UsdSkel.Skeleton(stage.GetPrimAtPath("/Walker/Skeleton"))
query = UsdSkel.Cache().GetSkelQuery(skeleton)
codes = range(int(stage.GetStartTimeCode()), int(stage.GetEndTimeCode()) + 1)
print(json.dumps({
    "errors": [str(error) for error in stage.GetCompositionErrors()],
    "types": sorted({(prim.GetTypeName(), str(prim.GetPrimTypeInfo().GetSchemaTypeName()))
                     for prim in prims}),
    "animation": str(query.GetAnimQuery().GetPrim().GetPath()),
    "default": stage.GetDefaultPrim().GetName(),
    "purposes": sorted({UsdGeom.Imageable(prim).ComputePurpose() for prim in prims}),
    "places": [[list(each.ExtractTranslation()) for each in query.ComputeJointSkelTransforms(code)]
               for code in codes],
}))
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Return a folder with a demo, its result, and both composed."""
    folder = tmp_path_factory.mktemp("strange")
    shot = demos.build("reaching", folder)
    pipeline.solve(shot, folder / "edit.usda", compose=folder / "composed.usda")
    return folder


def look(path):
    """Return what a process with nothing but USD sees on a stage, and what USD complains about."""
    env = {name: value for name, value in os.environ.items() if name != "PXR_PLUGINPATH_NAME"}
    command = [sys.executable, "-c", LOOK, str(path)]
    said = subprocess.run(command, env=env, capture_output=True, text=True, check=True)
    return json.loads(said.stdout), said.stderr


def places(path):
    """Return what a process that knows usdmotion sees of the motion."""
    stage = Usd.Stage.Open(str(path))
    query = UsdSkel.Cache().GetSkelQuery(UsdSkel.Skeleton(stage.GetPrimAtPath("/Walker/Skeleton")))
    codes = range(1, int(stage.GetEndTimeCode()) + 1)
    return np.array([np.array(query.ComputeJointSkelTransforms(code))[:, 3, :3] for code in codes])


@pytest.mark.parametrize("name", ["composed.usda", "reaching.usda"])
def test_it_composes_without_a_word_and_shows_the_motion(folder, name):
    seen, complaints = look(folder / name)
    assert complaints == ""
    assert seen["errors"] == []
    assert seen["default"] == "Walker"
    np.testing.assert_array_equal(seen["places"], places(folder / name))


def test_the_motion_that_it_shows_is_the_result(folder):
    before, after = (look(folder / name)[0] for name in ("reaching.usda", "composed.usda"))
    assert before["animation"] == "/Walker/Animation"
    assert after["animation"] == "/Walker/Skeleton/Reaching_result"
    assert not np.allclose(before["places"], after["places"], atol=1.0)


@pytest.mark.parametrize("name", ["composed.usda", "reaching.usda"])
def test_our_prims_are_scopes_and_transforms_there(folder, name):
    seen, _ = look(folder / name)
    shown = dict(seen["types"])
    assert {"MotionEdit", "MotionGoal", "MotionPositionConstraint"} <= set(shown)
    assert shown.pop("MotionGoal") == "Xform"
    assert set(shown.values()) == {"Scope"}
    assert seen["purposes"] == ["guide"]
