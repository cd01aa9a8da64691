"""Characters that are solved together on a stage that is open."""

from pathlib import Path

import numpy as np
import pytest
from pxr import Usd

from usdmotion import onstage
from usdmotion.constraints import built_in
from usdmotion.errors import SceneError
from usdmotion.usd.outcomes import outcomes_of

ANKLE, HEAD = "hip/knee/ankle", "hip/head"
ANN, BOB = "/Ann/Bones/Edit", "/Bob/Bones/Edit"


@pytest.fixture
def shot(text, save) -> Path:
    """Return a stage on which Ann's ankle is held at the head that Bob lifts."""
    ride = text.goal(
        f"""rel usdmotion:space = </Bob/Bones>
        uniform token usdmotion:spaceJoint = "{HEAD}" """,
        translate="(0, 0, 0)",
    )
    lift = text.goal('uniform token usdmotion:mode = "offset"', translate="(0, 4, 0)")
    ann = text.man("Ann", edit=text.edit(text.hold(ride)))
    raised = text.edit(text.hold(lift).replace(ANKLE, HEAD))
    return save(ann + text.man("Bob", edit=raised, animation=text.poses(seed=3)))


def opened(shot: Path) -> Usd.Stage:
    stage = Usd.Stage.Open(str(shot))
    stage.SetEditTarget(stage.GetSessionLayer())
    return stage


def stale(stage: Usd.Stage) -> dict[str, bool]:
    found = outcomes_of(stage, Path("stage"), built_in())
    return {record.edit: record.stale for outcome in found for record in outcome.records}


def test_edits_that_look_at_each_other_are_solved_as_from_file_to_file(shot, solve):
    stage, answer = opened(shot), solve(shot)
    onstage.solve(stage)
    for edit in (ANN, BOB):
        here, there = (
            each.GetPrimAtPath(f"{edit}_result").GetAttribute("rotations")
            for each in (stage, answer.new)
        )
        for code in there.GetTimeSamples():
            np.testing.assert_array_equal(here.Get(code), there.Get(code))
    assert stale(stage) == {ANN: False, BOB: False}


def test_one_that_was_solved_before_the_other_is_stale_until_both_are_solved(shot):
    stage = opened(shot)
    onstage.solve(stage, [ANN])
    assert stale(stage) == {ANN: False}
    onstage.solve(stage, [BOB])
    assert stale(stage) == {ANN: True, BOB: False}
    onstage.solve(stage)
    assert stale(stage) == {ANN: False, BOB: False}


def test_a_stage_that_does_not_compose_is_not_solved_but_its_results_are_shown(shot):
    stage = opened(shot)
    onstage.solve(stage)
    stage.DefinePrim("/Lost").GetReferences().AddReference("./gone.usda")
    for verb in (onstage.solve, onstage.detect):
        with pytest.raises(SceneError, match=r"^shot\.usda: </Lost> does not compose"):
            verb(stage)
    onstage.show(stage, ANN, False)
    assert not onstage.shown(stage, ANN) and onstage.shown(stage, BOB)
