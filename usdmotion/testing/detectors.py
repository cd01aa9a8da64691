"""The contract of a detector, one promise a function."""

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.contract import check_detector_kind
from usdmotion.curves import Spline
from usdmotion.detecting import KINDS, Contact, Detected, Detector, Search
from usdmotion.errors import OptionError
from usdmotion.kernels import conjugate, from_vector, multiply, rotate, to_vector, world_points
from usdmotion.testing.searches import STANDS, flying_search, resting_search, stepping_search
from usdmotion.testing.settings import check_limits

_TURN = np.array([0.4, -1.1, 0.7])
_SHIFT = np.array([30.0, -20.0, 50.0])


def check_detector(detector: Detector) -> None:
    """Run every check of `DETECTOR_CHECKS` on a detector.

    Raises:
        AssertionError: A promise is not kept; the sentence says which.
    """
    for check in DETECTOR_CHECKS:
        check(detector)


def check_options(detector: Detector) -> None:
    """Its options say what they are and hold to their limits."""
    check_limits(type(detector), check_detector_kind)


def check_kinds(detector: Detector) -> None:
    """It says what it cannot look for, and can look for rests."""
    try:
        detector.detect(resting_search(kinds=("riddle",)))
    except OptionError as error:
        assert "riddle" in str(error), "what refuses a kind must name it"
    else:
        raise AssertionError("a kind that there is not must be refused by an OptionError")
    assert "space" in _known(detector), "a detector must look for contacts of the kind 'space'"


def check_contacts(detector: Detector) -> None:
    """What it finds lasts from one sample to another, in order, and is finite."""
    for search in (stepping_search(), replace(stepping_search(), kinds=_known(detector))):
        found = _found(detector, search)
        starts = [each.start for each in found.contacts]
        assert starts == sorted(starts), "contacts must come in the order of their times"
        for each in found.contacts:
            _check_contact(each, search)
        for kind in search.kinds:
            same = [each for each in found.contacts if each.kind == kind]
            apart = all(one.end < other.start for one, other in pairwise(same))
            assert apart, f"contacts of the kind '{kind}' must not overlap"


def check_rest(detector: Detector) -> None:
    """What is still all the time is one contact from the first frame to the last."""
    search = resting_search()
    found = _found(detector, search)
    spans = [(each.start, each.end) for each in found.contacts]
    whole = (float(search.times[0]), float(search.times[-1]))
    assert spans == [whole], (
        f"what is still must be one contact from {whole[0]:g} to {whole[1]:g} s, not {spans}"
    )


def check_steps(detector: Detector) -> None:
    """It finds each time that an object stands still, and nothing while it moves quickly."""
    search = stepping_search()
    found = _found(detector, search)
    held = np.zeros(len(search.times), dtype=np.bool_)
    for each in found.contacts:
        held |= (search.times >= each.start - 1e-9) & (search.times <= each.end + 1e-9)
    for first, last in STANDS:
        middle = (first + last) // 2
        assert held[middle], f"what stands still at {search.times[middle]:g} s must be found"
    fast = np.linalg.norm(np.gradient(search.translations, search.times, axis=0), axis=1) > 1.0
    assert not (held & fast).any(), "what moves faster than 1 m/s must not be taken for still"


def check_flight(detector: Detector) -> None:
    """It invents nothing on an object that flies, be it tumbling or not."""
    kinds = tuple(kind for kind in ("space", "line", "point") if kind in _known(detector))
    for turns in (0.0, 9.0):
        search = replace(flying_search(turns), kinds=kinds)
        found = _found(detector, search)
        assert not found.contacts, (
            f"on what flies{' and tumbles' if turns else ''} there is no contact, but it finds a "
            f"{found.contacts[0].kind} from {found.contacts[0].start:g} to "
            f"{found.contacts[0].end:g} s"
        )


def check_repeatable(detector: Detector) -> None:
    """It gives the same for the same, and leaves what it is given as it is."""
    search = replace(stepping_search(), kinds=_known(detector))
    before = [np.array(array) for array in _arrays(search)]
    first, again = _found(detector, search), _found(detector, search)
    unchanged = all(
        np.array_equal(old, new) for old, new in zip(before, _arrays(search), strict=True)
    )
    assert unchanged, "a detector must not change the arrays that it is given"
    assert _same_bytes(first, again), "the same search must give the same bytes"


def check_frame(detector: Detector) -> None:
    """It does not care where in the world the motion is, nor which way it faces."""
    search, turn = stepping_search(), from_vector(_TURN)
    there = replace(
        search,
        translations=rotate(turn, search.translations) + _SHIFT,
        rotations=multiply(turn, search.rotations),
        up=rotate(turn, search.up),
        ground=float(search.ground + rotate(turn, search.up) @ _SHIFT),
    )
    here, elsewhere = _found(detector, search), _found(detector, there)
    _check_same_times(here, elsewhere, "a motion that is moved as a whole")
    for one, other in zip(here.contacts, elsewhere.contacts, strict=True):
        place = rotate(turn, one.location) + _SHIFT
        assert np.allclose(place, other.location, atol=1e-6), (
            "the location of a contact must move with the motion"
        )
        assert _angle(multiply(turn, one.orientation), other.orientation) < 1e-5, (
            "the orientation of a contact must turn with the motion"
        )
        assert np.allclose(one.point, other.point, atol=1e-6), (
            "the point of an object that is held must not depend on where the motion is"
        )


