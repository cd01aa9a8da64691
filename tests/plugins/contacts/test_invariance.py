"""Nothing depends on where in the world a motion is, how it is turned, or when it begins."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from usdmotion_contacts.displacements import displacements
from usdmotion_contacts.projection import project

from usdmotion import Search

TURN = Rotation.from_rotvec((0.7, -1.9, 0.4))
KINDS = ("space", "line", "point", "plane", "slide")
PLACE = np.array((3.0, 1.0, -2.0))
FAR = np.array((1e4, -2e3, 7e3))


@pytest.fixture
def busy(two_stances) -> Search:
    """Return a search for everything in a noisy step between two rests."""
    return two_stances(noise=3e-4, kinds=KINDS)


def moved(search: Search, turn: Rotation, place) -> Search:
    """Return the same motion somewhere else in the world."""
    return replace(
        search,
        translations=turn.apply(np.array(search.translations)) + place,
        rotations=(turn * Rotation.from_quat(np.array(search.rotations))).as_quat(),
        up=turn.apply(np.array(search.up)),
    )


@pytest.mark.parametrize("rounds", [0, 1])
def test_a_motion_elsewhere_obeys_the_same_elsewhere(detect, busy, rounds) -> None:
    here, there = (
        detect(each, rounds=rounds).contacts for each in (busy, moved(busy, TURN, PLACE))
    )
    assert [each.kind for each in here] == [each.kind for each in there]
    for one, other in zip(here, there, strict=True):
        assert (one.start, one.end) == (other.start, other.end)
        assert np.allclose(other.location, TURN.apply(np.array(one.location)) + PLACE, atol=1e-6)
        turned = TURN * Rotation.from_quat(np.array(one.orientation))
        assert (turned.inv() * Rotation.from_quat(np.array(other.orientation))).magnitude() < 1e-6
        assert other.residual == pytest.approx(one.residual, abs=1e-6)
        if one.kind in ("line", "plane", "slide"):
            assert np.allclose(other.axis, TURN.apply(np.array(one.axis)), atol=1e-6)


@pytest.mark.parametrize("rounds", [0, 1, 2])
@pytest.mark.parametrize("shown", [True, False])
def test_the_times_of_contacts_do_not_depend_on_where_the_motion_is(
    detect, two_stances, shown, rounds
) -> None:
    """Not by a frame: what sets a limit meets it, however its last bits come out."""
    for seed in range(6, 24):
        templates = {} if shown else {"templates": ()}
        search = two_stances(noise=3e-4, kinds=KINDS, seed=seed, **templates)
        here, turned, far = (
            [(each.kind, each.start, each.end) for each in detect(one, rounds=rounds).contacts]
            for one in (
                search,
                moved(search, TURN, PLACE),
                moved(search, Rotation.identity(), FAR),
            )
        )
        assert turned == here and far == here, seed


def test_residuals_ten_kilometres_away_are_those_at_the_origin(busy) -> None:
    """2006, figures 8 and 9: the local formulation does not know where it is."""
    here = project(displacements(busy))
    there = project(displacements(moved(busy, Rotation.identity(), FAR)))
    for name in ("sigma_3", "epsilon_1", "epsilon_3"):
        one, other = getattr(here, name), getattr(there, name)
        assert np.allclose(other, one, rtol=1e-6, atol=1e-6 * np.median(one))


@pytest.mark.parametrize("rounds", [0, 1])
def test_contacts_ten_kilometres_away_are_those_at_the_origin(detect, busy, rounds) -> None:
    far = moved(busy, Rotation.identity(), FAR)
    here, there = (detect(each, rounds=rounds).contacts for each in (busy, far))
    assert [(each.kind, each.start, each.end) for each in here] == [
        (each.kind, each.start, each.end) for each in there
    ]
    for one, other in zip(here, there, strict=True):
        assert np.allclose(other.location - FAR, one.location, atol=1e-6)


def test_a_clip_that_begins_later_obeys_the_same_later(detect, busy) -> None:
    later = replace(
        busy,
        times=busy.times + 1000.0,
        templates=tuple(
            replace(each, start=each.start + 1000.0, end=each.end + 1000.0)
            for each in busy.templates
        ),
    )
    for one, other in zip(detect(busy).contacts, detect(later).contacts, strict=True):
        assert other.kind == one.kind
        assert (other.start - 1000.0, other.end - 1000.0) == pytest.approx((one.start, one.end))


def test_the_sign_of_quaternions_does_not_matter(detect, busy) -> None:
    signs = np.where(np.random.default_rng(0).uniform(size=len(busy.times)) < 0.5, -1.0, 1.0)
    flipped = detect(replace(busy, rotations=busy.rotations * signs[:, None])).contacts
    for one, other in zip(detect(busy).contacts, flipped, strict=True):
        assert (one.kind, one.start, one.end) == (other.kind, other.start, other.end)
        assert np.allclose(one.location, other.location, atol=1e-9)
        assert np.allclose(one.axis, other.axis, atol=1e-9)
