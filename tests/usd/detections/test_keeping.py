"""What becomes of contacts when an object is looked at again, as intervals alone."""

from hypothesis import given
from hypothesis import strategies as st

from usdmotion.usd.detections.keeping import Interval, Known, settle


def found(*spans, kind="space"):
    return [Interval(kind, *span) for span in spans]


def known(state, *span, name="Contact01", kind="space"):
    return Known(name, state, Interval(kind, *span))


def test_what_was_detected_is_written_again_where_most_of_it_is():
    settled = settle(
        [known("detected", 1, 10), known("detected", 12, 20)], found((2, 11), (12, 19))
    )
    assert settled.onto == {0: 0, 1: 1}
    assert settled.dropped == ()


def test_what_is_not_found_again_is_dropped_and_what_is_dropped_comes_back():
    assert settle([known("detected", 1, 10)], []).dropped == (0,)
    assert settle([known("dropped", 1, 10)], []).dropped == ()
    assert settle([known("dropped", 1, 10)], found((2, 9))).onto == {0: 0}


def test_a_contact_of_another_kind_is_another_contact():
    settled = settle([known("detected", 1, 10)], found((1, 10), kind="line"))
    assert settled.onto == {}
    assert settled.dropped == (0,)


def test_what_a_person_has_made_or_switched_off_keeps_out_what_it_covers():
    for state in ("own", "off"):
        assert settle([known(state, 1, 10)], found((2, 8))).left_out == {0: 0}
        # Half of the shorter one is not more than half of it.
        assert settle([known(state, 1, 10)], found((8, 12))).left_out == {}
        assert settle([known(state, 1, 10)], found((9, 30))).left_out == {}
        assert settle([known(state, 5, 5)], found((1, 9))).left_out == {0: 0}


def test_an_example_takes_what_is_found_where_it_is():
    settled = settle([known("template", 3, 9)], found((1, 4), (4, 20)))
    assert settled.onto == {1: 0}
    assert settled.left_out == {}


def test_an_example_in_which_nothing_is_found_is_what_a_person_says():
    settled = settle([known("template", 3, 9)], found((3, 9), kind="line"))
    assert settled.onto == {}
    assert settled.left_out == {0: 0}


spans = st.tuples(st.integers(0, 30), st.integers(0, 10)).map(lambda s: (s[0], s[0] + s[1]))
states = st.sampled_from(["detected", "dropped", "template", "own", "off"])
lists = st.lists(st.tuples(states, spans), max_size=6)


@given(lists, st.lists(spans, max_size=6))
def test_each_found_contact_goes_to_one_place_and_nothing_of_a_persons_is_written(old, new):
    there = [known(state, *span, name=f"C{index}") for index, (state, span) in enumerate(old)]
    settled = settle(there, found(*new))
    assert not set(settled.onto) & set(settled.left_out)
    assert len(set(settled.onto.values())) == len(settled.onto)
    assert all(there[index].state not in ("own", "off") for index in settled.onto.values())
    assert all(there[index].state == "detected" for index in settled.dropped)
    gone = {index for index, each in enumerate(there) if each.state == "detected"}
    assert gone == set(settled.dropped) | (gone & set(settled.onto.values()))


@given(st.lists(spans, max_size=6, unique=True))
def test_finding_the_same_again_changes_nothing(new):
    there = [known("detected", *span, name=f"C{index}") for index, span in enumerate(new)]
    settled = settle(there, found(*new))
    assert settled.onto == {index: index for index in range(len(new))}
    assert settled.dropped == ()
