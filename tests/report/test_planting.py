"""What is told of feet that were planted: tables for people, JSON for programs."""

import json

import pytest
from rich.console import Console

from usdmotion.report.planting import FootReport, KeptReport, PlantingReport
from usdmotion.report.verdict import ConstraintReport, EditReport

FOOT = FootReport("/Edit", "Hips/Leg/Foot", 3, 0.0104, 0.0, 0.0082, 0.00002)
KEPT = KeptReport("/Edit", 0.0002, 0.0041, 0.0123, "Hips/Leg/Knee", 17.5, 40.2, 38.9)


def edit(*met: bool) -> EditReport:
    rows = tuple(
        ConstraintReport("/Edit/C", "MotionContactConstraint", 1, 0.0, 0.0, "m", 1.0, each)
        for each in met
    )
    return EditReport("/Edit", "/Skeleton", "ik", 24, 0.1, 48, rows)


def shown(report: PlantingReport) -> str:
    console = Console(width=120, record=True, force_terminal=False)
    for each in report.tables():
        console.print(each, markup=False)
    return console.export_text()


def test_a_row_says_how_far_a_joint_slid_before_and_after() -> None:
    (row,) = (
        line for line in shown(PlantingReport((FOOT,), (), (), ())).splitlines() if "│" in line
    )
    cells = [cell.strip() for cell in row.split("│")[1:-1]]
    assert cells == ["Foot", "3", "10.40 mm", "0.00 mm", "8.20 mm", "0.02 mm"]


def test_what_was_kept_is_a_sentence() -> None:
    said = " ".join(shown(PlantingReport((FOOT,), (KEPT,), (), ())).split())
    assert "moved by 4.10 mm on average, Knee most, by 12.30 mm at 17.5" in said
    assert "away from contacts by 0.20 mm at most" in said
    assert "at most; jerk of the root 40 → 39 m/s³" in said


def test_feet_that_never_stand_are_said_in_words() -> None:
    assert "no foot was found to stand" in shown(PlantingReport((), (KEPT,), (), ()))


@pytest.mark.parametrize(("met", "whole"), [((True, True), True), ((True, False), False)])
def test_it_is_met_if_every_constraint_is(met: tuple[bool, ...], whole: bool) -> None:
    assert PlantingReport((), (), (edit(True), edit(*met)), ()).met is whole


def test_json_has_all_of_it() -> None:
    data = json.loads(PlantingReport((FOOT,), (KEPT,), (edit(True),), (), ("a note",)).to_json())
    assert data["feet"][0]["worst_before"] == FOOT.worst_before
    assert data["kept"][0]["moved_time"] == KEPT.moved_time
    assert data["edits"][0]["constraints"][0]["met"] is True
    assert data["notes"] == ["a note"]
