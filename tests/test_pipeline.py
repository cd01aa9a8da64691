"""The verbs as functions: from a shot to a layer and a report, without a word printed."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest
from pxr import Usd, UsdSkel

from usdmotion import (
    FileError,
    InputError,
    OptionError,
    PluginError,
    Problem,
    SceneError,
    Solution,
    Solver,
    answering,
    import_motion,
    inspect,
    option,
    solve,
)
from usdmotion.plugins import Host, host
from usdmotion.scene import Edit

ArmShot = Callable[..., Path]
EDIT = "/Arm/Skeleton/Edit"
WALK = """HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Leg
  {
    OFFSET 0 -80 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 -90 0
    }
  }
}
MOTION
Frames: 5
Frame Time: 0.1
0 170 0 0 0 0 0 0 0
1 170 0 0 10 0 0 5 0
2 170 0 0 20 0 0 10 0
3 170 0 0 30 0 0 15 0
4 170 0 0 40 0 0 20 0
"""


def wrist_heights(stage: Usd.Stage) -> list[float]:
    """Return the height of the wrist at every time code, as UsdSkel has it."""
    skeleton = UsdSkel.Skeleton.Get(stage, "/Arm/Skeleton")
    query = UsdSkel.Cache().GetSkelQuery(skeleton)
    times = np.arange(stage.GetStartTimeCode(), stage.GetEndTimeCode() + 1.0)
    return [query.ComputeJointSkelTransforms(time)[-1].ExtractTranslation()[1] for time in times]


def test_a_shot_in_an_edited_layer_out(arm_shot: ArmShot, tmp_path: Path) -> None:
    shot = arm_shot(0.05)
    before = wrist_heights(Usd.Stage.Open(str(shot)))
    output, composed = tmp_path / "arm.edit.usda", tmp_path / "arm.solved.usda"
    report = solve(shot, output, compose=composed)
    after = wrist_heights(Usd.Stage.Open(str(composed)))
    np.testing.assert_allclose(np.subtract(after, before), 0.05, atol=1e-3)
    (edit,) = report.edits
    (row,) = edit.constraints
    assert (edit.path, edit.skeleton, edit.solver) == (EDIT, "/Arm/Skeleton", "prioritized_ik")
    assert (edit.frames, row.path, row.met) == (12, f"{EDIT}/Wrist", True)
    assert edit.iterations > 0
    assert edit.seconds > 0.0


def test_solving_again_gives_the_same_bytes_and_leaves_the_shot_as_it_was(
    arm_shot: ArmShot, tmp_path: Path
) -> None:
    shot = arm_shot()
    before = shot.read_bytes()
    layers = [tmp_path / "one.usda", tmp_path / "two.usda"]
    for layer in layers:
        solve(shot, layer)
    assert layers[0].read_bytes() == layers[1].read_bytes()
    assert shot.read_bytes() == before


def test_what_is_out_of_reach_is_a_number_and_not_an_error(
    arm_shot: ArmShot, tmp_path: Path
) -> None:
    report = solve(arm_shot(2.0), tmp_path / "out.usda")
    (row,) = report.edits[0].constraints
    assert not report.met and not row.met
    assert row.max > 1.0


def test_only_the_frames_asked_for_are_solved(arm_shot: ArmShot, tmp_path: Path) -> None:
    report = solve(arm_shot(), tmp_path / "out.usda", frames=(3.0, 5.0))
    assert report.edits[0].frames == 3


def test_it_tells_what_it_is_doing(arm_shot: ArmShot, tmp_path: Path) -> None:
    told: list[str] = []
    shot, output = arm_shot(), tmp_path / "out.usda"
    solve(shot, output, say=told.append)
    assert told[0] == f"reading {shot}"
    assert told[-1] == f"writing {output}"
    assert EDIT in told[1] or "compiling" in told[1]


def test_what_is_probably_not_meant_goes_with_the_answer(arm_shot: ArmShot, tmp_path: Path) -> None:
    shot = arm_shot()
    assert solve(shot, tmp_path / "out.usda").notes == ()
    stage = Usd.Stage.Open(str(shot))
    stage.GetPrimAtPath("/Arm/Animation").RemoveProperty("scales")
    low = stage.DefinePrim(f"{EDIT}/Low", "MotionPositionConstraint")
    low.GetAttribute("usdmotion:joint").Set("base/shoulder/elbow")
    low.GetAttribute("usdmotion:priority").Set(2)
    stage.GetRootLayer().Save()
    rests, *_, rule = solve(shot, tmp_path / "out.usda").notes
    assert rests.startswith("</Arm/Animation> has no scales, so USD shows the rest pose")
    assert rule.startswith(f"<{EDIT}/Low> moves joints above <{EDIT}/Wrist>")


@pytest.mark.parametrize("verb", [inspect, lambda path: solve(path, path.with_suffix(".out"))])
def test_a_file_that_is_not_there_is_named(verb: Callable[[Path], object], tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"absent\.usda: there is no such file"):
        verb(tmp_path / "absent.usda")


@dataclass(frozen=True)
class Fake:
    """A solver of which a test says what it does."""

    name: ClassVar[str] = "fake"
    spoil: ClassVar[Callable[[Problem, Solution], Solution]] = staticmethod(lambda p, s: s)
    pull: float = option(0.5, "How much.", minimum=0.0, maximum=1.0)

    def solve(self, problem: Problem) -> Solution:
        cast = problem.cast
        nothing = np.zeros(cast.frame_count, dtype=np.int64)
        return self.spoil(problem, Solution(cast.translations, cast.rotations, nothing, nothing))


@pytest.fixture
def fake(monkeypatch: pytest.MonkeyPatch) -> type[Solver]:
    """Make the host know one solver more."""
    first, *others = host().plugins
    together = Host((replace(first, solvers=(*first.solvers, Fake)), *others))
    monkeypatch.setattr(answering, "host", lambda: together)
    return Fake


def test_another_solver_leaves_behind_the_options_of_the_first(
    arm_shot: ArmShot, tmp_path: Path, fake: type[Solver]
) -> None:
    report = solve(arm_shot(), tmp_path / "out.usda", solver="fake", options={"pull": "0.25"})
    assert report.edits[0].solver == "fake"
    assert report.edits[0].constraints[0].max == pytest.approx(0.05, abs=1e-6)


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"pull": 2}, "option 'pull' is 2, not a number of at least 0, at most 1"),
        ({"push": 1}, "'fake' has no option 'push'; it has: pull"),
    ],
)
def test_options_are_checked_by_name_and_limit(
    arm_shot: ArmShot,
    tmp_path: Path,
    fake: type[Solver],
    values: Mapping[str, object],
    sentence: str,
) -> None:
    with pytest.raises(OptionError, match=sentence):
        solve(arm_shot(), tmp_path / "out.usda", solver="fake", options=values)


def test_an_unknown_solver_is_answered_with_those_that_are_there(
    arm_shot: ArmShot, tmp_path: Path
) -> None:
    with pytest.raises(OptionError, match=r"no solver 'magic'; there are: .*prioritized_ik"):
        solve(arm_shot(solver="magic"), tmp_path / "out.usda")


SPOILED: list[tuple[Callable[[Problem, Solution], Any], str]] = [
    (
        lambda p, s: Solution(s.translations[1:], s.rotations[1:], s.iterations[1:], s.stops[1:]),
        r"'fake' gives back \(11, 5\), not \(12, 5\), poses",
    ),
    (lambda p, s: replace(s, rotations=np.nan * s.rotations), "numbers that are not finite"),
]


@pytest.mark.parametrize(("spoil", "sentence"), SPOILED)
def test_a_solver_that_breaks_its_contract_is_named_and_writes_nothing(
    arm_shot: ArmShot,
    tmp_path: Path,
    fake: type[Fake],
    monkeypatch: pytest.MonkeyPatch,
    spoil: Callable[[Problem, Solution], Any],
    sentence: str,
) -> None:
    monkeypatch.setattr(fake, "spoil", staticmethod(spoil))
    with pytest.raises(PluginError, match=sentence):
        solve(arm_shot(), tmp_path / "out.usda", solver="fake")
    assert not (tmp_path / "out.usda").exists()


def test_edits_that_are_solved_together_must_agree_on_how() -> None:
    one = Edit("/A/Edit", "/A", (), options={"iterations": 3})
    other = Edit("/B/Edit", "/B", (), options={"iterations": 4})
    with pytest.raises(SceneError, match="</A/Edit> and </B/Edit> are solved together but ask for"):
        answering._configured([one, other], None, {})
    with pytest.raises(SceneError, match="different solvers or options"):
        answering._configured([one, replace(one, solver="other")], None, {})
    chosen = answering._configured([one, replace(other, options=one.options)], None, {"finish": 2})
    assert (chosen.iterations, chosen.finish) == (3, 2)  # type: ignore[attr-defined]


@pytest.fixture
def walk(tmp_path: Path) -> Path:
    path = tmp_path / "walk.bvh"
    path.write_text(WALK)
    return path


def test_a_recording_becomes_a_stage(walk: Path, tmp_path: Path) -> None:
    recording = import_motion(walk, tmp_path / "walk.usda", name="Hero", first=101.0)
    stage = Usd.Stage.Open(str(tmp_path / "walk.usda"))
    assert recording.name == stage.GetDefaultPrim().GetName() == "Hero"
    assert stage.GetStartTimeCode() == 101.0
    assert stage.GetTimeCodesPerSecond() == pytest.approx(10.0)


def test_a_recording_is_resampled_where_a_rate_is_asked_for(walk: Path, tmp_path: Path) -> None:
    recording = import_motion(walk, tmp_path / "walk.usda", fps=20.0)
    assert recording.motion.frame_count == 9
    stage = Usd.Stage.Open(str(tmp_path / "walk.usda"))
    assert stage.GetTimeCodesPerSecond() == 20.0
    assert stage.GetEndTimeCode() == 9.0


def test_the_unit_of_a_file_can_be_said(walk: Path, tmp_path: Path) -> None:
    large = import_motion(walk, tmp_path / "large.usda", unit=0.01)
    small = import_motion(walk, tmp_path / "small.usda", options={"unit": "0.001"})
    lengths = (recording.skeleton.rest_translations[1, 1] for recording in (large, small))
    assert list(lengths) == pytest.approx([-0.8, -0.08])


def test_a_name_that_no_prim_can_have_is_refused(walk: Path, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="the name 'my hero' is no prim name"):
        import_motion(walk, tmp_path / "walk.usda", name="my hero")


def test_a_file_that_nothing_reads_is_refused(tmp_path: Path) -> None:
    (tmp_path / "walk.disc").write_text("")
    with pytest.raises(InputError, match=r"walk\.disc: no reader .*\.bvh"):
        import_motion(tmp_path / "walk.disc", tmp_path / "walk.usda")


def test_inspecting_shows_edits_and_constraints_without_solving(arm_shot: ArmShot) -> None:
    found = inspect(arm_shot())
    assert [edit.path for edit in found.edits] == [EDIT]
    assert [constraint.path for constraint in found.constraints] == [f"{EDIT}/Wrist"]
    assert found.faults == ()


def test_frames_that_were_left_at_the_iteration_limit_are_said(
    arm_shot: ArmShot, tmp_path: Path
) -> None:
    shot, output = arm_shot(), tmp_path / "out.usda"
    report = solve(shot, output, options={"iterations": 1, "posture_change": 0.0})
    (note,) = (each for each in report.notes if "iteration limit" in each)
    assert note == (
        "/Arm/Skeleton/Edit: 12 of 12 frames were left at the iteration limit, still moving"
    )
    assert not any("iteration limit" in each for each in solve(shot, output).notes)
