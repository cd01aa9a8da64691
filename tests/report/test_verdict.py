"""The report: errors on the plateau, measured from the motion and not told by the solver."""

import json
from dataclasses import replace

import numpy as np
import pytest
from rich.console import Console

from usdmotion import Constraint, Goal, OrientationConstraint, PositionConstraint, Problem, Solution
from usdmotion.cleaning import Cleaning, Held, Replaced
from usdmotion.kernels import from_vector
from usdmotion.report import ConstraintReport, EditReport, Report, judge
from usdmotion.testing import ARM, arm_scene

TOKEN = "base/shoulder/elbow/wrist"
OFFSET = np.array([0.0, 3e-3, 0.0])
WRIST = PositionConstraint(
    path="/Arm/Edit/wrist",
    skeleton=ARM,
    joint=TOKEN,
    goals=(Goal(mode="offset", translation=OFFSET),),
)
TURN = OrientationConstraint(
    path="/Arm/Edit/turn",
    skeleton=ARM,
    joint=TOKEN,
    priority=2,
    goals=(Goal(mode="offset", rotation=from_vector(np.radians([0.0, 5.0, 0.0]))),),
)


def rows_of(*constraints: Constraint) -> tuple[ConstraintReport, ...]:
    """Return what the input motion leaves of some constraints."""
    scene = arm_scene(constraints, frame_count=6)
    problem = Problem.of(scene)
    nothing = np.zeros(6, dtype=np.int64)
    still = Solution(problem.cast.translations, problem.cast.rotations, nothing, nothing)
    return judge(scene, problem, still)


def test_errors_are_metres_or_degrees_in_the_order_of_the_constraints() -> None:
    wrist, turn = rows_of(WRIST, TURN)
    assert (wrist.path, wrist.type, wrist.unit) == (WRIST.path, "MotionPositionConstraint", "m")
    assert wrist.max == pytest.approx(3e-3)
    assert wrist.rms == pytest.approx(3e-3)
    assert (turn.unit, turn.priority) == ("deg", 2)
    assert turn.max == pytest.approx(5.0)
    swapped = rows_of(TURN, WRIST)
    assert [row.path for row in swapped] == [TURN.path, WRIST.path]
    assert swapped[1].max == pytest.approx(3e-3)


def test_only_the_plateau_is_judged() -> None:
    growing = np.outer(np.arange(6), OFFSET)
    goal = Goal(mode="offset", translation=growing)
    (row,) = rows_of(replace(WRIST, goals=(goal,), times=(1 / 24, 4 / 24)))
    assert row.max == pytest.approx(4 * 3e-3)
    assert row.rms == pytest.approx(3e-3 * np.sqrt((1 + 4 + 9 + 16) / 4))
    assert row.worst_time == 5.0


def test_what_is_never_fully_on_has_nothing_to_be_judged_by() -> None:
    (row,) = rows_of(replace(WRIST, activity=0.5))
    assert (row.max, row.rms, row.worst_time, row.met) == (0.0, 0.0, None, True)


@pytest.mark.parametrize(
    ("constraint", "met"),
    [
        (replace(WRIST), False),
        (replace(WRIST, tolerance=2.9e-3), False),
        (replace(WRIST, tolerance=3.1e-3), True),
        (replace(WRIST, goals=(Goal(mode="offset", translation=0.3 * OFFSET),)), True),
        (TURN, False),
        (replace(TURN, tolerance=5.1), True),
    ],
)
def test_met_is_within_the_tolerance_or_else_a_millimetre_or_a_degree(
    constraint: Constraint, met: bool
) -> None:
    assert rows_of(constraint)[0].met is met


def report() -> Report:
    edit = EditReport("/Arm/Edit", ARM, "still", 6, 0.5, 60, rows_of(TURN, WRIST))
    return Report((edit,), ("beware",))


def test_a_report_is_met_where_every_constraint_is() -> None:
    assert not report().met
    assert Report(()).met
    assert Report((replace(report().edits[0], constraints=()),)).met


def test_the_json_has_these_keys_and_no_others() -> None:
    document = json.loads(report().to_json())
    assert list(document) == ["edits"]
    (edit,) = document["edits"]
    assert list(edit) == [
        "path",
        "skeleton",
        "solver",
        "frames",
        "seconds",
        "iterations",
        "constraints",
        "cleaning",
        "ground",
    ]
    assert edit["cleaning"] is None
    assert edit["ground"] is None
    assert [list(row) for row in edit["constraints"]] == 2 * [
        ["path", "type", "priority", "max", "rms", "unit", "worst_time", "met"]
    ]
    assert edit["constraints"][1]["met"] is False


def test_what_was_cleaned_is_in_the_json_too() -> None:
    held = Held("leg/foot", 2, 3e-3, 1e-3)
    cleaning = Cleaning(
        cutoff=10.0,
        low_passed=True,
        replaced=(Replaced("arm/hand", 3),),
        moved=0.004,
        moved_joint="arm/hand",
        moved_time=7.0,
        feet_known=True,
        held=(held,),
    )
    edit = replace(report().edits[0], cleaning=cleaning)
    (written,) = json.loads(Report((edit,)).to_json())["edits"]
    assert written["cleaning"] == {
        "cutoff": 10.0,
        "low_passed": True,
        "replaced": [{"joint": "arm/hand", "samples": 3}],
        "moved": 0.004,
        "moved_joint": "arm/hand",
        "moved_time": 7.0,
        "feet_known": True,
        "held": [{"joint": "leg/foot", "rests": 2, "slide_before": 3e-3, "slide_after": 1e-3}],
    }
    assert cleaning.sentence("/Edit") == (
        "</Edit> starts from a cleaned input: 3 samples are outliers and replaced (hand 3); "
        "low-passed at 10 Hz, which moves joints by at most 4.0 mm (hand at 7); foot held where at "
        "rest, sliding 1.0 mm instead of 3.0"
    )


def test_a_terminal_shows_millimetres_and_degrees_in_rank_order() -> None:
    console = Console(width=160)
    with console.capture() as caught:
        for table in report().tables():
            console.print(table)
    lines = caught.get().splitlines()
    assert "</Arm/Edit>: 6 frames by still in 500 ms, 10.0 iterations a frame" in lines[0]
    wrist = next(index for index, line in enumerate(lines) if "wrist" in line)
    turn = next(index for index, line in enumerate(lines) if "turn" in line)
    assert wrist < turn
    assert "3.000 mm" in lines[wrist] and "Position" in lines[wrist]
    assert "5.000°" in lines[turn] and "no" in lines[turn]
