"""Joint limits stand above every priority, also where a goal is out of reach for them."""

import re

import numpy as np
import pytest
from pxr import Usd
from scipy.spatial.transform import Rotation

from usdmotion.demos import limits
from usdmotion.demos.walker import SKELETON

STANDING = ("LeftFoot", "LeftToeBase")
KEPT = 0.01


@pytest.fixture(scope="module")
def shot(tmp_path_factory):
    output = tmp_path_factory.mktemp("limits") / "limits.usda"
    limits.build(output)
    return output


@pytest.fixture(scope="module")
def solved(shot, solve):
    return solve(shot, SKELETON)


@pytest.fixture(scope="module")
def there(solved):
    _, start, end, _ = limits.FRAMES
    return (solved.after.times >= start) & (solved.after.times <= end)


def turned_from_rest(shot, take):
    """Return the rotation vectors from rest [degrees], and the limits as they are authored."""
    stage = Usd.Stage.Open(str(shot))
    prim = stage.GetPrimAtPath(SKELETON)
    rest = [each.ExtractRotationQuat() for each in prim.GetAttribute("restTransforms").Get()]
    vectors = np.empty((*take.local.shape[:2], 3))
    for joint, quaternion in enumerate(rest):
        back = Rotation.from_quat((*quaternion.imaginary, quaternion.real)).inv()
        turns = back * Rotation.from_quat(take.local[:, joint])
        vectors[:, joint] = np.degrees(turns.as_rotvec())
    low, high = (prim.GetAttribute(f"usdmotion:limits{each}").Get() for each in ("Min", "Max"))
    return vectors, np.array(low), np.array(high)


def test_no_limit_is_exceeded_on_any_frame(shot, solved):
    vectors, low, high = turned_from_rest(shot, solved.after)
    assert np.isfinite(low).sum() + np.isfinite(high).sum() == 24
    assert np.maximum(low - vectors, vectors - high).max() <= KEPT


def test_the_input_exceeds_one_and_it_is_said(shot, solved):
    vectors, low, high = turned_from_rest(shot, solved.before)
    beyond = np.maximum(low - vectors, vectors - high).max(axis=2)
    knee = solved.before.index("RightLeg")
    (note,) = solved.report.notes
    told = re.search(r"RightLeg by up to ([\d.]+)° on (\d+) of (\d+) frames", note)
    assert float(told[1]) == pytest.approx(beyond[:, knee].max(), abs=0.01)
    assert int(told[2]) == (beyond[:, knee] > KEPT).sum()
    assert int(told[3]) == len(solved.before.times)
    assert np.delete(beyond, knee, axis=1).max() <= KEPT


def test_knee_and_elbow_are_at_their_limits_where_their_goals_are_too_near(shot, solved, there):
    vectors, _, high = turned_from_rest(shot, solved.after)
    knee, elbow = solved.after.index("RightLeg"), solved.after.index("LeftForeArm")
    assert np.abs(vectors[there, knee, 0] - limits.KNEE).max() <= KEPT
    assert np.abs(vectors[there, elbow, 1] + limits.ELBOW).max() <= KEPT
    assert high[knee, 0] == limits.KNEE


def test_the_limbs_point_at_the_goals_that_they_do_not_reach(solved, there):
    for joint, root, frame, goal in (
        ("RightFoot", "RightUpLeg", "Hips", limits.AT_HIP),
        ("LeftHand", "LeftArm", "Spine2", limits.AT_SHOULDER),
    ):
        end, start = (solved.after.seen_from(frame, name)[there] for name in (joint, root))
        wanted = goal - start
        asked = np.linalg.norm(wanted, axis=1)
        along = np.sum((end - start) * wanted, axis=1) / asked
        across = (end - start) - along[:, None] * wanted / asked[:, None]
        assert (along - asked).min() >= 0.1
        assert solved.millimetres(across) <= 0.1


def test_what_can_be_met_is_met(solved, there):
    for name in STANDING:
        assert solved.moved(name) <= 0.01
    missed = solved.after.point("RightHand") - solved.before.point("RightHand") - limits.ASIDE
    assert solved.millimetres(missed[there]) <= 0.01


def test_no_joint_jumps(solved):
    for name in ("RightUpLeg", "RightLeg", "LeftArm", "LeftForeArm", "RightArm", "RightForeArm"):
        assert solved.pops(name) <= 2.0


def test_joints_that_nobody_recruits_equal_the_input(solved):
    for name in ("Head", "Neck", "LeftHand", "RightHand", "RightFoot"):
        index = solved.before.index(name)
        assert np.array_equal(solved.after.local[:, index], solved.before.local[:, index])
