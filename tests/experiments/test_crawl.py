"""2005, section 11: knees and hands carry who crawls, whatever the arms are like."""

import numpy as np
import pytest
from pxr import Usd

from usdmotion import demos, pipeline
from usdmotion.demos.acrobatics import crawl
from usdmotion.demos.crawl import ROOT, SKELETON, others
from usdmotion.demos.walker import FIRST, RATE

NAMES = tuple(member.name for member in others())
BOTH = pytest.mark.parametrize("name", NAMES)


@pytest.fixture(scope="module")
def crawling():
    return crawl()


@pytest.fixture(scope="module")
def takes(tmp_path_factory, taken, crawling):
    folder = tmp_path_factory.mktemp("crawl")
    shot, codes = demos.build("crawl", folder), FIRST + crawling.motion.times * RATE
    found = {"Crawler": taken(Usd.Stage.Open(str(shot)), SKELETON, codes)}
    for name in NAMES:
        skeleton, output = f"/{ROOT}/{name}/Skeleton", folder / f"{name}.usda"
        pipeline.retarget(shot, shot, output, motion=SKELETON, skeleton=skeleton)
        found[name] = taken(Usd.Stage.Open(str(output)), skeleton, codes)
    return found


@BOTH
def test_hands_and_knees_stay_on_the_ground_while_they_carry(takes, crawling, name):
    times, seen = crawling.motion.times, 0
    for stance in crawling.stances:
        during = (times >= stance.start - 1e-6) & (times <= stance.end + 1e-6)
        if not during.any():
            continue
        seen += 1
        own, usual = (take.point(stance.joint)[during] for take in (takes[name], takes["Crawler"]))
        assert np.linalg.norm(own - own.mean(axis=0), axis=1).max() <= 0.002
        assert np.abs(own[:, 1] - usual[:, 1]).max() <= 0.005
    assert seen >= 12


@BOTH
def test_the_root_goes_with_the_limbs_that_carry_it(takes, name):
    raised = takes[name].point("Hips")[:, 1] - takes["Crawler"].point("Hips")[:, 1]
    longer = {"LongArms": 1.0, "ShortArms": -1.0}[name]
    assert np.all(longer * raised > -0.005)
    shoulders = takes[name].point("LeftArm")[:, 1] - takes["Crawler"].point("LeftArm")[:, 1]
    assert np.mean(longer * shoulders) > 0.02


@BOTH
def test_nothing_jolts(takes, name):
    usual = max(takes["Crawler"].jolt(joint) for joint in takes["Crawler"].joints)
    assert max(takes[name].jolt(joint) for joint in takes[name].joints) <= usual + 5.0