def check_signs(detector: Detector) -> None:
    """It does not care with which of its two signs a quaternion is written."""
    search = stepping_search()
    signs = np.where(np.arange(len(search.times)) % 3 == 0, -1.0, 1.0)[:, None]
    other = replace(search, rotations=search.rotations * signs)
    _check_same_times(
        _found(detector, search), _found(detector, other), "a motion with other signs"
    )


def check_clock(detector: Detector) -> None:
    """It does not care when the motion begins."""
    search = stepping_search()
    later = replace(search, times=search.times + 8.0)
    here, there = _found(detector, search), _found(detector, later)
    moved = [replace(each, start=each.start - 8.0, end=each.end - 8.0) for each in there.contacts]
    _check_same_times(here, replace(there, contacts=tuple(moved)), "a motion that begins later")


def check_minimum(detector: Detector) -> None:
    """It drops what lasts for less than is asked for."""
    search = replace(stepping_search(), minimum=0.7)
    found = _found(detector, search)
    shortest = min((each.end - each.start for each in found.contacts), default=1.0)
    assert shortest >= 0.7 - 1e-9, (
        f"a contact of {shortest:g} s must be dropped where 0.7 s are asked for"
    )


def check_single_frame(detector: Detector) -> None:
    """It has an answer where there is one frame only."""
    search = stepping_search()
    one = replace(
        search,
        times=search.times[:1],
        translations=search.translations[:1],
        rotations=search.rotations[:1],
    )
    _found(detector, one)


DETECTOR_CHECKS: tuple[Callable[[Detector], None], ...] = (
    check_options,
    check_kinds,
    check_contacts,
    check_rest,
    check_steps,
    check_flight,
    check_repeatable,
    check_frame,
    check_signs,
    check_clock,
    check_minimum,
    check_single_frame,
)
"""The contract, one promise each; to parametrize a test with."""


def _known(detector: Detector) -> tuple[str, ...]:
    """Return the kinds that a detector can look for."""
    known = []
    for kind in KINDS:
        try:
            detector.detect(resting_search(kinds=(kind,)))
        except OptionError:
            continue
        known.append(kind)
    return tuple(known)


def _found(detector: Detector, search: Search) -> Detected:
    found = detector.detect(search)
    assert isinstance(found, Detected), f"it must return a Detected, not {type(found).__name__}"
    for spline in (found.pattern.sigma, found.pattern.epsilon) if found.pattern else ():
        assert isinstance(spline, Spline), "a noise pattern is made of splines"
        values = spline.at(search.times)
        sound = np.isfinite(values).all() and (values >= 0.0).all()
        assert sound, "a noise pattern must be finite, and never below zero"
    return found


def _check_contact(each: Contact, search: Search) -> None:
    assert each.kind in search.kinds, f"nobody has asked for the kind '{each.kind}'"
    for time in (each.start, each.end):
        near = np.abs(search.times - time).min()
        assert near < 1e-9, f"a contact must begin and end on a sample, not at {time:g} s"
    assert each.start <= each.end, "a contact must not end before it starts"
    held = (each.point, each.location, each.orientation, each.axis, each.residual)
    finite = all(np.isfinite(value).all() for value in held)
    assert finite, "a contact must be finite"
    assert abs(np.linalg.norm(each.orientation) - 1.0) < 1e-6, (
        "the orientation of a contact must be a unit quaternion"
    )
    if each.kind not in ("space", "point"):
        assert abs(np.linalg.norm(each.axis) - 1.0) < 1e-6, "an axis must have the length one"
    if each.kind in ("space", "line", "point"):
        _check_residual(each, search)


def _check_residual(each: Contact, search: Search) -> None:
    """Measure what a contact says of itself."""
    during = (search.times >= each.start - 1e-9) & (search.times <= each.end + 1e-9)
    points = world_points(search.translations[during], search.rotations[during], each.point)
    away = float(np.linalg.norm(points - each.location, axis=1).max())
    assert away <= each.residual * (1.0 + 1e-6) + 1e-6, (
        f"the point of a {each.kind} contact is up to {away * 1e3:.3f} mm from its location, more "
        f"than its residual, {each.residual * 1e3:.3f} mm"
    )


def _check_same_times(one: Detected, other: Detected, what: str) -> None:
    spans = [
        [(each.kind, each.start, each.end) for each in found.contacts] for found in (one, other)
    ]
    same = len(spans[0]) == len(spans[1]) and all(
        first[0] == second[0] and np.allclose(first[1:], second[1:], atol=1e-9)
        for first, second in zip(*spans, strict=True)
    )
    assert same, f"{what} must have the same contacts, not {spans[1]} instead of {spans[0]}"


def _angle(one: Floats, other: Floats) -> float:
    return float(np.linalg.norm(to_vector(multiply(one, conjugate(other)))))


def _arrays(search: Search) -> tuple[Floats, ...]:
    return search.times, search.translations, search.rotations, search.points, search.up


def _same_bytes(one: Detected, other: Detected) -> bool:
    def told(found: Detected) -> list[bytes | str | float]:
        said: list[bytes | str | float] = [*found.notes]
        for each in found.contacts:
            said += [each.kind, each.start, each.end, each.residual]
            arrays = (each.point, each.location, each.orientation, each.axis)
            said += [array.tobytes() for array in arrays]
        if found.pattern:
            splines = (found.pattern.sigma, found.pattern.epsilon)
            said += [array.tobytes() for s in splines for array in (s.times, s.values, s.slopes)]
        return said

    return told(one) == told(other)
