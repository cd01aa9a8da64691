"""What a report finds is measured from the motions, and from nothing else."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion import Goal, PositionConstraint
from usdmotion.constraints import CenterOfMassConstraint
from usdmotion.report.effects import effects
from usdmotion.report.findings import findings_of
from usdmotion.testing import HUMANOID

ANKLES = ("left_ankle", "right_ankle")


def hold(outcome, name, **fields):
    token = outcome.token(name)
    path = f"{HUMANOID}/Edit/{fields.pop('path', name)}"
    return PositionConstraint(path=path, skeleton=HUMANOID, joint=token, **fields)


def test_a_result_that_is_the_input_has_changed_nothing(outcome):
    (edit,) = findings_of(outcome([hold(outcome, "left_wrist")])).edits
    assert not edit.moved.any()
    assert np.allclose(edit.turned, 0.0, atol=1e-5)
    (trace,) = edit.traces
    assert trace.verdict.met and not trace.missed.any() and not trace.errors.any()
    assert np.array_equal(edit.smoothness.before, edit.smoothness.after)
    assert np.array_equal(edit.balance.before, edit.balance.after)


def test_what_is_turned_and_moved_is_told_joint_by_joint(outcome):
    (edit,) = findings_of(outcome(turns={"left_elbow": (0.0, 0.2, 0.0)})).edits
    elbow = outcome.joints.index(outcome.token("left_elbow"))
    wrist = outcome.joints.index(outcome.token("left_wrist"))
    assert np.allclose(edit.turned[:, elbow], np.degrees(0.2))
    assert np.allclose(np.delete(edit.turned, elbow, axis=1), 0.0, atol=1e-5)
    assert np.allclose(edit.moved[:, wrist], 2 * 0.26 * np.sin(0.1))
    assert not np.delete(edit.moved, wrist, axis=1).any()


def test_traces_are_in_rank_order_and_named_without_their_edit(outcome):
    low = hold(outcome, "left_wrist", priority=7)
    high = hold(outcome, "right_wrist", priority=2)
    (edit,) = findings_of(outcome([low, high])).edits
    assert [trace.name for trace in edit.traces] == ["right_wrist", "left_wrist"]
    assert [(rank, len(traces)) for rank, traces in edit.levels] == [(2, 1), (7, 1)]


def test_a_goal_is_judged_on_its_plateau_and_active_with_its_easing(outcome):
    goal = Goal(mode="offset", translation=np.array((0.0, 0.02, 0.0)), times=(0.1, 0.3, 0.6, 0.8))
    (edit,) = findings_of(outcome([hold(outcome, "left_wrist", goals=(goal,))])).edits
    (trace,) = edit.traces
    assert np.array_equal(trace.missed, trace.plateau)
    assert trace.errors[trace.plateau] == pytest.approx(0.02)
    assert 0.0 < trace.activity[4] < 1.0 and trace.activity[0] == 0.0
    assert trace.on.all()


def test_what_is_off_asks_for_nothing(outcome):
    asked = hold(outcome, "left_wrist", activity=np.repeat((0.0, 1.0), 12))
    (edit,) = findings_of(outcome([asked])).edits
    assert np.array_equal(edit.traces[0].on, np.repeat((False, True), 12))


def test_balance_is_over_what_the_constraint_names(outcome):
    one = CenterOfMassConstraint(
        path=f"{HUMANOID}/Edit/B", skeleton=HUMANOID, supports=(outcome.token("left_ankle"),)
    )
    given = outcome([one], lift=0.1)
    (edit,) = findings_of(given).edits
    cast = given.scene.cast
    node = cast.index[HUMANOID, outcome.token("left_ankle")]
    assert np.allclose(edit.balance.support_before, cast.positions[:, node])
    assert np.allclose(edit.balance.support_after, cast.positions[:, node] + (0.0, 0.1, 0.0))
    before, after = edit.balance.away(given.scene.up)
    assert np.allclose(before, after)


def test_a_body_without_known_feet_and_supports_has_no_balance(outcome):
    given = outcome()
    nobody = tuple(replace(each, parts=None) for each in given.scene.characters)
    (edit,) = findings_of(replace(given, scene=replace(given.scene, characters=nobody))).edits
    assert edit.balance is None and edit.footings == ()


def test_three_frames_have_no_jerk(outcome):
    (edit,) = findings_of(outcome(frame_count=3)).edits
    assert edit.smoothness is None


def test_effects_are_before_and_after(outcome):
    same = outcome([hold(outcome, name) for name in ANKLES])
    (edit,) = findings_of(same).edits
    found = effects(edit, same.scene.up)
    assert [each.unit for each in found] == ["m", "m", "m/s³", "m/s³", "m/s³"]
    assert all(each.before == each.after for each in found)
    root = found[2]
    assert root.after == pytest.approx(edit.smoothness.after[:, 0].max())
