"""The pictures that lie beside the stages: all are there, small, shown, and made by one command."""

from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from usdmotion import demos
from usdmotion.cli import app
from usdmotion.demos.gallery import figures

pytest.importorskip("matplotlib", reason="pictures need the extra 'report'")
from PIL import Image

HOUSE = Path(__file__).parents[2]
STAGES, README = HOUSE / "stages", HOUSE / "README.md"
FIGURES = {name: each for demo in demos.NAMES for name, each in figures(demo).items()}
PICTURES = list(FIGURES)
MOST, MOST_OF_ALL = 60_000, 2_000_000
"""Bytes of a picture, and of all."""
REMADE = "wrist_and_elbow"
SMALL = (48, 64)
"""Pixels of a picture in which glyphs and the edges of lines no longer tell."""

pytestmark = pytest.mark.skipif(not STAGES.is_dir(), reason="stages/ is not beside these tests")


def shades(png: bytes) -> np.ndarray:
    with Image.open(BytesIO(png)) as picture:
        small = picture.convert("L").resize(SMALL, Image.Resampling.BOX)
        return np.asarray(small, dtype=float)


@pytest.mark.parametrize("name", PICTURES)
def test_a_figure_has_its_small_picture_beside_its_stage_and_in_the_readme(name: str) -> None:
    assert 2_000 < (STAGES / f"{name}.png").stat().st_size <= MOST
    lines = README.read_text(encoding="utf-8").splitlines()
    (line,) = (each for each in lines if f"stages/{name}.png" in each)
    figure, _, what = FIGURES[name].shows.rpartition(": ")
    assert line.startswith(f"| {figure} | {what[0].upper()}{what[1:]}: ")


def test_there_are_no_other_pictures_and_all_are_small_together() -> None:
    kept = sorted(STAGES.glob("*.png"))
    assert [each.stem for each in kept] == sorted(PICTURES)
    assert sum(each.stat().st_size for each in kept) <= MOST_OF_ALL


def test_the_command_makes_the_picture_that_is_kept(tmp_path: Path) -> None:
    said = CliRunner().invoke(app, ["demo", REMADE, "-o", str(tmp_path), "--picture"])
    assert said.exit_code == 0, said.output
    assert sorted(each.name for each in tmp_path.iterdir()) == [f"{REMADE}.png", f"{REMADE}.usda"]
    made = shades((tmp_path / f"{REMADE}.png").read_bytes())
    kept = {name: shades((STAGES / f"{name}.png").read_bytes()) for name in PICTURES}
    apart = {name: float(np.abs(each - made).mean()) for name, each in kept.items()}
    assert min(apart, key=lambda name: apart[name]) == REMADE
    assert apart[REMADE] < 0.5 * sorted(apart.values())[1]
