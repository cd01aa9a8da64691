"""Merging of rests: cut ones are one again, near but different ones stay two."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from usdmotion_contacts.pattern import constant

from usdmotion import Search

RATE = 60.0


def staying(places, *, rate: float = RATE, **fields: object) -> Search:
    """Return an object that is at some places, each for so many frames."""
    way = np.concatenate([np.tile(place, (count, 1)) for place, count in places])
    return Search(**{
        "name": "foot", "times": np.arange(len(way)) / rate, "translations": way,
        "rotations": np.tile((0.0, 0.0, 0.0, 1.0), (len(way), 1)),
        "points": np.array([(0.0, 0.0, 0.0), (0.1, 0.0, 0.0)]),
        "pattern": constant(1e-3, 1e-3), **fields,
    })  # fmt: skip


HERE, NEAR, THERE = (0.0, 0.0, 0.0), (0.02, 0.0, 0.0), (0.05, 0.0, 0.0)


def frames(detected) -> list[tuple[int, int]]:
    return [(round(each.start * RATE), round(each.end * RATE)) for each in detected.contacts]


@pytest.mark.parametrize("step", [1 / RATE, 2 / RATE, 4 / RATE])
@pytest.mark.parametrize("outliers", [1, 2, 5])
def test_a_rest_with_outliers_is_one_of_all_its_frames(detect, step, outliers) -> None:
    search = staying([(HERE, 30), ((0.5, 0.3, 0.0), outliers), (HERE, 30)], step=step)
    assert frames(detect(search)) == [(0, 59 + outliers)]
    assert np.allclose(detect(search).contacts[0].location, HERE, atol=1e-9)


@pytest.mark.parametrize("step", [1 / RATE, 2 / RATE, 4 / RATE])
def test_the_step_does_not_shorten_what_is_found(detect, step) -> None:
    search = staying([(HERE, 30), (THERE, 20), (HERE, 40)], step=step, gap=0.0)
    assert frames(detect(search)) == [(0, 29), (30, 49), (50, 89)]


def test_what_is_near_but_another_place_stays_two(detect) -> None:
    assert frames(detect(staying([(HERE, 30), (THERE, 30)]))) == [(0, 29), (30, 59)]
    assert frames(detect(staying([(HERE, 30), (NEAR, 30)]))) == [(0, 59)]
    search = staying([(HERE, 30), (NEAR, 30)], merge_distance=0.01)
    assert frames(detect(search)) == [(0, 29), (30, 59)]


def test_the_nearer_the_longer_is_bridged(detect) -> None:
    def found(place, moving: int) -> int:
        away = [((0.3 + 0.1 * i, 0.0, 0.0), 1) for i in range(moving)]
        search = staying([(HERE, 40), *away, (place, 40)], step=1 / RATE)
        return len(detect(search).contacts)

    # F_max is 24 frames, ftol(2 cm) is 12; from the last frame of one to the first of the other.
    assert [found(HERE, moving) for moving in (23, 24)] == [1, 2]
    assert [found(NEAR, moving) for moving in (11, 12)] == [1, 2]


def test_a_foot_that_turns_on_the_spot_is_not_at_one_place(detect) -> None:
    search = staying([(HERE, 60)])
    turned = Rotation.from_rotvec(np.repeat([[0.0, 0.0, 0.0], [0.0, 0.4, 0.0]], 30, axis=0))
    search = replace(search, rotations=turned.as_quat())
    assert frames(detect(search)) == [(0, 29), (30, 59)]
    assert frames(detect(replace(search, points=np.zeros((1, 3))))) == [(0, 29), (30, 59)]


def test_a_long_rest_that_drifts_is_as_many_places_as_it_needs(detect) -> None:
    drift = np.linspace(0.0, 0.3, 1200)
    search = staying([(HERE, 1200)])
    search = replace(search, translations=np.outer(drift, (1.0, 0.0, 0.0)))
    found = detect(search).contacts
    assert len(found) == pytest.approx(0.3 / (2 * 0.03), abs=1)
    assert all(each.residual <= 1.1 * 0.03 for each in found)
    ends, starts = [each.end for each in found[:-1]], [each.start for each in found[1:]]
    assert all(0.0 < start - end < 0.1 for end, start in zip(ends, starts, strict=True))


def test_what_lasts_too_shortly_is_dropped(detect) -> None:
    search = staying([(HERE, 40), (THERE, 7), (HERE, 40)], gap=0.0)
    assert len(detect(search).contacts) == 3
    assert frames(detect(replace(search, minimum=0.2))) == [(0, 39), (47, 86)]


def test_a_hole_in_the_samples_is_bridged_as_long_as_any_gap(detect) -> None:
    search = staying([(HERE, 60)])
    for hole, count in ((0.3, 1), (2.0, 2)):
        times = search.times + np.where(np.arange(60) < 30, 0.0, hole)
        assert len(detect(replace(search, times=times)).contacts) == count


def test_uneven_samples_tell_the_same_as_even_ones(detect, two_stances) -> None:
    even = two_stances()
    kept = np.sort(np.random.default_rng(0).permutation(len(even.times))[: len(even.times) // 2])
    uneven = replace(
        even, times=even.times[kept] - even.times[kept[0]],
        translations=even.translations[kept], rotations=even.rotations[kept],
    )  # fmt: skip
    one, other = detect(even).contacts, detect(uneven).contacts
    assert len(one) == len(other) == 2
    assert [each.end for each in other] == pytest.approx([each.end for each in one], abs=0.06)


@pytest.mark.parametrize("count", [0, 1, 2])
def test_a_motion_of_hardly_a_frame_has_hardly_a_contact(detect, count) -> None:
    search = staying([(HERE, count)], rate=24.0, pattern=None)
    assert len(detect(search).contacts) == (count > 1)
