"""When an edit is solved."""

import numpy as np
import pytest

from usdmotion.errors import SceneError


def codes(text, save, read, attributes="", animation=None, header="metersPerUnit = 1", **options):
    body = text.man(edit=text.edit(attributes=attributes), animation=animation)
    return read(save(body, header=header), **options).scenes[0].time_codes.tolist()


def test_an_edit_is_solved_at_the_samples_of_its_source(text, save, read):
    animation = text.poses((-1, 2.5, 9))
    assert codes(text, save, read, animation=animation) == [-1, 2.5, 9]


def test_a_range_keeps_the_samples_inside_its_ends_and_those_on_them(text, save, read):
    span = "uniform timecode[] usdmotion:range = [2.0000005, 4]"
    assert codes(text, save, read, span) == [2, 3, 4]


def test_frames_of_the_caller_overrule_the_range(text, save, read):
    span = "uniform timecode[] usdmotion:range = [2, 4]"
    assert codes(text, save, read, span, frames=(4, 9)) == [4, 5]


def test_a_range_without_a_sample_is_refused(text, save, read):
    with pytest.raises(SceneError, match="</Man/Bones/Edit> has no sample of its source from 7"):
        codes(text, save, read, frames=(7, 9))
    with pytest.raises(SceneError, match="swap the two"):
        codes(text, save, read, frames=(4, 2))


def test_a_sample_rate_makes_even_samples_that_end_where_the_range_does(text, save, read):
    rate = "uniform double usdmotion:sampleRate = 12"
    assert codes(text, save, read, rate) == [1, 3, 5]
    assert codes(text, save, read, rate, frames=(1, 4)) == [1, 3, 4]


STILL = """uniform token[] joints = ["hip"]
float3[] translations = [(0, 1, 0)]
quatf[] rotations = [(1, 0, 0, 0)]
half3[] scales = [(1, 1, 1)]"""


def test_a_source_that_does_not_move_is_solved_on_the_frames_of_the_stage(text, save, read):
    header = "startTimeCode = 10\nendTimeCode = 16\ntimeCodesPerSecond = 48\nframesPerSecond = 24"
    assert codes(text, save, read, animation=STILL, header=header) == [10, 12, 14, 16]


def test_a_source_that_does_not_move_on_a_stage_without_range_is_one_frame(text, save, check):
    shot = check(save(text.man(animation=STILL)))
    assert shot.scenes[0].time_codes.tolist() == [0]


def test_seconds_are_counted_from_the_first_frame_that_is_solved(text, save, read):
    path = save(
        text.man(
            edit=text.edit(text.hold(attributes="uniform timecode[] usdmotion:times = [2, 4]"))
        )
    )
    (scene,) = read(path, frames=(3, 5)).scenes
    assert scene.constraints[0].times == (-1 / 24, 1 / 24)
    np.testing.assert_allclose(scene.cast.times, (0, 1 / 24, 2 / 24))
