"""A clip on its stage moves, by UsdSkel, as forward kinematics straight from the text says."""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdSkel

from usdmotion import pipeline
from usdmotion.arrays import Floats

CLOSE = 1e-5
"""What may be between the two, as a part of the height of the body."""
FEW = 5
"""Frames of a clip that are compared: the first, the last, and some between."""

Places = Callable[..., tuple[int, list[Floats]]]


def stage_places(path: Path, time_codes: Sequence[float] | Floats) -> list[Floats]:
    """Return where the joints of a stage's character are at some times [m]."""
    stage = Usd.Stage.Open(str(path))
    skeleton = stage.GetDefaultPrim().GetChild("Skeleton")
    query = UsdSkel.Cache().GetSkelQuery(UsdSkel.Skeleton(skeleton))
    cache, unit = UsdGeom.XformCache(), UsdGeom.GetStageMetersPerUnit(stage)
    found = []
    for code in time_codes:
        cache.SetTime(code)
        world = np.array(cache.GetLocalToWorldTransform(skeleton))
        matrices = np.array(query.ComputeJointSkelTransforms(code)) @ world
        found.append(unit * matrices[:, 3, :3])
    return found


def apart(found: Sequence[Floats], wanted: Sequence[Floats]) -> float:
    """Return the largest distance between two lists of poses, as a part of the height."""
    height = max(float(np.ptp(each, axis=0).max()) for each in wanted)
    pairs = zip(found, wanted, strict=True)
    return max(float(np.linalg.norm(a - b, axis=1).max()) for a, b in pairs) / (height or 1.0)


def some_of(count: int) -> list[int]:
    return sorted(set(np.linspace(0, count - 1, FEW).astype(int).tolist()))


def test_every_captured_clip_moves_as_its_text_says(
    family, text_places: Places, tmp_path: Path
) -> None:
    assert family.paths
    for path in family.paths:
        output = tmp_path / f"{path.stem}.usdc"
        recording = pipeline.import_motion(path, output)
        frames = some_of(recording.motion.frame_count)
        count, wanted = text_places(path, family.metres, relative=family.relative, frames=frames)
        found = stage_places(output, 1.0 + np.array(frames))
        assert apart(found, wanted) < CLOSE, path
        stage = Usd.Stage.Open(str(output))
        assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (1.0, float(count)), path
        assert UsdGeom.GetStageUpAxis(stage) == family.up, path


@pytest.mark.parametrize("name", ["mova_4_joint_named_end", "slimevr_995_fused_numbers"])
def test_so_do_the_odd_ones_whose_unit_has_to_be_said(
    mocap: Path, text_places: Places, tmp_path: Path, name: str
) -> None:
    path = mocap / f"odd/bvh/reproductions/{name}.bvh"
    pipeline.import_motion(path, tmp_path / "odd.usda", unit=0.5)
    count, wanted = text_places(path, 0.5, relative=False)
    assert apart(stage_places(tmp_path / "odd.usda", 1.0 + np.arange(count)), wanted) < CLOSE


@pytest.mark.parametrize(
    ("clip", "meeting"),
    [
        ("cmu/daz/08_01_trimmed.bvh", (5, 1)),  # 120 per second: every fifth
        ("other/mocapbank_crouch.bvh", (5, 4)),  # 30: five frames are four of 24
        ("other/rokoko_jesse_dance.bvh", (25, 6)),  # 100
    ],
)
def test_resampled_poses_are_the_same_where_the_times_meet(
    mocap: Path, text_places: Places, tmp_path: Path, clip: str, meeting: tuple[int, int]
) -> None:
    every, step = meeting
    output = tmp_path / "clip.usdc"
    recording = pipeline.import_motion(mocap / clip, output, fps=24, first=101)
    stage = Usd.Stage.Open(str(output))
    assert stage.GetTimeCodesPerSecond() == stage.GetFramesPerSecond() == 24.0
    last = stage.GetEndTimeCode()
    assert (stage.GetStartTimeCode(), last) == (101.0, 100.0 + recording.motion.frame_count)
    meetings = np.arange(int((last - 101.0) / step) + 1)[:40]
    _, wanted = text_places(mocap / clip, 0.01, relative=False, frames=every * meetings)
    assert apart(stage_places(output, 101.0 + step * meetings), wanted) < CLOSE


WALK = """HIERARCHY
ROOT Hips
{
  OFFSET 1 2 3
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Leg
  {
    OFFSET 0 -80 0
    CHANNELS 3 Yrotation Xrotation Zrotation
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
1 170 0 0 10 0 0 5 20
2 170 5 0 20 0 7 10 0
3 170 0 9 30 0 0 15 0
4 170 0 0 40 -80 0 20 0
"""


@pytest.fixture
def walk(tmp_path: Path) -> Path:
    path = tmp_path / "walk.bvh"
    path.write_text(WALK)
    return path


def test_the_first_time_code_the_unit_and_the_name_are_those_asked_for(
    walk: Path, text_places: Places, tmp_path: Path
) -> None:
    output = tmp_path / "walk.usda"
    pipeline.import_motion(
        walk, output, first=-7.0, unit=0.02, name="Hero", options={"root": "absolute"}
    )
    stage = Usd.Stage.Open(str(output))
    assert stage.GetDefaultPrim().GetPath() == "/Hero"
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (-7.0, -3.0)
    assert stage.GetTimeCodesPerSecond() == pytest.approx(10.0)
    _, wanted = text_places(walk, 0.02, relative=False)
    assert apart(stage_places(output, np.arange(-7.0, -2.0)), wanted) < CLOSE


def test_a_wrong_rate_is_overruled_and_the_poses_are_the_same(
    walk: Path, text_places: Places, tmp_path: Path
) -> None:
    output = tmp_path / "walk.usda"
    options = {"rate": "48", "root": "absolute", "unit": "0.01"}
    recording = pipeline.import_motion(walk, output, fps=24, options=options)
    assert any("overruled by 48" in note for note in recording.notes)
    stage = Usd.Stage.Open(str(output))
    # Five samples at 48 per second are three at 24.
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (1.0, 3.0)
    _, wanted = text_places(walk, 0.01, relative=False, frames=(0, 2, 4))
    assert apart(stage_places(output, (1.0, 2.0, 3.0)), wanted) < CLOSE


@pytest.mark.parametrize("root", ["absolute", "relative"])
def test_a_root_with_an_offset_is_where_its_convention_puts_it(
    walk: Path, text_places: Places, tmp_path: Path, root: str
) -> None:
    pipeline.import_motion(walk, tmp_path / "walk.usdc", unit=0.01, options={"root": root})
    _, wanted = text_places(walk, 0.01, relative=root == "relative")
    assert apart(stage_places(tmp_path / "walk.usdc", np.arange(1.0, 6.0)), wanted) < CLOSE
