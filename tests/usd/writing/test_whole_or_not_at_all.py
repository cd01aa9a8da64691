"""A layer is there whole or not at all, and no input is ever touched."""

import pytest
from pxr import Usd

from usdmotion import usd
from usdmotion.errors import FileError, SceneError
from usdmotion.motion import Motion


def test_an_input_is_never_written_to(text, save, read, tmp_path, bent):
    save(text.man(), "asset.usda", "metersPerUnit = 1")
    path = save('def "Man" (references = @./asset.usda@</Man>) {}')
    shot = read(path)
    before = {each: each.read_bytes() for each in tmp_path.iterdir()}
    for name in ("asset.usda", "shot.usda"):
        with pytest.raises(FileError, match=rf"{name}: .* no input is written to"):
            usd.write(shot, [bent(shot)], tmp_path / name)
        (tmp_path / "link.usda").symlink_to(tmp_path / name)
        with pytest.raises(FileError, match="no input is written to"):
            usd.write(shot, [bent(shot)], tmp_path / "link.usda")
        (tmp_path / "link.usda").unlink()
        with pytest.raises(FileError, match="no input is written to"):
            usd.compose(shot, tmp_path / "edit.usda", tmp_path / name)
    with pytest.raises(FileError, match="no input is written to"):
        usd.compose(shot, tmp_path / "edit.usda", tmp_path / "edit.usda")
    assert {each: each.read_bytes() for each in tmp_path.iterdir()} == before


@pytest.mark.parametrize(
    ("name", "why"),
    [("edit.txt", "name a file that ends in .usda"), ("none/edit.usda", "there is no folder")],
)
def test_a_place_where_no_layer_can_be_is_refused(shot, tmp_path, name, why, bent):
    before = sorted(tmp_path.iterdir())
    with pytest.raises(FileError, match=f"{name}: {why}"):
        usd.write(shot, [bent(shot)], tmp_path / name)
    assert sorted(tmp_path.iterdir()) == before


def test_a_layer_that_cannot_be_moved_into_its_place_leaves_nothing_behind(shot, tmp_path, bent):
    (tmp_path / "edit.usda").mkdir()
    before = sorted(tmp_path.iterdir())
    with pytest.raises(FileError, match=r"edit.usda: cannot be written"):
        usd.write(shot, [bent(shot)], tmp_path / "edit.usda")
    assert sorted(tmp_path.iterdir()) == before


def test_a_result_that_does_not_fit_its_edit_is_refused_and_leaves_no_file(shot, tmp_path):
    motion = shot.scenes[0].characters[0].motion
    short = Motion(motion.times[:2], motion.translations[:2], motion.rotations[:2])
    with pytest.raises(SceneError, match="the result of </Man/Bones/Edit> has"):
        usd.write(shot, [usd.Result("/Man/Bones/Edit", short, "x", {})], tmp_path / "edit.usda")
    assert not (tmp_path / "edit.usda").exists()


def test_a_result_of_an_edit_that_was_not_read_is_refused(shot, tmp_path):
    motion = shot.scenes[0].characters[0].motion
    with pytest.raises(SceneError, match="a result of </Other>, which was not read"):
        usd.write(shot, [usd.Result("/Other", motion, "x", {})], tmp_path / "edit.usda")


def test_an_older_layer_is_replaced(shot, tmp_path, leave, bent):
    output = tmp_path / "edit.usda"
    usd.write(shot, [bent(shot)], output)
    first = output.read_bytes()
    usd.write(shot, leave(shot), output)
    assert output.read_bytes() != first
    usd.write(shot, [bent(shot)], output)
    assert output.read_bytes() == first


def test_a_binary_layer_is_the_same_bytes_twice(shot, tmp_path, bent):
    for name in ("one.usdc", "two.usdc"):
        usd.write(shot, [bent(shot)], tmp_path / name)
    assert (tmp_path / "one.usdc").read_bytes() == (tmp_path / "two.usdc").read_bytes()


def test_constraints_and_results_of_several_scenes_share_one_layer(
    text, save, read, tmp_path, leave
):
    shot = read(save(text.man("Ann") + text.man("Bob")))
    usd.write(shot, leave(shot), tmp_path / "edit.usda")
    usd.compose(shot, tmp_path / "edit.usda", tmp_path / "all.usda")
    stage = Usd.Stage.Open(str(tmp_path / "all.usda"))
    assert all(stage.GetPrimAtPath(f"/{name}/Bones/Edit_result") for name in ("Ann", "Bob"))
