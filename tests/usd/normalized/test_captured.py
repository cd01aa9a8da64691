"""Every naming and skeleton that was captured maps, or is refused with what is missing."""

import pytest

from usdmotion import pipeline
from usdmotion.errors import SceneError

CLIPS = (
    *("cmu/daz/*.bvh", "cmu/daz_hands/*.bvh", "cmu/iclone/*.bvh", "cmu/mb/[0-9]*.bvh"),
    *("cmu/mb/jump*.bvh", "other/fair*.bvh", "other/rokoko*.bvh", "other/mixamorig*.bvh"),
    *("other/mocapbank*.bvh", "odd/bvh/102_01cc*.bvh", "odd/bvh/frames_250*.bvh"),
    *("odd/bvh/makehuman*.bvh", "odd/bvh/mixed_orders_fingers*.bvh"),
    *("odd/bvh/mixed_orders_vicon*.bvh", "odd/bvh/xsens*.bvh"),
    *("usd/CesiumMan.usdz", "usd/RiggedFigure.usdz", "usd/skeleton_66.usda"),
)
NEEDED = {f"{side}_{part}" for side in "lr" for part in ("shoulder", "elbow", "hip", "knee")}
NO_BODIES = {
    "usd/SoC-ElephantWithMonochord.usdc": "because of its joint '.*/Tail'",
    "usd/RiggedSimple.usdz": "no joint of <.*> can be told to be part of a human body",
    "usd/arm_sparse_anim.usda": "no joint of </Model/Skel> can be told",
    "usd/skinnedArm.usda": "no joint of </Model/Skel> can be told",
    "usd/skel_lbs.usda": "no joint of </Root/Skeleton> can be told",
    "usd/skel_dqs.usda": "no joint of </Root/Skeleton> can be told",
    "odd/usd/twoBends.usda": "no joint of </Root/joint1> can be told",
    "odd/bvh/full_precision*.bvh": "can be told to be l_shoulder, .*r_talocrural",
    "odd/bvh/rotation_first_root*.bvh": "can be told to be l_shoulder, .*r_talocrural",
}


@pytest.fixture
def stage(mocap, tmp_path):
    """Return what makes a stage of the smallest clip of some."""

    def make(pattern):
        clip = min(mocap.glob(pattern), key=lambda each: each.stat().st_size)
        if clip.suffix != ".bvh":
            return clip
        # One file mixes two units and wants to be told.
        options = {"root_scale": 1.0} if "scale_clash" in clip.name else {}
        pipeline.import_motion(clip, tmp_path / "clip.usda", options=options)
        return tmp_path / "clip.usda"

    return make


@pytest.mark.parametrize("pattern", CLIPS)
def test_a_human_body_is_normalized(stage, tmp_path, pattern):
    shot = stage(pattern)
    (told,) = pipeline.normalize(shot, tmp_path / "clip.s4d.usda", contacts=False).motions
    assert set(told.parts) >= NEEDED
    assert 0.3 < told.leg < 1.5


@pytest.mark.parametrize("pattern", NO_BODIES)
def test_no_human_body_is_refused_in_a_sentence_and_all_else_works(stage, tmp_path, pattern):
    shot = stage(pattern)
    output = tmp_path / "clip.s4d.usda"
    with pytest.raises(SceneError, match=NO_BODIES[pattern]) as refused:
        pipeline.normalize(shot, output)
    assert str(refused.value).startswith(f"{shot}: ")
    assert "author usdmotion:parts on it" in str(refused.value)
    assert not output.exists()
    (skeleton, *_) = pipeline.inspect(shot).skeletons
    told = pipeline.detect(shot, tmp_path / "contacts.usda", joints=[skeleton.joints[-1]])
    assert told.objects


def test_a_body_of_a_few_parts_can_be_had_by_no_motion(stage, tmp_path):
    body, shot = stage("usd/skinnedArm.usda"), stage("cmu/mb/jump*.bvh")
    with pytest.raises(SceneError, match=r"skinnedArm.usda: no joint of </Model/Skel> can be"):
        pipeline.retarget(shot, body, tmp_path / "out.usda", contacts=False)
