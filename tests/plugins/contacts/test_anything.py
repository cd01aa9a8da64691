"""Whatever moves however, and whatever is asked of it: contacts are well formed."""

from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation
from usdmotion_contacts import ContactDetector
from usdmotion_contacts.pattern import constant

from usdmotion import Contact, Floats, Search, Template, configured

KINDS = ("space", "line", "point", "plane", "slide")
BLOCK = 10
"""For so many frames an object moves, or rests."""


def stop_and_go(random: np.random.Generator, count: int, size: float) -> Floats:
    """Return what wanders in steps of some size, and rests now and then, (F, 3)."""
    going = np.repeat(random.uniform(size=count // BLOCK + 1) < 0.5, BLOCK)[:count, None]
    return np.cumsum(random.normal(scale=size, size=(count, 3)) * going, axis=0)


@st.composite
def searches(draw: st.DrawFn) -> Search:
    """Draw a motion at any rate, even or not, with noise and outliers, and words about it."""
    random, count = np.random.default_rng(draw(st.integers(0, 10**6))), draw(st.integers(1, 150))
    even = np.full(count, 1.0 / draw(st.sampled_from([12.0, 24.0, 60.0, 120.0, 240.0])))
    steps = even if draw(st.booleans()) else random.uniform(0.001, 0.05, count)
    places = stop_and_go(random, count, 10.0 ** draw(st.floats(-4.0, -1.0)))
    places += random.normal(scale=10.0 ** draw(st.floats(-7.0, -2.0)), size=(count, 3))
    places[random.integers(0, count, draw(st.integers(0, 3)))] += 1.0
    vectors = stop_and_go(random, count, 10.0 ** draw(st.floats(-4.0, 0.0)))
    times = np.cumsum(steps) - steps[0]
    ends = np.sort(random.uniform(0.0, times[-1] + 0.1, (draw(st.integers(0, 2)), 2)), axis=1)
    epsilon = draw(st.none() | st.floats(1e-6, 0.1))
    return Search(
        name="thing",
        times=times,
        translations=places,
        rotations=Rotation.from_rotvec(vectors).as_quat(),
        points=random.normal(scale=0.1, size=(draw(st.integers(1, 4)), 3)),
        kinds=KINDS,
        templates=tuple(Template(draw(st.sampled_from(KINDS)), *each) for each in ends),
        pattern=None if epsilon is None else constant(draw(st.floats(1e-6, 1.0)), epsilon),
        step=draw(st.sampled_from([0.0, 0.02, 0.1])),
        gap=draw(st.sampled_from([0.0, 0.1, 0.4, 2.0])),
        gap_distance=draw(st.sampled_from([0.0, 0.05, 0.1, 1.0])),
        merge_distance=draw(st.floats(0.001, 0.3)),
        parallel_angle=draw(st.floats(0.0, 90.0)),
    )


def check(contact: Contact, times: Floats) -> None:
    """A contact lasts from one sample to a later one, and all that it says is a number."""
    assert contact.start in times
    assert contact.end in times
    assert contact.start < contact.end
    assert np.isfinite([*contact.point, *contact.location, contact.residual]).all()
    assert np.isclose(np.linalg.norm(contact.orientation), 1.0)
    assert np.isclose(np.linalg.norm(contact.axis), 1.0)


@given(searches(), st.sampled_from([1.0, 0.5]))
def test_contacts_are_well_formed_and_those_of_one_kind_do_not_overlap(search, clock) -> None:
    found = configured(ContactDetector, {"clock": clock}).detect(search)
    for kind in KINDS:
        same = [each for each in found.contacts if each.kind == kind]
        assert all(one.end < other.start for one, other in pairwise(same))
    for each in found.contacts:
        check(each, search.times)
    if found.pattern is not None:
        assert found.pattern.sigma.values.min() >= 0.0
        assert found.pattern.epsilon.values.min() >= 0.0
