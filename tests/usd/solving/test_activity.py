"""How much of a goal, or of a constraint, is asked for: numbers, samples and splines."""

import numpy as np
import pytest

CODES = (1, 2, 3, 4, 5)
ANKLE = "hip/knee/ankle"
CHANGING = (
    "double usdmotion:activity.timeSamples = { 1: 0, 3: 1, 5: 0.25 }",
    """double usdmotion:activity.spline = {
        1: 0; post curve (0.5, 0),
        4: 1; post curve (0.5, 0),
        5: 0.5,
    }""",
)


def wanted(answer, activity, goal=(1, 2, 3)):
    """Return the original trajectory, mixed with a goal by what an attribute says at each time."""
    attribute = answer.old.GetPrimAtPath(activity).GetAttribute("usdmotion:activity")
    share = np.array([attribute.Get(code) for code in CODES])[:, None]
    before, _ = answer.both(ANKLE, CODES)
    return share, (1 - share) * before + share * np.array(goal)


@pytest.mark.parametrize("changing", CHANGING, ids=["samples", "spline"])
def test_a_goal_takes_its_part_of_the_original_trajectory(text, save, solve, changing):
    held = text.hold(text.goal(changing))
    answer = solve(save(text.man(edit=text.edit(held))))
    share, places = wanted(answer, "/Man/Bones/Edit/Hold/Goal")
    assert len(np.unique(share)) >= 4
    np.testing.assert_allclose(answer.both(ANKLE, CODES)[1], places, atol=1e-4)


@pytest.mark.parametrize("changing", CHANGING, ids=["samples", "spline"])
def test_a_constraint_that_is_partly_on_goes_part_of_the_way(text, save, solve, changing):
    held = text.hold(text.goal(), attributes=changing)
    answer = solve(save(text.man(edit=text.edit(held))))
    _, places = wanted(answer, "/Man/Bones/Edit/Hold")
    np.testing.assert_allclose(answer.both(ANKLE, CODES)[1], places, atol=1e-4)


@pytest.mark.parametrize("changing", CHANGING, ids=["samples", "spline"])
def test_a_constraint_that_is_off_leaves_every_bit(text, save, solve, changing):
    held = text.hold(text.goal(), attributes=changing)
    answer = solve(save(text.man(edit=text.edit(held))))
    source = answer.old.GetPrimAtPath("/Man/Walk")
    for name in ("translations", "rotations", "scales"):
        before = np.asarray(source.GetAttribute(name).Get(1)).tobytes()
        assert np.asarray(answer.result(name).Get(1)).tobytes() == before


def test_activities_are_read_through_the_offsets_of_layers(text, save, solve):
    held = text.hold(text.goal(CHANGING[1]))
    save(text.man(edit=text.edit(held)), "asset.usda", "metersPerUnit = 1")
    body = 'def "Man" (references = @./asset.usda@</Man> (offset = 10; scale = 2)) {}'
    answer = solve(save(body))
    codes = [10 + 2 * code for code in CODES]
    goal = answer.old.GetPrimAtPath("/Man/Bones/Edit/Hold/Goal")
    share = np.array([goal.GetAttribute("usdmotion:activity").Get(code) for code in codes])
    assert 0.0 < share[1] < share[2] < 1.0
    before, after = answer.both(ANKLE, codes)
    share = share[:, None]
    np.testing.assert_allclose(after, (1 - share) * before + share * (1, 2, 3), atol=1e-4)


def test_key_times_and_activity_are_multiplied(text, save, solve):
    keys = "uniform timecode[] usdmotion:times = [1, 3, 4, 5]"
    half = "double usdmotion:activity = 0.5"
    answer = solve(save(text.man(edit=text.edit(text.hold(text.goal(f"{keys}\n{half}"))))))
    share = 0.5 * np.array((0, 0.5, 1, 1, 0))[:, None]  # the cubic step is at a half half-way
    before, after = answer.both(ANKLE, CODES)
    np.testing.assert_allclose(after, (1 - share) * before + share * (1, 2, 3), atol=1e-4)
