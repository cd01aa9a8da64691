"""The report from end to end: several characters, long clips, what cannot be written."""

from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdGeom

from usdmotion import Goal, Motion, PositionConstraint, pipeline
from usdmotion.errors import FileError
from usdmotion.reporting import report
from usdmotion.testing import arm_scene
from usdmotion.usd import author, author_character, author_edit

WRIST = "base/shoulder/elbow/wrist"


@pytest.fixture
def arms(tmp_path: Path):
    """Return what writes a stage of arms whose wrists go to each other, or a bit up."""

    def write(names=("Left", "Right"), frame_count=12) -> Path:
        shot = tmp_path / "arms.usda"
        stage = Usd.Stage.CreateNew(str(shot))
        UsdGeom.SetStageMetersPerUnit(stage, 1.0)
        stage.SetTimeCodesPerSecond(24.0)
        (arm,) = arm_scene(frame_count=12).characters
        back = np.abs((np.arange(frame_count) + 11) % 22 - 11)
        given = Motion(
            np.arange(frame_count) / 24.0, arm.motion.translations[back], arm.motion.rotations[back]
        )
        codes = 1.0 + np.arange(frame_count)
        stage.SetStartTimeCode(codes[0])
        stage.SetEndTimeCode(codes[-1])
        paths = [
            author_character(stage, f"/{n}", arm.skeleton, arm.body, given, time_codes=codes)
            for n in names
        ]
        for place, path in enumerate(paths):
            UsdGeom.Xformable(stage.GetPrimAtPath(path).GetParent()).AddTranslateOp().Set(
                (0.0, 0.0, 0.1 * place)
            )
            author_edit(stage, f"{path}/Edit")
            other = paths[1 - place] if len(paths) > 1 else None
            up = Goal(mode="offset", translation=np.array((0.0, 0.05, 0.0)))
            goal = up if other is None else Goal(joint=(other, WRIST))
            reach = PositionConstraint(path="", skeleton=path, joint=WRIST, goals=(goal,))
            author(stage, f"{path}/Edit/Reach", reach)
        stage.GetRootLayer().Save()
        return shot

    return write


def test_characters_that_are_solved_together_are_told_together(arms, tmp_path):
    edit, page = tmp_path / "arms.edit.usda", tmp_path / "arms.html"
    pipeline.solve(arms(), edit, page=page)
    (found,) = report(edit, tmp_path / "again.html", png=tmp_path / "png")
    assert [each.record.stale for each in found.edits] == [False, False]
    text = page.read_text()
    assert text == (tmp_path / "again.html").read_text()
    assert text.index("<h2>/Left/Skeleton/Edit</h2>") < text.index("<h2>/Right/Skeleton/Edit</h2>")
    names = [each.name for each in (tmp_path / "png").iterdir()]
    assert {"Left_Skeleton_Edit.overview.png", "Right_Skeleton_Edit.overview.png"} <= set(names)


def test_a_long_clip_makes_no_long_page(arms, tmp_path):
    shot = arms(("One",), 4000)
    pipeline.solve(shot, tmp_path / "arms.edit.usdc", page=tmp_path / "long.html")
    pipeline.solve(shot, tmp_path / "b.usdc", frames=(1.0, 200.0))
    long = (tmp_path / "long.html").stat().st_size
    report(tmp_path / "b.usdc", tmp_path / "short.html", shot=shot)
    assert long < 3 * (tmp_path / "short.html").stat().st_size < 1_000_000


def test_nothing_is_half_written(arms, tmp_path):
    edit = tmp_path / "arms.edit.usda"
    pipeline.solve(arms(("One",)), edit)
    with pytest.raises(FileError, match="cannot be written"):
        report(edit, tmp_path / "absent" / "page.html")
    (tmp_path / "file").write_text("")
    with pytest.raises(FileError, match="cannot be made"):
        report(edit, tmp_path / "page.html", png=tmp_path / "file")
    assert not (tmp_path / "page.html").exists()
