"""What is held comes and goes no faster than it may be displaced."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest
from pxr import Usd

from usdmotion import Contact, Detected, pipeline, searching
from usdmotion.plugins import Host, Plugin
from usdmotion.usd.detections.easing import _PACE

RATE = 24.0
ENDS = ((1, 12), (13, 24))


@dataclass(frozen=True)
class Halves:
    """Finds that an object rests in the first half of a clip, and elsewhere in the second."""

    name: ClassVar[str] = "contacts"

    def detect(self, search):
        contacts = []
        for first, last in ENDS:
            middle = search.translations[first - 1 : last].mean(axis=0)
            contacts.append(
                Contact(
                    kind="space",
                    start=float(search.times[first - 1]),
                    end=float(search.times[last - 1]),
                    point=np.zeros(3),
                    location=middle,
                    orientation=search.rotations[0],
                )
            )
        return Detected(tuple(contacts))


@pytest.fixture
def times_after_drifting(shot, monkeypatch, tmp_path):
    """Return what gives the key times of both contacts of a foot that drifts by so much [m]."""
    known = Host((Plugin("halves", "", "halves", detectors=(Halves,)),))
    monkeypatch.setattr(searching, "host", lambda: known)

    def look(far):
        places = np.zeros((24, 3))
        places[:, 2] = np.linspace(0.0, far, 24)
        output = tmp_path / "contacts.usda"
        pipeline.detect(shot(places=places), output, joints=("foot",))
        stage = Usd.Stage.Open(str(output))
        found = [p for p in stage.Traverse() if p.GetTypeName() == "MotionContactConstraint"]
        return [
            [float(code) for code in prim.GetAttribute("usdmotion:times").Get()] for prim in found
        ]

    return look


@pytest.mark.parametrize("far", [0.02, 0.04, 0.06])
def test_places_that_follow_each_other_make_room_for_the_way_between_them(
    times_after_drifting, far
):
    one, other = times_after_drifting(far)
    way = far * 12.0 / 23.0 - far / 23.0
    assert (other[1] - one[2]) / RATE >= way / _PACE
    assert one[2] < 12 and other[1] > 13
    assert one[3] <= other[0]


def test_where_there_is_no_way_contacts_stay_as_they_are(times_after_drifting):
    one, other = times_after_drifting(1e-4)
    assert (one[1:3], other[1:3]) == ([1, 12], [13, 24])


def test_no_contact_gives_up_more_than_a_share_of_itself(times_after_drifting):
    one, other = times_after_drifting(5.0)
    assert one[2] - one[1] >= 0.5 * 11 and other[2] - other[1] >= 0.5 * 11


def test_the_ends_of_a_clip_are_no_reason_not_to_ease(times_after_drifting):
    one, other = times_after_drifting(0.02)
    assert one[0] == pytest.approx(1 - 0.2 * RATE)
    assert other[3] == pytest.approx(24 + 0.2 * RATE)
