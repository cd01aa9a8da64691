"""The contract of detectors: it passes ours, and names what does not keep it."""

import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
import pytest

from usdmotion import Contact, Detected, Detector, NoisePattern, Search, Spline, option
from usdmotion.kernels import from_vector, multiply
from usdmotion.plugins import host
from usdmotion.testing import (
    DETECTOR_CHECKS,
    STANDS,
    check_detector,
    flying_search,
    resting_search,
    stepping_search,
)

CHECKS = {check.__name__: check for check in DETECTOR_CHECKS}


@pytest.mark.parametrize("detector", ["contacts", "height_and_speed"])
@pytest.mark.parametrize("name", CHECKS)
def test_our_detectors_keep_the_contract(name: str, detector: str) -> None:
    """A check asserts itself; that each can fail is what the spoiled detectors below are for."""
    CHECKS[name](host().detector(detector)())


@dataclass(frozen=True)
class Spoiled:
    """Our detector, whose answer is spoiled afterwards, or whose search is before."""

    name: ClassVar[str] = "spoiled"
    after: Callable[[Search, Detected], Detected] = lambda search, found: found
    before: Callable[[Search], Search] = lambda search: search

    def detect(self, search: Search) -> Detected:
        detector: Detector = host().detector("height_and_speed")()
        return self.after(search, detector.detect(self.before(search)))


def each(**changed: object) -> Callable[[Search, Detected], Detected]:
    """Return what gives every contact other values."""

    def spoil(search: Search, found: Detected) -> Detected:
        return replace(found, contacts=tuple(replace(c, **changed) for c in found.contacts))

    return spoil


def halved(search: Search, found: Detected) -> Detected:
    """Cut every contact in two that have one frame in common."""
    cut = []
    for contact in found.contacts:
        middle = search.times[np.searchsorted(search.times, 0.5 * (contact.start + contact.end))]
        cut += [replace(contact, end=float(middle)), replace(contact, start=float(middle))]
    return replace(found, contacts=tuple(cut))


def everything(search: Search, found: Detected) -> Detected:
    whole = Contact(
        kind="space",
        start=float(search.times[0]),
        end=float(search.times[-1]),
        point=np.zeros(3),
        location=search.translations.mean(axis=0),
        orientation=search.rotations[0],
        residual=100.0,
    )
    return replace(found, contacts=(whole,))


def noisy(search: Search, found: Detected) -> Detected:
    residual = float(np.random.default_rng().uniform(0.1, 0.2))
    return each(residual=residual)(search, found)


def worldly(search: Search, found: Detected) -> Detected:
    kept = [contact for contact in found.contacts if abs(contact.location[0]) < 10.0]
    return replace(found, contacts=tuple(kept))


def fixed_point(search: Search, found: Detected) -> Detected:
    """Tell a point of the world as one of the object."""
    return each(point=found.contacts[0].location, residual=1e3)(search, found)


def signed(search: Search) -> Search:
    """Take the other sign of a quaternion for a jump."""
    jumps = np.abs(np.diff(search.rotations, axis=0)).sum(axis=1) > 0.5
    away = np.cumsum(np.append(0.0, jumps))[:, None] * np.array([5.0, 0.0, 0.0])
    return replace(search, translations=search.translations + away)


def scribbling(search: Search) -> Search:
    search.translations.flags.writeable = True
    search.translations[0] += 1.0
    return search


def late(search: Search, found: Detected) -> Detected:
    kept = [contact for contact in found.contacts if contact.start < 5.0]
    return replace(found, contacts=tuple(kept))


def negative(search: Search, found: Detected) -> Detected:
    below = Spline.through(search.times[[0, -1]], np.array([-0.1, 0.1]))
    return replace(found, pattern=NoisePattern(below, below))


def turned(search: Search, found: Detected) -> Detected:
    """Turn every orientation away, the farther the higher up the motion is."""
    lean = from_vector(np.array([0.1 * search.translations[0, 1], 0.0, 0.0]))
    contacts = (
        replace(contact, orientation=multiply(lean, contact.orientation))
        for contact in found.contacts
    )
    return replace(found, contacts=tuple(contacts))


