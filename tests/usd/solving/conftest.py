"""What the tests of solved stages need: a shot in, and what UsdSkel shows of the answer."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom, UsdSkel

from usdmotion import pipeline
from usdmotion.report import Report


@dataclass(frozen=True, eq=False)
class Answer:
    """A stage before and after it was solved."""

    old: Usd.Stage
    new: Usd.Stage
    layer: Sdf.Layer
    """The layer that was written."""
    report: Report

    def matrices(self, stage, joint, codes, skeleton):
        """Return the matrices of a joint in the world at some time codes."""
        bones = UsdSkel.Skeleton(stage.GetPrimAtPath(skeleton))
        query = UsdSkel.Cache().GetSkelQuery(bones)
        index = list(query.GetJointOrder()).index(joint)
        found = []
        for code in codes:
            world = UsdGeom.XformCache(code).GetLocalToWorldTransform(bones.GetPrim())
            found.append(query.ComputeJointSkelTransforms(code)[index] * world)
        return np.array(found)

    def place(self, stage, joint, codes, skeleton="/Man/Bones"):
        """Return where a joint is in the world at some time codes, in stage units."""
        return self.matrices(stage, joint, codes, skeleton)[:, 3, :3]

    def turns(self, joint, codes, skeleton="/Man/Bones"):
        """Return the axes of a joint of the answer as rows, of length one."""
        axes = self.matrices(self.new, joint, codes, skeleton)[:, :3, :3]
        return axes / np.linalg.norm(axes, axis=2, keepdims=True)

    def both(self, joint, codes, skeleton="/Man/Bones"):
        """Return where a joint was, and where it is."""
        return tuple(self.place(stage, joint, codes, skeleton) for stage in (self.old, self.new))

    def result(self, name="rotations", path="/Man/Bones/Edit_result"):
        """Return an attribute of a result."""
        return self.new.GetPrimAtPath(path).GetAttribute(name)


@pytest.fixture
def solve(tmp_path):
    """Return a function that solves a stage and composes the answer over it."""

    def run(shot: Path, suffix=".usda", **options):
        folder = tmp_path / "answers"
        folder.mkdir(exist_ok=True)
        layer, composed = folder / f"edit{suffix}", folder / "composed.usda"
        report = pipeline.solve(shot, layer, compose=composed, **options)
        stages = (Usd.Stage.Open(str(path)) for path in (shot, composed))
        return Answer(*stages, Sdf.Layer.FindOrOpen(str(layer)), report)

    return run
