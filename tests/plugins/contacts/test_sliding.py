"""Contacts that slide: exact where the motion is, in spite of noise where it is not."""

import numpy as np
import pytest
from usdmotion_contacts.pattern import constant

from usdmotion import Floats, Search, Template

RATE = 120.0
SECONDS = np.arange(481) / RATE
UP = np.array((0.0, 1.0, 0.0))
STILL = np.tile((0.0, 0.0, 0.0, 1.0), (len(SECONDS), 1))


def path() -> Floats:
    """Return a curve on the ground for a second, straight for 1.5, a curve, and then up."""
    turning = np.where((SECONDS < 1.0) | (SECONDS >= 2.5), 3.0, 0.0)
    heading = np.cumsum(turning) / RATE
    ahead = np.stack([np.cos(heading), 0.0 * heading, np.sin(heading)], axis=1)
    climb = np.clip(SECONDS - 3.5, 0.0, None)[:, None] ** 2
    return np.cumsum(0.5 / RATE * ahead, axis=0) + 0.5 * climb * UP


def search(places: Floats, *, epsilon: float = 1e-5, **fields: object) -> Search:
    return Search(**{
        "name": "puck", "times": SECONDS, "translations": places, "rotations": STILL,
        "kinds": ("plane", "slide"), "pattern": constant(1e-5, epsilon), **fields,
    })  # fmt: skip


def test_a_plane_and_a_straight_piece_of_it_are_found_exactly(detect) -> None:
    plane, slide = detect(search(path())).contacts
    assert (plane.kind, slide.kind) == ("plane", "slide")
    assert (plane.start, slide.start) == (0.0, pytest.approx(1.0, abs=0.02))
    assert plane.end == pytest.approx(3.5, abs=0.02)
    assert slide.end == pytest.approx(2.5, abs=0.02)
    assert np.allclose(plane.axis, UP, atol=1e-4)
    assert np.allclose(slide.axis, (np.cos(3.0), 0.0, np.sin(3.0)), atol=1e-3)
    assert plane.location[1] == pytest.approx(0.0, abs=1e-6)
    assert max(plane.residual, slide.residual) < 2e-5


def test_noise_and_an_outlier_cut_nothing(detect) -> None:
    places = path() + np.random.default_rng(0).normal(scale=5e-4, size=(len(SECONDS), 3))
    places[200] += 0.3
    slides = detect(search(places, epsilon=2e-3, kinds=("slide",))).contacts
    assert [each.kind for each in slides] == ["slide"]
    assert slides[0].start == pytest.approx(1.0, abs=0.1)
    assert slides[0].end == pytest.approx(2.5, abs=0.1)


def test_a_template_of_a_slide_says_how_straight_is_straight(detect) -> None:
    places = path() + np.random.default_rng(0).normal(scale=5e-4, size=(len(SECONDS), 3))
    template = (Template("slide", 1.2, 1.6),)
    found = detect(search(places, kinds=("slide",), templates=template))
    assert 5e-4 < found.pattern.epsilon.values[0] < 3e-3
    assert len(found.contacts) == 1


@pytest.mark.parametrize("epsilon", [1e-4, 1e-3, 2e-3])
def test_pieces_of_a_curve_are_not_straight_however_short(detect, epsilon) -> None:
    angles = 0.8 * SECONDS
    round_a_corner = np.stack([np.cos(angles), 0.0 * angles, np.sin(angles)], axis=1)
    helix = round_a_corner + np.outer(0.3 * SECONDS, UP)
    found = detect(search(round_a_corner, epsilon=epsilon)).contacts
    assert [each.kind for each in found] == ["plane"]
    assert not detect(search(helix, epsilon=epsilon)).contacts


def test_what_rests_and_then_leaves_does_not_slide(detect) -> None:
    since = np.clip(SECONDS - 3.0, 0.0, None)
    leaving = np.stack([since**2, 0.5 * since, 0.3 * since**3], axis=1)
    assert not detect(search(leaving, epsilon=2e-3)).contacts


def test_what_rests_does_not_slide(detect) -> None:
    assert not detect(search(0.0 * path())).contacts


def test_nobody_who_does_not_ask_gets_them(detect) -> None:
    kinds = {each.kind for each in detect(search(path(), kinds=("space", "line"))).contacts}
    assert not kinds & {"plane", "slide"}
