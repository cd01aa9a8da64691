"""An edit that starts from a cleaned input: what it asks is met there, and the source stays."""

import json
import sys

import numpy as np
import pytest
from pxr import Sdf, Usd, Vt

from usdmotion import Session, answering, cli, demos, pipeline
from usdmotion.kernels import from_vector, multiply
from usdmotion.reporting import report

EDIT = "/Walker/Skeleton/Reaching"
ARM = "LeftForeArm"


@pytest.fixture
def noisy(tmp_path):
    """Return a stage with a walk with noise of 0.3 degrees and a spike, which is to be cleaned."""
    shot = demos.build("reaching", tmp_path)
    stage = Usd.Stage.Open(str(shot))
    rotations = stage.GetPrimAtPath("/Walker/Animation").GetAttribute("rotations")
    joints = [
        str(each) for each in stage.GetPrimAtPath("/Walker/Animation").GetAttribute("joints").Get()
    ]
    arm = next(index for index, each in enumerate(joints) if each.endswith(ARM))
    random = np.random.default_rng(0)
    for code in rotations.GetTimeSamples():
        errors = random.normal(0.0, np.radians(0.3), (len(joints), 3))
        if code == 20.0:
            errors[arm] = (1.5, 0.0, 0.0)
        turned = multiply(np.asarray(rotations.Get(code), dtype=np.float64), from_vector(errors))
        rotations.Set(Vt.QuatfArray.FromNumpy(turned.astype(np.float32)), code)
    stage.GetPrimAtPath(EDIT).GetAttribute("usdmotion:cleaning").Set(6.0)
    stage.GetRootLayer().Save()
    return shot


def rotations_of(path, animation):
    stage = Usd.Stage.Open(str(path))
    prim = stage.GetPrimAtPath(animation)
    attribute = prim.GetAttribute("rotations")
    arm = next(
        index
        for index, each in enumerate(prim.GetAttribute("joints").Get())
        if str(each).endswith(ARM)
    )
    return np.array([np.asarray(attribute.Get(code))[arm] for code in attribute.GetTimeSamples()])


def largest_step(turns):
    dots = np.abs(np.sum(turns[1:] * turns[:-1], axis=1))
    return np.degrees(2.0 * np.arccos(np.minimum(dots, 1.0))).max()


def test_what_is_asked_for_is_met_on_the_cleaned_input_and_told(noisy, tmp_path):
    before = noisy.read_bytes()
    output = tmp_path / "edit.usda"
    report = pipeline.solve(noisy, output)
    assert noisy.read_bytes() == before
    (edit,) = report.edits
    assert report.met
    assert [(each.joint.rsplit("/", 1)[-1], each.samples) for each in edit.cleaning.replaced] == [
        (ARM, 1)
    ]
    assert edit.cleaning.cutoff == 6.0 and edit.cleaning.low_passed
    assert len(edit.cleaning.held) == 4
    for held in edit.cleaning.held:
        assert held.slide_after < 0.5 * held.slide_before
    assert (
        sum(f"<{EDIT}> starts from a cleaned input: 1 sample" in each for each in report.notes) == 1
    )
    assert json.loads(report.to_json())["edits"][0]["cleaning"]["cutoff"] == 6.0


def test_the_result_has_neither_the_spike_nor_the_noise(noisy, tmp_path):
    output = tmp_path / "edit.usda"
    pipeline.solve(noisy, output)
    given, after = (
        rotations_of(noisy, "/Walker/Animation"),
        rotations_of(output, f"{EDIT}_result"),
    )
    assert largest_step(given) > 60.0
    assert largest_step(after) < 20.0


def test_a_result_says_how_its_input_was_cleaned_and_solving_again_starts_from_the_source(
    noisy, tmp_path
):
    output, composed, again = (tmp_path / f"{name}.usda" for name in ("edit", "shot", "again"))
    pipeline.solve(noisy, output, compose=composed)
    pipeline.solve(composed, again)
    said = Sdf.Layer.FindOrOpen(str(output)).customLayerData["usdmotion"]
    assert any("low-passed at 6 Hz" in note for note in said["notes"])
    assert "cleaning" not in said
    assert np.array_equal(
        rotations_of(output, f"{EDIT}_result"), rotations_of(again, f"{EDIT}_result")
    )


