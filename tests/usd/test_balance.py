"""Who ranks a wrist above the centre of mass is told so, and solved all the same."""

from pathlib import Path

import pytest
from pxr import Usd

from usdmotion import demos, pipeline
from usdmotion.constraints import built_in
from usdmotion.usd import inspect

SUPPORTED = 'uniform token[] usdmotion:supports = ["hip/knee/ankle"]'


def priority(rank):
    return f"uniform int usdmotion:priority = {rank}"


def found(text, save, *constraints):
    return inspect(save(text.man(edit=text.edit("".join(constraints)))), built_in()).notes


def joint(name, rank):
    return f'uniform token usdmotion:joint = "{name}"\n{priority(rank)}'


def head(text, rank, kind="MotionPositionConstraint"):
    attributes = joint("hip/head", rank)
    return f'\ndef {kind} "Head" {{\n{attributes}\n}}\n'


def balance(rank, supports=SUPPORTED):
    return f'\ndef MotionCenterOfMassConstraint "Mass" {{\n{priority(rank)}\n{supports}\n}}\n'


def test_an_effector_above_the_balance_is_pointed_out(text, save):
    (note,) = found(text, save, head(text, 1), balance(2))
    assert note.path == "/Man/Bones/Edit/Head"
    assert note.sentence.startswith("</Man/Bones/Edit/Head> ranks above </Man/Bones/Edit/Mass>")


@pytest.mark.parametrize("rank", [1, 2])
def test_beside_or_below_the_balance_it_is_not(text, save, rank):
    assert found(text, save, head(text, 2), balance(rank)) == ()


def test_what_asks_for_no_place_pulls_nobody_over(text, save):
    kind = "MotionOrientationConstraint"
    assert found(text, save, head(text, 1, kind), balance(2)) == ()


@pytest.mark.parametrize("name", ["hip", "hip/knee", "hip/knee/ankle"])
def test_feet_and_what_they_carry_may_rank_above(text, save, name):
    foot = f'\ndef MotionPositionConstraint "Foot" {{\n{joint(name, 1)}\n}}\n'
    assert found(text, save, foot, balance(2)) == ()


def test_without_a_balance_there_is_nothing_to_lose(text, save):
    assert found(text, save, head(text, 1)) == ()


def test_the_map_of_the_body_tells_hands_from_feet(tmp_path: Path):
    shot = demos.build("reaching", tmp_path)
    stage = Usd.Stage.Open(str(shot))
    mass = stage.GetPrimAtPath("/Walker/Skeleton/Reaching/Balance")
    for name in ("usdmotion:supports", "usdmotion:supportPoints"):
        mass.GetAttribute(name).Clear()
    stage.Save()
    seen = pipeline.inspect(shot)
    assert seen.faults == ()
    assert [note.path for note in seen.notes] == ["/Walker/Skeleton/Reaching/LeftWrist"]
