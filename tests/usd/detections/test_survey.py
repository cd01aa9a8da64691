"""Of several skeletons on a stage, those that somebody points at."""

import pytest
from pxr import Usd

from usdmotion import SceneError
from usdmotion.asking import Asked
from usdmotion.usd import read_searches

OTHERS = """
def SkelRoot "Other" (references = </Man>) {
    over "Bones" {
        rel skel:animationSource = </Man/Walk>
    }
}
def SkelRoot "Nobody" {
    def Skeleton "Bones" {
        uniform token[] joints = ["hips"]
    }
}
"""


@pytest.fixture
def searches():
    """Return what tells which searches somebody asks for on a stage."""
    stages = []  # prims live as long as their stage

    def read(path, **asked):
        stages.append(Usd.Stage.Open(str(path)))
        return read_searches(stages[-1], Asked(**asked))

    return read


def test_only_the_feet_of_those_that_are_wanted(shot, searches):
    (sought,) = searches(shot(more=OTHERS), skeletons=("/Other/Bones",))
    assert sought.watched.key == ("/Other/Bones", "hips/foot")


def test_what_detections_look_at_elsewhere_is_left(shot, detect, over, searches):
    detect(shot(more=OTHERS))
    both = over("out.usda", "")
    assert len(searches(both)) == 2
    (sought,) = searches(both, skeletons=("/Man/Bones",))
    assert sought.path == "/Man/Bones/Contacts/foot"


def test_one_that_nothing_moves(shot, searches):
    with pytest.raises(SceneError, match=r"</Nobody/Bones> is no Skeleton that anything moves"):
        searches(shot(more=OTHERS), skeletons=("/Nobody/Bones",))
