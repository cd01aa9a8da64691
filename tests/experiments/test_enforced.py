"""Contacts that were found are held as they stand, and away from them the motion is the input's."""

import numpy as np
import pytest
from pxr import Usd

from usdmotion import demos, pipeline
from usdmotion.demos.walker import RATE, SKELETON

EDIT = f"{SKELETON}/Contacts"
AWAY = 0.25 * RATE
"""So far from a contact it is as if there were none [time codes]."""


@pytest.fixture(scope="module")
def skating(tmp_path_factory):
    """Return a walk whose feet skate, with the contacts that were found on it."""
    folder = tmp_path_factory.mktemp("enforced")
    shot = demos.build("skating", folder)
    pipeline.detect(shot, folder / "contacts.usda")
    return folder / "contacts.usda"


def test_feet_that_were_found_to_stand_do_so_once_it_is_solved(skating, solve, contacts_on):
    solved = solve(skating, SKELETON)
    found = contacts_on(skating)
    assert len(found) >= 12
    assert max(each.slide(solved.before) for each in found) > 0.008
    assert max(each.slide(solved.after) for each in found) <= 0.001
    assert solved.report.met
    assert max(solved.pops(f"{side}Leg") for side in ("Left", "Right")) <= 2.0


def test_away_from_contacts_the_motion_is_that_of_the_input(skating, solve, contacts_on, tmp_path):
    # Every foot is let go after its first contact, and comes back at its last.
    person = tmp_path / "person.usda"
    pipeline.detect(skating, person)
    stage = Usd.Stage.Open(str(person))
    for name in ("LeftFoot", "LeftToeBase", "RightFoot", "RightToeBase"):
        detection = stage.GetPrimAtPath(f"{EDIT}/{name}")
        contacts = [each for each in detection.GetChildren() if each.GetName().startswith("Cont")]
        for contact in contacts[1:-1]:
            contact.SetActive(False)
    stage.Save()
    solved = solve(person, SKELETON)
    near = np.any([each.during(solved.before, AWAY) for each in contacts_on(person)], axis=0)
    moved = np.linalg.norm((solved.after.world - solved.before.world)[:, :, 3, :3], axis=-1)
    assert 5 < np.count_nonzero(~near) and near.any()
    assert moved[~near].max() * 1e3 <= 0.1
    assert moved[near].max() > 0.005
