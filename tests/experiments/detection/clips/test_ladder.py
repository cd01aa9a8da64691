"""2006, section 8.3: feet and hands of somebody who climbs a ladder, from four templates."""

import numpy as np


def test_feet_rest_on_several_rungs_and_on_the_floor(ladder) -> None:
    for each in ladder[:2]:
        heights = np.array([contact.location @ each.search.up for contact in each.contacts])
        assert np.ptp(heights) > 0.5
        levels = 1 + np.count_nonzero(np.diff(np.sort(heights)) > 0.1)
        assert levels >= 3
        assert each.rests_found() > 0.7


def test_hands_hold_on_high_above_the_floor(ladder) -> None:
    for each in ladder[2:]:
        assert len(each.contacts) > 5
        held, free = each.speeds[each.held()], each.speeds[~each.held()]
        assert np.median(held) < 0.5 * np.median(free)


def test_two_contacts_of_one_limb_never_overlap(ladder) -> None:
    for each in ladder:
        pairs = zip(each.contacts, each.contacts[1:], strict=False)
        assert all(one.end < other.start for one, other in pairs)


def test_they_are_drawn_for_a_person_to_judge(ladder, draw, tell) -> None:
    path = draw(ladder, "ladder")
    assert path.stat().st_size > 10_000
    tell(f"ladder: {path}")
