"""Characters that are solved together, each by an edit of its own."""

import numpy as np
import pytest

ANKLE, HEAD = "hip/knee/ankle", "hip/head"
CODES = (1, 2, 3, 4, 5)


def ride(text, who, joint, translate="(0, 0, 0)", mode="position"):
    return text.goal(
        f"""rel usdmotion:space = </{who}/Bones>
        uniform token usdmotion:spaceJoint = "{joint}"
        uniform token usdmotion:mode = "{mode}" """,
        translate=translate,
    )


def lift(text, height):
    """Return an edit that lifts a head."""
    offset = text.goal('uniform token usdmotion:mode = "offset"', translate=f"(0, {height}, 0)")
    return text.edit(text.hold(offset).replace(ANKLE, HEAD))


def test_a_goal_in_the_joint_of_another_follows_it_as_it_is_solved(text, save, solve):
    ann = text.man("Ann", edit=text.edit(text.hold(ride(text, "Bob", HEAD))))
    bob = text.man("Bob", edit=lift(text, 4), animation=text.poses(seed=3), xform=text.SCALED)
    answer = solve(save(ann + bob))
    was, head = answer.both(HEAD, CODES, "/Bob/Bones")
    np.testing.assert_allclose(head - was, [(0, 8, 0)] * 5, atol=1e-3)  # scaled by two
    _, ankle = answer.both(ANKLE, CODES, "/Ann/Bones")
    np.testing.assert_allclose(ankle, head, atol=2e-3)
    assert [edit.path for edit in answer.report.edits] == ["/Ann/Bones/Edit", "/Bob/Bones/Edit"]
    assert answer.report.met


def test_alone_it_follows_the_other_as_it_is_bound(text, save, solve):
    ann = text.man("Ann", edit=text.edit(text.hold(ride(text, "Bob", HEAD))))
    bob = text.man("Bob", edit=lift(text, 4), animation=text.poses(seed=3))
    answer = solve(save(ann + bob), edits=["/Ann/Bones/Edit"])
    was, head = answer.both(HEAD, CODES, "/Bob/Bones")
    np.testing.assert_array_equal(head, was)
    _, ankle = answer.both(ANKLE, CODES, "/Ann/Bones")
    np.testing.assert_allclose(ankle, head, atol=1e-3)


def test_two_of_different_ranks_may_follow_each_other(text, save, solve):
    ann = text.man("Ann", edit=text.edit(text.hold(ride(text, "Bob", HEAD))))
    bob = text.man(
        "Bob",
        edit=text.edit(
            text.hold(
                ride(text, "Ann", ANKLE), attributes="uniform int usdmotion:priority = 2"
            ).replace(ANKLE, HEAD, 1)
        ),
        animation=text.poses(seed=3),
    )
    answer = solve(save(ann + bob))
    _, head = answer.both(HEAD, CODES, "/Bob/Bones")
    _, ankle = answer.both(ANKLE, CODES, "/Ann/Bones")
    np.testing.assert_allclose(ankle, head, atol=2e-3)
    assert answer.report.met


@pytest.mark.parametrize("first", [True, False])
def test_the_order_of_the_characters_on_the_stage_is_all_the_same(text, save, solve, first):
    ann = text.man("Ann", edit=text.edit(text.hold(ride(text, "Bob", HEAD))))
    bob = text.man("Bob", edit=lift(text, 4), animation=text.poses(seed=3))
    answer = solve(save(ann + bob if first else bob + ann))
    _, head = answer.both(HEAD, CODES, "/Bob/Bones")
    _, ankle = answer.both(ANKLE, CODES, "/Ann/Bones")
    np.testing.assert_allclose(ankle, head, atol=2e-3)


def test_two_of_one_rank_that_go_to_each_other_meet(text, save, solve):
    ann = text.man("Ann", edit=text.edit(text.hold(ride(text, "Bob", HEAD))))
    bob = text.man(
        "Bob",
        edit=text.edit(text.hold(ride(text, "Ann", ANKLE)).replace(ANKLE, HEAD, 1)),
        animation=text.poses(seed=3),
    )
    answer = solve(save(ann + bob))
    _, head = answer.both(HEAD, CODES, "/Bob/Bones")
    _, ankle = answer.both(ANKLE, CODES, "/Ann/Bones")
    np.testing.assert_allclose(ankle, head, atol=2e-3)
    moved = [
        np.abs(np.subtract(*answer.both("hip", CODES, f"/{who}/Bones"))).max()
        for who in ("Ann", "Bob")
    ]
    assert min(moved) > 0.1
    assert answer.report.met
