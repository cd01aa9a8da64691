"""The noise pattern of a detection: the same curve in USD, and whose it is."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pxr import Ts, Usd

from usdmotion import NoisePattern, Spline
from usdmotion.usd.detections.noise_patterns import author_pattern, read_pattern
from usdmotion.usd.shot import Facts

FACTS = Facts(0.01, "Y", 48.0, 24.0, None, None, "")
DETECTION = "/Man/Bones/Contacts/foot"


def detection():
    stage = Usd.Stage.CreateInMemory()
    stage.SetTimeCodesPerSecond(48.0)
    return stage, stage.DefinePrim("/Foot", "MotionDetection")


knots = st.lists(st.tuples(st.floats(0.05, 2.0), st.integers(0, 1000)), min_size=1, max_size=6).map(
    lambda pairs: (np.cumsum([gap for gap, _ in pairs]), np.array([v / 1000 for _, v in pairs]))
)


@given(knots, knots)
def test_usd_shows_the_spline_that_was_learnt_and_holds_it_flat_outside(sigma, epsilon):
    _stage, prim = detection()
    pattern = NoisePattern(Spline.through(*sigma), Spline.through(*epsilon))
    author_pattern(prim, pattern, 10.0, FACTS, estimated=False)
    seconds = np.linspace(-1.0, 14.0, 97)
    for name, spline, unit in (
        ("sigmaMax", pattern.sigma, 1.0),
        ("epsilonMax", pattern.epsilon, 0.01),
    ):
        attribute = prim.GetAttribute(f"usdmotion:{name}")
        shown = [attribute.Get(10.0 + 48.0 * each) for each in seconds]
        np.testing.assert_allclose(np.array(shown) * unit, spline.at(seconds), atol=1e-9)


def test_what_was_learnt_from_templates_is_read_as_it_was_written():
    _stage, prim = detection()
    learnt = NoisePattern(
        Spline.through(np.array([0.5, 1.0, 2.5]), np.array([0.01, 0.03, 0.02])),
        Spline.through(np.array([0.5, 1.0, 2.5]), np.array([0.001, 0.0, 0.004])),
    )
    author_pattern(prim, learnt, 10.0, FACTS, estimated=False)
    codes = 10.0 + np.arange(0.0, 200.0, 2.0)
    read = read_pattern(prim, codes, FACTS)
    seconds = (codes - 10.0) / 48.0
    np.testing.assert_allclose(read.sigma.at(seconds), learnt.sigma.at(seconds), atol=1e-12)
    np.testing.assert_allclose(read.epsilon.at(seconds), learnt.epsilon.at(seconds), atol=1e-12)


def estimated():
    stage, prim = detection()
    flat = Spline.through(np.array([0.0, 1.0]), np.array([0.01, 0.03]))
    author_pattern(prim, NoisePattern(flat, flat), 10.0, FACTS, estimated=True)
    return stage, prim


def test_an_estimate_is_estimated_anew():
    _stage, prim = estimated()
    assert read_pattern(prim, np.arange(10.0, 58.0), FACTS) is None


def test_an_estimate_that_somebody_has_changed_is_his():
    _stage, prim = estimated()
    attribute = prim.GetAttribute("usdmotion:sigmaMax")
    spline = attribute.GetSpline()
    knot = spline.GetKnot(10.0)
    knot.SetPostTanSlope(0.1)
    spline.SetKnot(knot)
    attribute.SetSpline(spline)
    assert read_pattern(prim, np.arange(10.0, 58.0), FACTS) is not None


def test_a_number_and_samples_are_a_pattern_too():
    _stage, prim = detection()
    prim.GetAttribute("usdmotion:sigmaMax").Set(0.5)
    epsilon = prim.GetAttribute("usdmotion:epsilonMax")
    epsilon.Set(1.0, 10.0)
    epsilon.Set(3.0, 12.0)
    pattern = read_pattern(prim, np.array([10.0, 11.0, 12.0]), FACTS)
    assert pattern.sigma.at(np.array([0.0, 1.0])).tolist() == [0.5, 0.5]
    times = np.array([0.0, 1.0, 2.0]) / 48.0
    np.testing.assert_allclose(pattern.epsilon.at(times), [0.01, 0.02, 0.03])


def within(body):
    return (
        f'over "Man" {{ over "Bones" {{ over "Contacts" {{ over "foot" {{\n{body}\n}}\n}}\n}}\n}}'
    )


def test_a_pattern_on_the_prim_is_what_the_detector_gets_and_is_left_alone(
    shot, detect, over, opened, still
):
    detect(shot(), "first.usda")
    said = "double usdmotion:sigmaMax = 0.3\ndouble usdmotion:epsilonMax = 2"
    report = detect(over("first.usda", within(said)), "second.usda")
    # The splines of the first layer are weaker than the numbers of the second.
    pattern = still.seen[-1].pattern
    assert pattern.sigma.at(np.array([0.1])) == pytest.approx(0.3)
    assert pattern.epsilon.at(np.array([0.1])) == pytest.approx(2.0)
    assert report.objects[0].pattern.given_by == "prim"
    layer = opened("second.usda").GetRootLayer()
    assert layer.GetAttributeAtPath(f"{DETECTION}.usdmotion:sigmaMax") is None


def test_half_a_pattern_is_told_of(shot, detect, still):
    half = """def MotionEdit "Contacts" { def MotionDetection "foot" {
        uniform token usdmotion:joint = "hips/foot"
        double usdmotion:sigmaMax = 0.3
    }
    }"""
    report = detect(shot(skeleton=half))
    assert still.seen[-1].pattern is None
    assert "has no usdmotion:epsilonMax, so its noise pattern is estimated" in report.notes[0]


def test_the_spline_stands_where_the_motion_is(shot, detect, opened):
    detect(shot())
    prim = opened().GetPrimAtPath(DETECTION)
    spline = prim.GetAttribute("usdmotion:epsilonMax").GetSpline()
    assert list(spline.GetKnots().keys()) == [1.0, 24.0]
    assert isinstance(spline, Ts.Spline)
    assert prim.GetAttribute("usdmotion:epsilonMax").Get(24.0) == pytest.approx(0.02)
