"""A stage that carries results is solved again."""

import pytest
from pxr import Sdf

from usdmotion import usd
from usdmotion.errors import SceneError


def test_a_stage_that_carries_its_result_gives_the_same_result_again(
    text, save, read, solved, tmp_path, bent
):
    shot = read(save(text.man()))
    solved(shot, bent(shot))
    first = (tmp_path / "edit.usda").read_bytes()
    again = read(tmp_path / "composed.usda")
    assert again.takes[0].source == "/Man/Walk"
    usd.write(again, [bent(again)], tmp_path / "second.usda")
    assert (tmp_path / "second.usda").read_bytes() == first


def test_another_edit_stacks_on_a_result_and_keeps_its_place_when_the_first_is_solved_again(
    text, save, read, tmp_path, bent
):
    edits = "\n".join(f'def MotionEdit "{name}" {{}}' for name in ("One", "Two"))
    path = save(text.man(edit=edits))
    for name in ("One", "Two"):
        shot = read(path, edits=[f"/Man/Bones/{name}"])
        usd.write(shot, [bent(shot)], tmp_path / f"{name}.usda")
        usd.compose(shot, tmp_path / f"{name}.usda", tmp_path / f"with{name}.usda")
        path = tmp_path / f"with{name}.usda"
    assert read(path, edits=["/Man/Bones/Two"]).takes[0].source == "/Man/Bones/One_result"
    first = read(path, edits=["/Man/Bones/One"])
    assert first.takes[0].source == "/Man/Walk"
    assert first.takes[0].bound == "/Man/Bones/Two_result"


def test_a_source_made_from_its_own_result_is_refused(text, save, read, tmp_path, bent):
    source = 'def MotionEdit "Edit" {\nrel usdmotion:source = </Man/Bones/Edit_result>\n}'
    shot = read(save(text.man(), "first.usda"))
    usd.write(shot, [bent(shot)], tmp_path / "edit.usda")
    path = save(text.man(edit=source), header="subLayers = [@./edit.usda@]")
    with pytest.raises(SceneError, match=r"</Man/Bones/Edit> starts from .* its own result"):
        read(path)


def test_something_else_where_the_result_would_go_is_refused(text, save, read):
    other = 'def Scope "Edit_result" {}\ndef MotionEdit "Edit" {}'
    with pytest.raises(SceneError, match=r"<.*Edit_result> is where the result of .* rename one"):
        read(save(text.man(edit=other)))


def test_the_hash_knows_what_was_read(text, save, read, tmp_path, bent):
    def digest(path):
        shot = read(path)
        usd.write(shot, [bent(shot)], tmp_path / "hashed.usda")
        data = Sdf.Layer.OpenAsAnonymous(str(tmp_path / "hashed.usda")).customLayerData
        return data["usdmotion"]["hashes"]["/Man/Bones/Edit"]

    same = digest(save(text.man()))
    assert digest(save(text.man(), "copy.usda")) == same
    assert digest(save(text.man(animation=text.poses(seed=1)), "other.usda")) != same
    assert digest(save(text.man(), "units.usda", "metersPerUnit = 0.02")) != same
    constraint = 'def MotionPositionConstraint "P" {\nuniform token usdmotion:joint = "hip"\n}'
    edit = f'def MotionEdit "Edit" {{\n{constraint}\n}}'
    assert digest(save(text.man(edit=edit), "held.usda")) != same
