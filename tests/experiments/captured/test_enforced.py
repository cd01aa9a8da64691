"""Contacts that were found on captured motion are held, and away from them it is the input's."""

import numpy as np
import pytest

from usdmotion import pipeline

AWAY = 0.25 * 30.0
"""So far from a contact it is as if there were none [time codes]."""


@pytest.fixture(scope="module")
def enforced(clip, solve, tmp_path_factory):
    """Return a clip with its contacts, solved with these as they are."""
    output = tmp_path_factory.mktemp("contacts") / "contacts.usda"
    pipeline.detect(clip.shot, output, minimum=0.1)
    return output, solve(output, clip.skeleton)


def test_feet_do_not_slide_where_there_was_contact(enforced, contacts_on, tell):
    path, solved = enforced
    found = contacts_on(path)
    before, after = (
        np.array([each.slide(take) for each in found]) for take in (solved.before, solved.after)
    )
    tell(f"{path.parent.name}: {len(found)} contacts slid {1e3 * before.max():.1f} mm at most")
    assert len(found) >= 2
    assert after.max() <= 0.001


def test_away_from_contacts_the_clip_is_as_it_was(enforced, contacts_on):
    path, solved = enforced
    near = np.any([each.during(solved.before, AWAY) for each in contacts_on(path)], axis=0)
    moved = np.linalg.norm((solved.after.world - solved.before.world)[:, :, 3, :3], axis=-1)
    assert moved[~near].max(initial=0.0) * 1e3 <= 0.1
