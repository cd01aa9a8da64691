"""Who is visited when: who is looked at comes first, and who has nothing to do with it apart."""

from dataclasses import replace

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from usdmotion_ccd.schedule import SWEEPS, schedule

from usdmotion import Goal, PositionConstraint, Problem
from usdmotion.testing import crowd_scene, member

HAND = "pelvis/spine/chest/right_shoulder/right_elbow/right_wrist"


def look(one, other):
    """Return what one asks for in the frame of another, or in the world."""
    goal = Goal(joint=(member(other), HAND)) if other is not None else Goal()
    return PositionConstraint(
        path=f"{member(one)}/Edit/{other}", skeleton=member(one), joint=HAND, goals=(goal,)
    )


def scheduled(count, *pairs):
    scene = crowd_scene([look(*pair) for pair in pairs], count=count, frame_count=1)
    problem = Problem.of(scene)
    return schedule(problem.cast.parents, problem.table)


def groups_of(plan):
    return [
        plan.visits[start:stop].tolist()
        for start, stop in zip(plan.first_visit, plan.first_visit[1:], strict=False)
    ]


def test_who_asks_nothing_of_each_other_is_a_group_alone():
    assert groups_of(scheduled(3)) == [[0], [1], [2]]
    assert groups_of(scheduled(3, (1, None))) == [[0], [1], [2]]


def test_who_is_looked_at_is_visited_first():
    assert groups_of(scheduled(3, (0, 1))) == [[1, 0], [2]]
    assert groups_of(scheduled(3, (0, 2), (2, 1))) == [[1, 2, 0]]
    assert groups_of(scheduled(4, (0, 3), (1, 3))) == [[3, 0, 1], [2]]


def test_who_looks_at_each_other_is_visited_again_in_the_order_of_the_cast():
    assert groups_of(scheduled(3, (1, 2), (2, 1))) == [[0], [1, 2] * SWEEPS]
    assert groups_of(scheduled(4, (3, 1), (1, 3), (0, 1))) == [[1, 3] * SWEEPS + [0], [2]]


def test_a_look_at_oneself_is_none():
    assert groups_of(scheduled(2, (0, 0))) == [[0], [1]]


def test_the_tasks_of_each_stand_in_rank_order():
    asked = [look(0, None), replace(look(1, None), priority=3), replace(look(1, 0), priority=2)]
    problem = Problem.of(crowd_scene(asked, count=2, frame_count=1))
    assert problem.table.constraint.tolist() == [0, 2, 1]
    plan = schedule(problem.cast.parents, problem.table)
    assert plan.tasks[plan.first_task[0] : plan.first_task[1]].tolist() == [0]
    assert plan.tasks[plan.first_task[1] : plan.first_task[2]].tolist() == [1, 2]
    assert plan.first_node.tolist() == [0, 17, 34]


pairs = st.tuples(st.integers(0, 5), st.integers(0, 5))


@given(st.lists(pairs, max_size=8))
def test_everybody_is_visited_and_nobody_across_groups_is_seen(looks):
    plan = scheduled(6, *looks)
    groups = groups_of(plan)
    assert sorted({one for group in groups for one in group}) == list(range(6))
    assert sum(len(set(group)) for group in groups) == 6
    for one, other in looks:
        (group,) = [each for each in groups if one in each]
        assert other in group
        # Whoever is not in a circle sees a final pose.
        if group.count(one) == 1 and one != other:
            assert max(np.flatnonzero(np.array(group) == other)) < group.index(one)
