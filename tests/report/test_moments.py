"""Which frames are shown, and what is marked on them."""

import numpy as np
import pytest

from usdmotion import Goal, OrientationConstraint, PositionConstraint
from usdmotion.constraints import CenterOfMassConstraint
from usdmotion.report.findings import findings_of
from usdmotion.report.moments import MOST, marks, moments
from usdmotion.testing import HUMANOID


def reach(outcome, offset, name="left_wrist", **fields):
    goal = Goal(mode="offset", translation=np.asarray(offset), times=fields.pop("times", ()))
    token = outcome.token(name)
    return PositionConstraint(
        path=f"{HUMANOID}/Edit/{name}", skeleton=HUMANOID, joint=token, goals=(goal,), **fields
    )


def moments_of(given):
    findings = findings_of(given)
    return findings, moments(findings, findings.edits[0])


def test_nothing_missed_and_nothing_changed_needs_no_look(outcome):
    assert moments_of(outcome())[1] == []


def test_the_worst_frame_of_what_is_missed_comes_first(outcome):
    offset = np.zeros((48, 3))
    offset[:, 1] = 0.01 + 0.001 * np.arange(48)
    findings, found = moments_of(outcome([reach(outcome, offset)], frame_count=48))
    assert found[0].frame == 47
    assert len(found) <= MOST
    times = findings.scene.cast.times[[moment.frame for moment in found]]
    assert np.abs(np.subtract.outer(times, times))[np.triu_indices(len(times), 1)].min() > 0.25


def test_what_is_met_is_shown_where_most_was_changed(outcome):
    _, found = moments_of(outcome(turns={"left_elbow": (0.0, 0.2, 0.0)}))
    assert [moment.trace for moment in found] == [None]


def test_more_is_missed_of_what_has_a_finer_tolerance(outcome):
    coarse = reach(outcome, (0.0, 0.05, 0.0), tolerance=0.04)
    fine = reach(outcome, (0.0, 0.02, 0.0), "right_wrist", tolerance=0.001)
    _, found = moments_of(outcome([coarse, fine]))
    assert found[0].trace.name == "right_wrist"


def test_a_mark_is_where_the_effector_is_and_where_it_is_wanted(outcome):
    given = outcome([reach(outcome, (0.0, 0.05, 0.02))])
    (mark,) = marks(findings_of(given), 7)
    node = given.scene.cast.index[HUMANOID, outcome.token("left_wrist")]
    place = given.scene.cast.positions[7, node]
    assert mark.place == pytest.approx(place)
    assert mark.wanted == pytest.approx(np.add(place, (0.0, 0.05, 0.02)))
    assert mark.has_goal


def test_what_is_along_a_free_axis_is_not_missing(outcome):
    given = outcome([reach(outcome, (0.1, 0.05, 0.0), axes="y")])
    (mark,) = marks(findings_of(given), 3)
    assert mark.wanted - mark.place == pytest.approx((0.0, 0.05, 0.0), abs=1e-12)


def test_the_mark_of_a_balance_is_the_centre_of_mass(outcome):
    balance = CenterOfMassConstraint(
        path=f"{HUMANOID}/Edit/B", skeleton=HUMANOID, supports=(outcome.token("left_ankle"),)
    )
    given = outcome([balance], turns={"pelvis": (0.3, 0.0, 0.0)})
    findings = findings_of(given)
    (mark,) = marks(findings, 5)
    assert mark.place == pytest.approx(findings.edits[0].balance.after[5])
    error = findings.edits[0].traces[0].errors[5]
    assert np.linalg.norm(mark.wanted - mark.place) == pytest.approx(error)
    assert not mark.has_goal


def test_a_turn_wants_no_place(outcome):
    turn = OrientationConstraint(
        path=f"{HUMANOID}/Edit/T", skeleton=HUMANOID, joint=outcome.token("head")
    )
    given = outcome([turn])
    (mark,) = marks(findings_of(given), 0)
    assert mark.wanted is None
