"""2006, section 8.2 and figure 7: every step of somebody who walks around, from two templates."""

import numpy as np


def test_every_rest_of_both_feet_is_a_contact_and_no_swing_is(walking_around) -> None:
    for each in walking_around:
        assert each.rests_found() > 0.7
        fast = each.speeds > np.quantile(each.speeds, 0.6)
        assert each.held()[fast].mean() < 0.02


def test_each_step_is_a_contact_of_its_own(walking_around) -> None:
    for each in walking_around:
        pairs = list(zip(each.contacts, each.contacts[1:], strict=False))
        swings = [one for one, next in pairs if next.start - one.end > 0.3]
        assert len(swings) >= 10
        assert all(
            np.linalg.norm(next.location - one.location) > 0.05
            for one, next in pairs
            if next.start - one.end > 0.3
        )


def test_a_held_foot_stays_within_what_is_one_place(walking_around) -> None:
    for each in walking_around:
        residuals = [contact.residual for contact in each.contacts]
        assert np.median(residuals) < 0.5 * each.search.merge_distance
        assert max(residuals) < 2.0 * each.search.merge_distance


def test_they_are_drawn_for_a_person_to_judge(walking_around, draw, tell) -> None:
    path = draw(walking_around, "walking around")
    assert path.stat().st_size > 10_000
    tell(f"walking around: {path}")
