"""2006, section 9: quick taps are one contact at their own speed, and told apart when slower."""

import pytest

from usdmotion import demos, pipeline
from usdmotion.demos import taps
from usdmotion.demos.walker import FIRST


@pytest.fixture(scope="module")
def shot(tmp_path_factory):
    return demos.build("taps", tmp_path_factory.mktemp("taps"))


def found(shot, **options):
    output = shot.with_name("found.usda")
    report = pipeline.detect(shot, output, joints=["RightToeBase"], options=options)
    (ball,) = report.objects
    return [(each.start - FIRST, each.end - FIRST) for each in ball.contacts]


def test_at_its_own_speed_the_taps_are_taken_for_one_contact(shot):
    assert found(shot) == [(0, taps.downs()[-1][1])]


@pytest.mark.parametrize("clock", [0.25, 0.4])
def test_slowed_down_every_tap_is_found_and_no_other(shot, clock):
    assert found(shot, clock=clock) == taps.downs()


def test_the_demo_tells_to_slow_it_down(shot):
    assert "--option clock=" in demos.following("taps", shot)
