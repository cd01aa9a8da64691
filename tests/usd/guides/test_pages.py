"""What is there for some stretches of time alone is where it is throughout each of them."""

from types import MappingProxyType

import numpy as np
import pytest
from pxr import Sdf

from usdmotion.usd.guides.pages import Page
from usdmotion.usd.guides.sheets import Sheet

CODES = np.arange(1.0, 41.0)
STRETCHES = ((3, 10), (20, 21), (25, 40))


@pytest.fixture
def page():
    nothing = MappingProxyType({})
    return Page(
        sheet=Sheet.__new__(Sheet),
        home="",
        codes=CODES,
        unit=0.01,
        size=170.0,
        up=np.array([0.0, 1.0, 0.0]),
        standings=nothing,
        homes=nothing,
        colors=nothing,
        traced=frozenset(),
    )


def shown(samples, code):
    """Return what USD shows of samples of points at a time."""
    layer = Sdf.Layer.CreateAnonymous()
    attribute = Sdf.AttributeSpec(
        Sdf.CreatePrimInLayer(layer, "/P"), "x", Sdf.ValueTypeNames.Double
    )
    for when, value in samples.items():
        layer.SetTimeSample(attribute.path, when, float(value[0, 0]))
    before, after = layer.GetBracketingTimeSamplesForPath(attribute.path, code)[1:]
    low, high = (layer.QueryTimeSample(attribute.path, each) for each in (before, after))
    return low if after == before else low + (high - low) * (code - before) / (after - before)


@pytest.mark.parametrize("moving", [False, True])
def test_places_are_those_of_their_stretch_until_its_end(page, moving):
    places = np.zeros((len(CODES), 1, 3))
    for number, (first, end) in enumerate(STRETCHES):
        places[first:end, 0, 0] = 100.0 * number
        if moving:
            places[first:end, 0, 0] += np.sin(np.arange(end - first))
    found = page.in_stretches(places, 0.001, STRETCHES)
    for first, end in STRETCHES:
        for frame in range(first, end):
            there = places[frame, 0, 0]
            np.testing.assert_allclose(shown(found, CODES[frame]), there, atol=2e-3)


def test_what_stays_in_its_only_stretch_is_said_once(page):
    places = np.ones((len(CODES), 1, 3))
    assert isinstance(page.in_stretches(places, 0.1, [(4, 20)]), np.ndarray)