def test_a_cutoff_that_is_given_goes_before_the_one_of_the_edit(noisy, tmp_path):
    layers = [tmp_path / f"{name}.usda" for name in ("off", "none", "other")]
    off = pipeline.solve(noisy, layers[0], cleaning=0.0)
    assert off.edits[0].cleaning is None
    assert not any("cleaned" in each for each in off.notes)
    other = pipeline.solve(noisy, layers[2], cleaning=9.0)
    assert other.edits[0].cleaning.cutoff == 9.0
    assert Sdf.Layer.FindOrOpen(str(layers[2])).customLayerData["usdmotion"]["cleaning"] == 9.0
    stage = Usd.Stage.Open(str(noisy))
    stage.GetPrimAtPath(EDIT).GetAttribute("usdmotion:cleaning").Clear()
    stage.GetRootLayer().Save()
    pipeline.solve(noisy, layers[1])
    assert np.array_equal(
        *(rotations_of(layer, f"{EDIT}_result") for layer in (layers[0], layers[1]))
    )


def test_outside_the_range_of_an_edit_and_at_its_ends_the_source_is_as_it_was(noisy, tmp_path):
    output = tmp_path / "edit.usda"
    stage = Usd.Stage.Open(str(noisy))
    for child in stage.GetPrimAtPath(EDIT).GetChildren():
        child.SetActive(False)
    stage.GetRootLayer().Save()
    pipeline.solve(noisy, output, frames=(40.0, 90.0))
    given, after = (
        rotations_of(noisy, "/Walker/Animation"),
        rotations_of(output, f"{EDIT}_result"),
    )
    assert np.array_equal(after[:39], given[:39])
    assert np.array_equal(after[90:], given[90:])
    assert np.abs(after[[39, 89]] - given[[39, 89]]).max() < 1e-6
    assert np.abs(after[40:89] - given[40:89]).max() > 1e-3


def test_a_session_asks_its_changes_of_the_cleaned_input(noisy, tmp_path):
    session = Session.open(noisy)
    assert session.report().edits[0].cleaning.cutoff == 6.0
    change = session.change(f"{EDIT}/LeftWrist", priority=5)
    assert change.frames.start < change.frames.stop
    written, solved = tmp_path / "written.usda", tmp_path / "solved.usda"
    session.write(written)
    stage = Usd.Stage.Open(str(noisy))
    stage.GetPrimAtPath(f"{EDIT}/LeftWrist").GetAttribute("usdmotion:priority").Set(5)
    stage.GetRootLayer().Save()
    pipeline.solve(noisy, solved)
    assert np.allclose(
        rotations_of(written, f"{EDIT}_result"), rotations_of(solved, f"{EDIT}_result"), atol=1e-4
    )
    assert any("cleaned input" in each for each in session.report().notes)


def test_what_a_session_writes_of_a_cleaned_input_is_what_a_solve_writes(noisy, tmp_path):
    written, solved = tmp_path / "written.usda", tmp_path / "solved.usda"
    Session.open(noisy).write(written)
    pipeline.solve(noisy, solved)
    assert written.read_bytes() == solved.read_bytes()


@pytest.mark.parametrize("given", [None, 9.0])
def test_a_report_is_measured_beside_the_cleaned_input(noisy, tmp_path, given):
    layer = tmp_path / "edit.usda"
    pipeline.solve(noisy, layer, cleaning=given)
    (found,) = report(layer, tmp_path / "report.html", shot=noisy)
    (edit,) = found.edits
    assert not edit.record.stale
    assert all(trace.verdict.met for trace in edit.traces)
    assert "cleaned input" in (tmp_path / "report.html").read_text()


def test_an_input_is_cleaned_once_for_an_answer_its_guides_and_its_report(
    noisy, tmp_path, monkeypatch
):
    calls, cleaned = [], answering.cleaned
    monkeypatch.setattr(answering, "cleaned", lambda *given: calls.append(1) or cleaned(*given))
    layer, guides, page = (tmp_path / each for each in ("edit.usda", "guides.usda", "page.html"))
    pipeline.solve(noisy, layer, guides=guides, page=page)
    at_once = guides.read_bytes(), page.read_bytes()
    assert len(calls) == 1
    pipeline.guides(layer, guides, shot=noisy)
    report(layer, page, shot=noisy)
    assert (guides.read_bytes(), page.read_bytes()) == at_once
    assert len(calls) == 3


def test_the_command_line_cleans_where_it_is_asked_to(noisy, tmp_path, monkeypatch, capsys):
    words = ["usdmotion", "solve", str(noisy), "-o", str(tmp_path / "edit.usda"), "--clean"]
    for cutoff, notes in (("9", 1), ("0", 0)):
        monkeypatch.setattr(sys, "argv", [*words, cutoff])
        with pytest.raises(SystemExit, match="0"):
            cli.main()
        assert capsys.readouterr().err.count("starts from a cleaned input") == notes
