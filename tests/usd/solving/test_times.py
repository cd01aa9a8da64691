"""When an edit is solved, and what is outside."""

import numpy as np
import pytest

ANKLE = "hip/knee/ankle"
ARRAYS = ("translations", "rotations", "scales")


def edited(text, attributes, *, goal=""):
    return text.man(edit=text.edit(text.hold(text.goal(goal)), attributes=attributes))


def test_outside_the_range_of_an_edit_every_bit_is_the_source_s(text, save, solve):
    span = "uniform timecode[] usdmotion:range = [2, 4]"
    answer = solve(save(edited(text, span)))
    source = answer.old.GetPrimAtPath("/Man/Walk")
    for name in ARRAYS:
        for code in (1, 5):
            before = np.asarray(source.GetAttribute(name).Get(code)).tobytes()
            assert np.asarray(answer.result(name).Get(code)).tobytes() == before
    assert answer.report.edits[0].frames == 3
    np.testing.assert_allclose(answer.both(ANKLE, (2, 3, 4))[1], [(1, 2, 3)] * 3, atol=1e-4)


def test_a_range_and_a_rate_follow_the_offset_of_their_layer(text, save, solve):
    attributes = """uniform timecode[] usdmotion:range = [2, 4]
    uniform double usdmotion:sampleRate = 24"""
    header = "timeCodesPerSecond = 24\nmetersPerUnit = 1"
    save(edited(text, attributes), "asset.usda", header)
    body = 'def "Man" (references = @./asset.usda@</Man> (offset = 100; scale = 2)) {}'
    answer = solve(save(body, header=header))
    # Twice as slow, but sampled as often: samples of the source at 102 and 110 are outside.
    assert answer.result().GetTimeSamples() == [102, 104, 105, 106, 107, 108, 110]
    inside = (104, 105, 106, 107, 108)
    np.testing.assert_allclose(answer.both(ANKLE, inside)[1], [(1, 2, 3)] * 5, atol=1e-4)
    for code in (102, 110):
        before, after = answer.both(ANKLE, (code,))
        np.testing.assert_array_equal(after, before)


@pytest.mark.parametrize("rate", [12, 24, 30, 60])
def test_a_rate_of_samples_is_met_at_every_sample(text, save, solve, rate):
    attributes = f"uniform double usdmotion:sampleRate = {rate}"
    answer = solve(save(edited(text, attributes)))
    codes = np.arange(1.0, 5.0 + 1e-9, 24 / rate)
    np.testing.assert_allclose(answer.result().GetTimeSamples()[: len(codes)], codes, atol=1e-9)
    held = [(1, 2, 3)] * len(codes)
    np.testing.assert_allclose(answer.both(ANKLE, codes.tolist())[1], held, atol=1e-4)
    # What is asked of nobody is what USD interpolates between the samples of the source.
    head = answer.result("rotations").Get(codes[1])[3]
    source = answer.old.GetPrimAtPath("/Man/Walk").GetAttribute("rotations").Get(codes[1])[3]
    assert abs(np.dot((*head.imaginary, head.real), (*source.imaginary, source.real))) > 1 - 1e-6
