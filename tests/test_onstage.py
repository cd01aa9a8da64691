"""Solving and detecting on a stage that is open: the same as on a file, in the edit target."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdSkel

from usdmotion import onstage, pipeline
from usdmotion.asking import Asked
from usdmotion.constraints import built_in
from usdmotion.errors import SceneError
from usdmotion.usd.outcomes import outcomes_of

Shot = Callable[..., Path]
SKELETON = "/Arm/Skeleton"
EDIT = f"{SKELETON}/Edit"
RESULT = f"{EDIT}_result"


@pytest.fixture
def stage(arm_shot: Shot) -> Usd.Stage:
    """Return the open stage of an arm, whose edit target is its session layer."""
    opened = Usd.Stage.Open(str(arm_shot()))
    opened.SetEditTarget(opened.GetSessionLayer())
    return opened


def over(shot: Path, rate: float, offset: float, scale: float) -> Usd.Stage:
    """Return a stage whose edit target, over a shot, is a layer with times of its own."""
    layer = Sdf.Layer.CreateAnonymous("own.usda")
    layer.timeCodesPerSecond = rate
    root = Sdf.Layer.CreateAnonymous("all.usda")
    root.TransferContent(Sdf.Layer.FindOrOpen(str(shot)))
    del root.rootPrims["Arm"]
    root.subLayerPaths[:] = [layer.identifier, str(shot)]
    root.subLayerOffsets[0] = Sdf.LayerOffset(offset, scale)
    stage = Usd.Stage.Open(root)
    stage.SetEditTarget(layer)
    return stage


def goal(stage: Usd.Stage) -> Usd.Prim:
    return stage.GetPrimAtPath(f"{EDIT}/Wrist").GetChildren()[0]


def said(stage: Usd.Stage) -> list[str]:
    return [layer.ExportToString() for layer in stage.GetLayerStack()]


def arrays(stage: Usd.Stage, path: str = RESULT) -> dict[str, list[tuple[float, bytes]]]:
    """Return what a SkelAnimation holds, byte by byte."""
    prim = stage.GetPrimAtPath(path)
    found = {}
    for name in ("translations", "rotations", "scales"):
        attribute = prim.GetAttribute(name)
        found[name] = [
            (t, np.array(attribute.Get(t)).tobytes()) for t in attribute.GetTimeSamples()
        ]
    return found


def bound(stage: Usd.Stage, path: str = SKELETON) -> str:
    return str(
        UsdSkel.BindingAPI(stage.GetPrimAtPath(path)).GetInheritedAnimationSource().GetPath()
    )


def records(stage: Usd.Stage) -> dict[str, bool]:
    """Return the edits that have results, and whether these are stale."""
    found = outcomes_of(stage, Path("stage"), built_in())
    return {record.edit: record.stale for outcome in found for record in outcome.records}


def saved(stage: Usd.Stage, output: Path) -> Usd.Stage:
    """Return what the command line makes of what a stage shows."""
    stage.Flatten().Export(str(output))
    composed = output.with_name("composed.usda")
    pipeline.solve(output, output.with_name("solved.usda"), compose=composed)
    return Usd.Stage.Open(str(composed))


def test_what_is_bound_is_what_the_command_line_writes_of_the_stage(
    stage: Usd.Stage, tmp_path: Path
) -> None:
    goal(stage).GetAttribute("xformOp:translate").Set((0.0, 0.02, 0.01))
    by_file = saved(stage, tmp_path / "saved.usda")
    report = onstage.solve(stage)
    assert report.met and bound(stage) == RESULT
    assert arrays(stage) == arrays(by_file)
    hashes = [
        each.GetPrimAtPath(RESULT).GetAttribute("usdmotion:result:inputHash").Get()
        for each in (stage, by_file)
    ]
    assert hashes[0] == hashes[1]
    assert records(stage) == {EDIT: False}


def test_clearing_the_layer_gives_the_stage_back(stage: Usd.Stage) -> None:
    before, source = said(stage), bound(stage)
    onstage.solve(stage)
    stage.GetSessionLayer().Clear()
    assert said(stage) == before
    assert bound(stage) == source


def test_solving_again_starts_from_the_source(stage: Usd.Stage) -> None:
    onstage.solve(stage)
    first = arrays(stage)
    onstage.solve(stage)
    assert arrays(stage) == first
    assert records(stage) == {EDIT: False}


def test_a_result_is_stale_when_what_it_was_made_from_changes(stage: Usd.Stage) -> None:
    onstage.solve(stage)
    goal(stage).GetAttribute("xformOp:translate").Set((0.0, 0.03, 0.0))
    assert records(stage) == {EDIT: True}


@pytest.mark.parametrize(
    ("rate", "offset", "scale"), [(24.0, 10.0, 1.0), (24.0, -3.0, 2.0), (48.0, 0.5, 1.0)]
)
def test_a_layer_with_times_of_its_own_shows_the_same_motion(
    arm_shot: Shot, stage: Usd.Stage, rate: float, offset: float, scale: float
) -> None:
    onstage.solve(stage)
    other = over(arm_shot(name="other.usda"), rate, offset, scale)
    onstage.solve(other)
    assert other.GetEditTarget().GetLayer().GetPrimAtPath(RESULT)
    for name, samples in arrays(stage).items():
        moved = arrays(other)[name]
        np.testing.assert_allclose([t for t, _ in moved], [t for t, _ in samples], atol=1e-6)
        assert [values for _, values in moved] == [values for _, values in samples]
    assert records(other) == {EDIT: False}


def test_a_binding_in_a_stronger_layer_is_told_and_nothing_is_written(stage: Usd.Stage) -> None:
    binding = UsdSkel.BindingAPI(stage.GetPrimAtPath(SKELETON)).GetAnimationSourceRel()
    binding.SetTargets(binding.GetTargets())
    stage.SetEditTarget(stage.GetRootLayer())
    before = said(stage)
    with pytest.raises(SceneError, match="is authored in the session layer, which is stronger"):
        onstage.solve(stage)
    assert said(stage) == before


@pytest.mark.parametrize("verb", [onstage.solve, onstage.detect])
def test_an_edit_target_that_cannot_be_written_to_is_refused(
    stage: Usd.Stage, verb: Callable[[Usd.Stage], object]
) -> None:
    variants = stage.GetPrimAtPath("/Arm").GetVariantSets().AddVariantSet("take")
    variants.AddVariant("one")
    variants.SetVariantSelection("one")
    before = said(stage)
    with variants.GetVariantEditContext(), pytest.raises(SceneError, match="inside a variant"):
        verb(stage)
    layer = Sdf.Layer.CreateAnonymous("muted.usda")
    stage.GetRootLayer().subLayerPaths.append(layer.identifier)
    stage.SetEditTarget(layer)
    stage.MuteLayer(layer.identifier)
    with pytest.raises(SceneError, match="is muted"):
        verb(stage)
    stage.UnmuteLayer(layer.identifier)
    layer.SetPermissionToEdit(False)
    with pytest.raises(SceneError, match="must not be edited"):
        verb(stage)
    assert said(stage)[0] == before[0]


def test_what_cannot_be_solved_is_told_as_the_command_line_does(
    stage: Usd.Stage, arm_shot: Shot, tmp_path: Path
) -> None:
    stage.GetPrimAtPath(f"{EDIT}/Wrist").GetAttribute("usdmotion:joint").Set("nobody")
    before = said(stage)
    with pytest.raises(SceneError) as told:
        onstage.solve(stage)
    assert said(stage) == before
    stage.Flatten().Export(str(tmp_path / "broken.usda"))
    with pytest.raises(SceneError) as by_file:
        pipeline.solve(tmp_path / "broken.usda", tmp_path / "out.usda")
    sentences = [str(each.value).split(": ", 1)[1] for each in (told, by_file)]
    assert sentences[0] == sentences[1]
    assert str(told.value).startswith("arm.usda: ")


def test_an_error_on_the_way_leaves_the_layer_as_it_was(
    stage: Usd.Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    from usdmotion.usd.drafts import draft

    onstage.solve(stage)
    before = said(stage)
    monkeypatch.setattr(draft, "joined", lambda *_: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        onstage.solve(stage)
    assert said(stage) == before


def test_results_of_several_solves_are_kept_apart_in_one_layer(
    arm_shot: Shot, stage: Usd.Stage
) -> None:
    other = arm_shot(0.02, name="other.usda")
    root = stage.GetRootLayer()
    prim = Sdf.CreatePrimInLayer(root, "/Other")
    prim.referenceList.Prepend(Sdf.Reference(str(other), "/Arm"))
    second = EDIT.replace("/Arm", "/Other")
    onstage.solve(stage, [EDIT])
    onstage.solve(stage, [second])
    assert records(stage) == {EDIT: False, second: False}
    onstage.solve(stage, [EDIT])
    assert records(stage) == {EDIT: False, second: False}
    onstage.solve(stage)
    assert records(stage) == {EDIT: False, second: False}
    assert "earlier" not in stage.GetSessionLayer().customLayerData["usdmotion"]


def test_contacts_are_those_that_the_command_line_finds(stage: Usd.Stage, tmp_path: Path) -> None:
    asked = Asked(joints=("base",))
    stage.Flatten().Export(str(tmp_path / "saved.usda"))
    by_file = pipeline.detect(tmp_path / "saved.usda", tmp_path / "out.usda", joints=["base"])
    before = said(stage)[1:]
    report = onstage.detect(stage, asked)
    assert report == by_file
    layers = Sdf.Layer.FindOrOpen(str(tmp_path / "out.usda")), stage.GetSessionLayer()
    trees = [layer.GetPrimAtPath("/Arm").GetAsText() for layer in layers]
    assert trees[0] == trees[1]
    assert said(stage)[1:] == before


def test_contacts_stay_whose_they_are_in_a_layer_with_times_of_its_own(
    stage: Usd.Stage, arm_shot: Shot
) -> None:
    other = over(arm_shot(name="other.usda"), 30.0, 5.0, 2.0)
    asked = Asked(joints=("base",))
    first, moved = onstage.detect(stage, asked), onstage.detect(other, asked)
    assert moved.objects == first.objects
    path = first.objects[0].contacts[0].path
    times = [
        [float(t) for t in each.GetPrimAtPath(path).GetAttribute("usdmotion:times").Get()]
        for each in (stage, other)
    ]
    np.testing.assert_allclose(times[1], times[0], atol=1e-9)
    again = onstage.detect(other, asked)
    assert [each.state for each in again.objects[0].contacts] == ["detected"]
    assert again.objects[0].pattern == pytest.approx(first.objects[0].pattern)


def test_an_inspection_tells_what_is_open(stage: Usd.Stage, tmp_path: Path) -> None:
    stage.GetPrimAtPath(f"{EDIT}/Wrist").GetAttribute("usdmotion:joint").Set("nobody")
    found = onstage.inspect(stage)
    stage.Flatten().Export(str(tmp_path / "saved.usda"))
    assert found.faults == pipeline.inspect(tmp_path / "saved.usda").faults != ()
    assert found.file == "arm.usda"


def test_guides_move_alike_in_a_layer_with_times_of_its_own(
    arm_shot: Shot, stage: Usd.Stage
) -> None:
    other = over(arm_shot(name="other.usda"), 48.0, 3.0, 2.0)
    for each in (stage, other):
        onstage.solve(each)
        onstage.guides(each)
    guides = [
        {
            attribute.GetPath(): attribute
            for prim in Usd.PrimRange(each.GetPrimAtPath(EDIT))
            for attribute in prim.GetAuthoredAttributes()
            if "Guides" in str(prim.GetPath())
        }
        for each in (stage, other)
    ]
    assert guides[0].keys() == guides[1].keys()
    assert any(attribute.GetNumTimeSamples() > 1 for attribute in guides[1].values())
    for path, attribute in guides[1].items():
        codes = attribute.GetTimeSamples()
        np.testing.assert_allclose(codes, guides[0][path].GetTimeSamples(), atol=1e-6)
        for code in (*codes, Usd.TimeCode.Default()):
            assert attribute.Get(code) == guides[0][path].Get(code), path
