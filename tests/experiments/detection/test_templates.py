"""2006, sections 8.2 and 8.4: hands with two templates; a second template where one is too few."""

import numpy as np
import pytest

SPACE = ("space",)
"""The templates, and what the paper detects in its captured motions."""


@pytest.fixture(scope="module")
def hands(limbs, said, tell):
    """Return each hand that touched something with what is found with its longest stance."""
    found = {}
    for limb in limbs["parkour, hands"]:
        if limb.longest:
            found[limb.name] = limb, said(limb, templates=limb.longest)
    shares = np.array([limb.judge(answer).share for limb, answer in found.values()])
    tell(
        f"hands only: {len(found)} hands on bars, obstacles and mats, one template each: "
        f"{np.median(shares):.1%} of the judged frames are mislabelled in the median, "
        f"{shares.max():.0%} at most"
    )
    return found


def test_all_that_hands_held_on_to_is_found(hands):
    for limb, answer in hands.values():
        for stance in limb.stances:
            inside = (limb.times >= stance.start) & (limb.times <= stance.end)
            assert answer[inside].mean() > 0.5, limb.name


def test_few_frames_of_the_hands_are_mislabelled(hands):
    assert np.median([limb.judge(answer).share for limb, answer in hands.values()]) <= 0.10


@pytest.fixture(scope="module")
def pairs(limbs, said, tell):
    """Return the mislabelled frames with one template, and with each other one besides."""
    found = []
    for limb in (limb for group in limbs.values() for limb in group):
        for one in limb.stances:
            first = limb.judge(said(limb, kinds=SPACE, templates=(one,))).wrong
            for other in limb.stances:
                if other != one:
                    both = tuple(sorted((one, other), key=lambda each: each.start))
                    second = limb.judge(said(limb, kinds=SPACE, templates=both)).wrong
                    found.append((first, second))
    pairs = np.array(found)
    one, two = pairs.sum(axis=0)
    tell(f"a second template: {len(pairs)} pairs, {one} mislabelled frames become {two}")
    return pairs


def test_a_second_template_leaves_fewer_frames_mislabelled(pairs):
    one, two = pairs.sum(axis=0)
    assert two < one


def test_it_helps_most_where_the_first_was_no_good(pairs):
    bad = pairs[:, 0] > np.median(pairs[:, 0])
    one, two = pairs[bad].sum(axis=0)
    assert two < 0.92 * one
