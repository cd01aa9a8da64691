"""2005, section 6: one dance on five bodies, with the dancer's own contacts as the measure."""

from itertools import pairwise

import numpy as np
import pytest
from pxr import Usd

from usdmotion import demos, pipeline
from usdmotion.demos.company import Member
from usdmotion.demos.dance_company import HEIGHT, ROOT, SKELETON, company
from usdmotion.demos.dancing import dance, stands
from usdmotion.demos.people import person
from usdmotion.demos.walker import FIRST, RATE

MEMBERS = {member.name: member for member in company()}
EVERYBODY = pytest.mark.parametrize("name", MEMBERS)
SIDES = {"Left": "l", "Right": "r"}
PARTS = {"ToeBase": "metatarsophalangeal", "Foot": "talocrural"}


@pytest.fixture(scope="module")
def dancing():
    return dance()


@pytest.fixture(scope="module")
def stage(tmp_path_factory):
    """Return the stage on which all of them dance: each call puts a layer over the one before."""
    folder = tmp_path_factory.mktemp("company")
    shot = stage = demos.build("dance_company", folder)
    for member in MEMBERS.values():
        output = folder / f"{member.name}.usda"
        skeleton = f"{member.path(ROOT)}/Skeleton"
        pipeline.retarget(shot, stage, output, motion=SKELETON, skeleton=skeleton)
        stage = output
    return Usd.Stage.Open(str(stage))


@pytest.fixture(scope="module")
def takes(stage, taken, dancing):
    times = FIRST + dancing.motion.times * RATE
    paths = {name: f"{member.path(ROOT)}/Skeleton" for name, member in MEMBERS.items()}
    return {name: taken(stage, path, times) for name, path in {**paths, "Dancer": SKELETON}.items()}


def token(member: Member, part: str) -> str:
    return member.who.skeleton.joints[member.who.parts.index(part)]


def place(take, member, part):
    return take.point(token(member, part))


def length(take, member, *parts):
    """Return the length along some parts, on each frame [m]."""
    places = [place(take, member, part) for part in parts]
    return sum(np.linalg.norm(b - a, axis=1) for a, b in pairwise(places))


def leg(take, member):
    return np.mean([length(take, member, f"{s}_hip", f"{s}_knee", f"{s}_talocrural") for s in "lr"])


@pytest.fixture(scope="module")
def dancer():
    return Member.at_rest("Dancer", person(HEIGHT))


def spans(dancing):
    """Yield each part that stands, and on which samples."""
    times = dancing.motion.times
    for name, start, end in stands(dancing):
        side = next(each for each in SIDES if name.startswith(each))
        part = f"{SIDES[side]}_{PARTS[name.removeprefix(side)]}"
        yield part, (times >= start - 1e-6) & (times <= end + 1e-6)


def steps(take, member, dancing):
    """Return how far it is from each footprint of a ball to the next, along the ground [m]."""
    prints = sorted(
        (
            (int(during.argmax()), place(take, member, part)[during].mean(axis=0))
            for part, during in spans(dancing)
            if part.endswith(PARTS["ToeBase"])
        ),
        key=lambda each: each[0],
    )
    return np.array([np.linalg.norm((b - a)[[0, 2]]) for (_, a), (_, b) in pairwise(prints)])


@EVERYBODY
def test_steps_over_legs_are_the_dancer_s(takes, dancing, dancer, name):
    member = MEMBERS[name]
    own = steps(takes[name], member, dancing) / leg(takes[name], member)
    usual = steps(takes["Dancer"], dancer, dancing) / leg(takes["Dancer"], dancer)
    # Feet are apart by the width of the hips, which is a proportion of its own.
    np.testing.assert_allclose(own, usual, rtol=0.01)


@EVERYBODY
def test_planted_feet_do_not_slide(takes, dancing, name):
    for part, during in spans(dancing):
        places = place(takes[name], MEMBERS[name], part)[during]
        assert np.linalg.norm(places - places.mean(axis=0), axis=1).max() <= 0.002


@EVERYBODY
def test_nobody_floats_or_sinks_on_any_frame(takes, name):
    who = MEMBERS[name].who
    lowest = np.min(
        [
            takes[name].point(who.skeleton.joints[joint], point)[:, 1]
            for joint, point in zip(who.sole_joints, who.sole_points, strict=True)
        ],
        axis=0,
    )
    assert np.abs(lowest).max() <= 0.005


@EVERYBODY
def test_elbows_bend_as_the_dancer_s(takes, dancer, name):
    def bend(take, member, side):
        shoulder, elbow, wrist = (
            place(take, member, f"{side}_{part}") for part in ("shoulder", "elbow", "radiocarpal")
        )
        return angle(elbow - shoulder, wrist - elbow)

    for side in "lr":
        own = bend(takes[name], MEMBERS[name], side)
        assert np.abs(own - bend(takes["Dancer"], dancer, side)).max() <= 0.5


@EVERYBODY
def test_arms_point_where_the_dancer_s_do(takes, dancer, name):
    for side in "lr":
        ways = [
            place(take, member, f"{side}_radiocarpal") - place(take, member, f"{side}_shoulder")
            for take, member in ((takes[name], MEMBERS[name]), (takes["Dancer"], dancer))
        ]
        assert angle(*ways).max() <= 1.0


def angle(a, b):
    """(F, 3), (F, 3) to (F,) [degrees]."""
    cosines = np.sum(a * b, axis=1) / np.linalg.norm(a, axis=1) / np.linalg.norm(b, axis=1)
    return np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0)))


@EVERYBODY
def test_no_knee_pops_and_nothing_jolts(takes, dancer, name):
    member = MEMBERS[name]
    for part in ("l_knee", "r_knee"):
        own, usual = (t.speed(token(m, part)).max() for t, m in pairs(takes, member, dancer, name))
        assert own <= usual + 2.0
    fastest = max(takes["Dancer"].jolt(joint) for joint in takes["Dancer"].joints)
    assert max(takes[name].jolt(joint) for joint in takes[name].joints) <= fastest + 2.0


def pairs(takes, member, dancer, name):
    return (takes[name], member), (takes["Dancer"], dancer)
