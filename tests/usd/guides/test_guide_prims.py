"""Guides are prims that any viewer can show, and that nothing takes for anything else."""

from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdSkel

from usdmotion import pipeline, usd
from usdmotion.plugins import host


def drawn(stage):
    for prim in stage.Traverse():
        if "/Guides/" in str(prim.GetPath()) and prim.IsA(UsdGeom.Gprim):
            yield prim


@pytest.mark.parametrize("name", ["reaching", "carried"])
def test_each_says_how_large_it_is_and_what_it_looks_like_at_all_times(name, request):
    guides = list(drawn(request.getfixturevalue(name)))
    kinds = {prim.GetTypeName() for prim in guides}
    assert kinds == {"Points", "BasisCurves", "Mesh"}
    for prim in guides:
        assert UsdGeom.Imageable(prim).ComputePurpose() == UsdGeom.Tokens.guide
        primvars = UsdGeom.PrimvarsAPI(prim)
        color, opacity = (
            primvars.FindPrimvarWithInheritance(f"display{each}") for each in ("Color", "Opacity")
        )
        assert color.HasAuthoredValue() and 0.0 < opacity.Get(40.0)[0] <= 1.0
        if prim.GetTypeName() != "Mesh":
            assert 0.1 < prim.GetAttribute("widths").Get()[0] < 6.0
        if prim.GetName() != "Segments":  # what is skinned is elsewhere than its own points
            boundable = UsdGeom.Boundable(prim)
            for code in (1.0, 40.0, 40.5, 100.0):
                extent = np.array(boundable.GetExtentAttr().Get(code))
                own = UsdGeom.Boundable.ComputeExtentFromPlugins(boundable, Usd.TimeCode(code))
                np.testing.assert_allclose(extent, np.array(own), atol=0.02)


def test_guides_bound_nothing(reaching, reached):
    shown = [UsdGeom.Tokens.default_, UsdGeom.Tokens.render, UsdGeom.Tokens.proxy]
    boxes = [
        UsdGeom.BBoxCache(73.0, shown).ComputeWorldBound(stage.GetPseudoRoot())
        for stage in (reaching, Usd.Stage.Open(str(reached)))
    ]
    assert boxes[0].ComputeAlignedRange() == boxes[1].ComputeAlignedRange()


def test_nothing_is_read_from_guides(reaching, reached):
    over = Path(reaching.GetRootLayer().realPath)
    inspections = [usd.inspect(path, kinds=host().constraints) for path in (over, reached)]
    for part in ("skeletons", "clips", "edits", "constraints", "faults", "notes"):
        assert repr(getattr(inspections[0], part)) == repr(getattr(inspections[1], part))
    outcomes = [
        outcome
        for path in (over, reached)
        for outcome in usd.read_outcomes(path, kinds=host().constraints)
    ]
    records = [outcome.records[0] for outcome in outcomes]
    assert records[0].input_hash == records[0].hash_now == records[1].hash_now


def test_contacts_are_looked_for_on_the_skeleton_and_not_on_its_ghost(reaching, tmp_path):
    over = Path(reaching.GetRootLayer().realPath)
    report = pipeline.detect(over, tmp_path / "contacts.usda", minimum=0.1)
    assert report.objects and not any("Guides" in each.path for each in report.objects)


def test_what_is_solved_again_over_guides_is_the_same(reaching, reached, tmp_path):
    over = Path(reaching.GetRootLayer().realPath)
    layers = []
    for path in (over, reached):
        layer = tmp_path / f"{path.stem}.again.usda"
        pipeline.solve(path, layer)
        layers.append(Usd.Stage.Open(str(layer)))
    results = (UsdSkel.Animation.Get(each, "/Walker/Skeleton/Reaching_result") for each in layers)
    one, other = (result.GetRotationsAttr() for result in results)
    assert one.GetTimeSamples() == other.GetTimeSamples() != []
    assert all(one.Get(code) == other.Get(code) for code in one.GetTimeSamples())