SPOILED = [
    ("check_kinds", Spoiled(before=lambda s: replace(s, kinds=("space",))), "must be refused"),
    ("check_contacts", Spoiled(each(start=0.001)), "begin and end on a sample, not at 0.001 s"),
    ("check_contacts", Spoiled(each(kind="line")), "nobody has asked for the kind 'line'"),
    ("check_contacts", Spoiled(each(orientation=np.ones(4))), "must be a unit quaternion"),
    ("check_contacts", Spoiled(each(location=np.ones(3) * 9)), "more than its residual"),
    ("check_contacts", Spoiled(each(residual=float("nan"))), "a contact must be finite"),
    ("check_contacts", Spoiled(halved), "of the kind 'space' must not overlap"),
    (
        "check_contacts",
        Spoiled(lambda s, f: replace(f, contacts=f.contacts[::-1])),
        "in the order of their times",
    ),
    ("check_contacts", Spoiled(negative), "must be finite, and never below zero"),
    ("check_contacts", Spoiled(lambda s, f: f.contacts), "must return a Detected, not tuple"),
    ("check_rest", Spoiled(lambda s, f: replace(f, contacts=())), "must be one contact from 0"),
    ("check_rest", Spoiled(halved), "must be one contact from 0"),
    ("check_steps", Spoiled(lambda s, f: replace(f, contacts=f.contacts[1:])), "must be found"),
    ("check_steps", Spoiled(everything), "must not be taken for still"),
    ("check_flight", Spoiled(everything), "on what flies there is no contact"),
    ("check_repeatable", Spoiled(noisy), "the same search must give the same bytes"),
    ("check_repeatable", Spoiled(before=scribbling), "must not change the arrays"),
    ("check_frame", Spoiled(worldly), "moved as a whole must have the same contacts"),
    ("check_frame", Spoiled(fixed_point), "the point of an object that is held must not depend"),
    ("check_frame", Spoiled(turned), "the orientation of a contact must turn with the motion"),
    ("check_frame", Spoiled(each(location=np.zeros(3))), "must move with the motion"),
    ("check_signs", Spoiled(before=signed), "a motion with other signs must have the same"),
    ("check_clock", Spoiled(late), "a motion that begins later must have the same contacts"),
    (
        "check_minimum",
        Spoiled(before=lambda s: replace(s, minimum=0.0)),
        "must be dropped where 0.7 s are asked for",
    ),
]


@pytest.mark.parametrize(("name", "detector", "sentence"), SPOILED)
def test_each_check_names_the_promise_that_is_broken(
    name: str, detector: Spoiled, sentence: str
) -> None:
    with pytest.raises(AssertionError, match=sentence):
        CHECKS[name](detector)


def test_a_detector_whose_options_say_nothing_is_found_out() -> None:
    @dataclass(frozen=True)
    class Silent(Spoiled):
        much: int = option(1, "")

    with pytest.raises(AssertionError, match="does not say what the option 'much' is"):
        check_detector(Silent())


def test_the_contract_runs_without_usd() -> None:
    script = (
        "import sys; sys.modules['pxr'] = None\n"
        "from usdmotion.plugins import host\n"
        "from usdmotion.testing import check_detector\n"
        "check_detector(host().detector('contacts')())\n"
        "print('kept')"
    )
    said = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert said.stdout == "kept\n", said.stderr


def test_a_search_of_each_kind_is_what_it_says() -> None:
    assert np.ptp(resting_search().translations, axis=0).max() == 0.0
    steps = stepping_search()
    speed = np.linalg.norm(np.diff(steps.translations, axis=0), axis=1)
    for first, last in STANDS:
        assert speed[first:last].max() < 1e-12
        assert steps.translations[first, 1] == pytest.approx(steps.ground)
    assert np.linalg.norm(np.diff(flying_search(9.0).translations, axis=0), axis=1).min() > 0.05
