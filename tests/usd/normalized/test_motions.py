"""Author → read → equal, on a stage of any axis, unit, rate, under any offset."""

from dataclasses import fields, replace

import numpy as np
import pytest
from pxr import Gf, Sdf, Usd, UsdGeom
from scipy.spatial.transform import Rotation

from usdmotion.errors import SceneError
from usdmotion.s4d import NormalizedMotion
from usdmotion.usd.normalized import author_normalized, read_normalized
from usdmotion.usd.stages import read_facts

CODES = np.array([1.0, 2.0, 3.5, 5.0])


def rotations(seed, *shape):
    count = int(np.prod(shape))
    return Rotation.random(count, random_state=seed).as_quat().reshape(*shape, 4)


@pytest.fixture
def motion():
    """Return four frames of anything."""
    some = np.random.default_rng(0)
    up = Rotation.from_euler("y", some.uniform(-3, 3, (4, 1))).as_quat()
    return NormalizedMotion(
        times=(CODES - 1.0) / 24.0,
        limbs=("l_hip", "r_hip", "l_shoulder"),
        limb_frames=rotations(1, 4, 3),
        limb_lengths=some.uniform(0.2, 1.0, (4, 3)),
        limb_twists=some.uniform(-1, 1, (4, 3, 2)),
        segments=("vl5", "skullbase"),
        segment_rotations=rotations(2, 4, 2),
        spine=some.uniform(-1, 1, (4, 5, 3)),
        root_position=some.uniform(-3, 3, (4, 3)),
        root_heading=up,
        root_orientation=rotations(3, 4),
        carriers=("l_radiocarpal",),
        carrier_shares=np.ones((4, 1)),
        extra_joints=("Tail",),
        extra_rotations=rotations(4, 4, 1),
        offset_joints=("Prop", "Jaw"),
        offsets=some.uniform(-1, 1, (4, 2, 3)),
    )


def stage_of(up="Y", unit=1.0, rate=24.0):
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, up)
    UsdGeom.SetStageMetersPerUnit(stage, unit)
    stage.SetTimeCodesPerSecond(rate)
    return stage


def assert_same(found, wanted):
    for field in fields(NormalizedMotion):
        one, other = getattr(found, field.name), getattr(wanted, field.name)
        if isinstance(one, tuple):
            assert one == other
        elif field.name.endswith(("frames", "rotations", "heading", "orientation")):
            np.testing.assert_allclose(np.abs((one * other).sum(axis=-1)), 1.0, atol=1e-6)
        else:
            np.testing.assert_allclose(one, other, atol=1e-6)


@pytest.mark.parametrize("up", ["Y", "Z"])
@pytest.mark.parametrize("unit", [1.0, 0.01])
def test_what_is_authored_is_read(motion, up, unit):
    stage = stage_of(up, unit)
    author_normalized(stage, "/Walk", motion, time_codes=CODES)
    found, codes = read_normalized(stage.GetPrimAtPath("/Walk"), read_facts(stage))
    np.testing.assert_array_equal(codes, CODES)
    assert_same(found, motion)


def test_up_is_the_up_of_the_stage(motion):
    stage = stage_of("Z")
    author_normalized(stage, "/Walk", motion, time_codes=CODES)
    prim = stage.GetPrimAtPath("/Walk")
    place = prim.GetAttribute("usdmotion:rootPosition").Get(CODES[0])
    heading = prim.GetAttribute("usdmotion:rootHeading").Get(CODES[0])
    assert place[2] == pytest.approx(motion.root_position[0, 1], abs=1e-6)
    assert np.allclose(heading.GetImaginary()[:2], 0.0, atol=1e-6)


def test_an_offset_and_another_rate_of_a_layer_change_codes_and_no_seconds(motion):
    beneath = stage_of()
    author_normalized(beneath, "/Walk", motion, time_codes=CODES)
    stage = stage_of(rate=48.0)
    root = stage.GetRootLayer()
    root.subLayerPaths.append(beneath.GetRootLayer().identifier)
    root.subLayerOffsets[0] = Sdf.LayerOffset(10.0)
    found, codes = read_normalized(stage.GetPrimAtPath("/Walk"), read_facts(stage))
    np.testing.assert_allclose(codes, 10.0 + 2.0 * CODES)
    assert_same(found, motion)


def test_it_is_read_between_its_samples(motion):
    stage = stage_of()
    author_normalized(stage, "/Walk", motion, time_codes=CODES)
    prim, facts = stage.GetPrimAtPath("/Walk"), read_facts(stage)
    found, _ = read_normalized(prim, facts, np.array([1.0, 1.5, 2.0]))
    between = 0.5 * (motion.root_position[0] + motion.root_position[1])
    np.testing.assert_allclose(found.root_position[1], between, atol=1e-6)


def test_a_body_without_anything_extra_says_nothing_of_it(motion):
    plain = replace(
        motion,
        carriers=(),
        carrier_shares=np.zeros((4, 0)),
        extra_joints=(),
        extra_rotations=np.zeros((4, 0, 4)),
        offset_joints=(),
        offsets=np.zeros((4, 0, 3)),
    )
    stage = stage_of()
    author_normalized(stage, "/Walk", plain, time_codes=CODES)
    prim = stage.GetPrimAtPath("/Walk")
    assert not prim.GetAttribute("usdmotion:offsets").HasAuthoredValue()
    assert_same(read_normalized(prim, read_facts(stage))[0], plain)


@pytest.mark.parametrize(
    ("name", "wrong", "said"),
    [
        ("usdmotion:limbLengths", [1.0], "has 1 values in usdmotion:limbLengths for 3 of them"),
        ("usdmotion:limbLengths", [float("nan")] * 3, "that is not a number"),
        ("usdmotion:rootHeading", Gf.Quatf(2.0), "not of length one"),
    ],
)
def test_what_does_not_fit_is_refused_by_prim_and_attribute(motion, name, wrong, said):
    stage = stage_of()
    author_normalized(stage, "/Walk", motion, time_codes=CODES)
    prim = stage.GetPrimAtPath("/Walk")
    prim.GetAttribute(name).Set(wrong, 2.0)
    with pytest.raises(SceneError, match=rf"</Walk> .*{said}"):
        read_normalized(prim, read_facts(stage))


def test_as_many_time_codes_as_frames_are_needed(motion):
    with pytest.raises(SceneError, match="3 time codes for 4 frames"):
        author_normalized(stage_of(), "/Walk", motion, time_codes=CODES[:3])
