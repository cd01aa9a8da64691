"""Segments of a skeleton that follow the joints at both ends grow with what they connect."""

import numpy as np

from usdmotion.guides import segment_guide

PARENTS = np.array([-1, 0, 1, 0])
PLACES = np.array([(0.0, 1.0, 0.0), (0.1, 0.6, 0.0), (0.1, 0.1, 0.1), (0.0, 1.6, 0.0)])
TIP = np.array([(0.0, 1.8, 0.0)])


def test_every_segment_starts_at_its_joint_and_ends_at_the_next():
    guide = segment_guide(PARENTS, PLACES, np.array([3]), TIP)
    corners = guide.points.reshape(-1, 6, 3)
    assert guide.ends.tolist() == [1, 2, 3, -1]
    starts = guide.joints.reshape(-1, 6)[:, 0]
    np.testing.assert_allclose(corners[:, 0], PLACES[starts])
    np.testing.assert_allclose(corners[:3, 5], PLACES[guide.ends[:3]])
    np.testing.assert_allclose(corners[3, 5], TIP[0])


def test_its_last_point_follows_the_joint_at_its_end_if_there_is_one():
    guide = segment_guide(PARENTS, PLACES, np.array([3]), TIP)
    reaching = guide.reaching.reshape(-1, 6)
    assert (reaching[:, :5] == guide.joints.reshape(-1, 6)[:, :5]).all()
    assert reaching[:, 5].tolist() == [1, 2, 3, 3]
