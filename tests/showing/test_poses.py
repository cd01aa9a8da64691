"""Strips of a scene: its input above its result, with those who are near."""

from dataclasses import replace

import numpy as np

from usdmotion.drawing.framing import windows
from usdmotion.showing import shown, shown_before
from usdmotion.showing.poses import poses
from usdmotion.showing.shown import Actor


def test_the_input_is_above_the_result_at_the_same_places(outcome):
    given = shown(outcome(lift=0.2))
    strip = poses(given, given.edits[0], (0, 12, 23))
    assert [row.title for row in strip.rows] == ["before", "after"]
    (actor,) = given.actors
    for row, whole in zip(strip.rows, (actor.before, actor.after), strict=True):
        for frame, panel in zip((0, 12, 23), row.panels, strict=True):
            (body,) = panel.bodies
            assert body.kind == row.title
            assert np.array_equal(body.pose[0], whole[0][frame])
            assert panel.title == f"{given.scene.time_codes[frame]:g}"
    before, after = windows(strip.rows)
    assert before == after


def test_what_nobody_solved_is_one_row(outcome):
    given = shown_before(outcome().scene)
    (row,) = poses(given, given.edits[0], (0,)).rows
    assert row.panels[0].bodies[0].kind == "other"


def test_only_those_who_are_near_are_drawn_and_each_in_a_colour(outcome):
    given = shown(outcome(lift=0.2))
    (own,) = given.actors

    def beside(name, away):
        shift = np.array((away, 0.0, 0.0))
        poses = [(where + shift, turns) for where, turns in (own.before, own.after)]
        return Actor(replace(own.character, path=name), *poses)

    crowd = replace(given, actors=(beside("/Far", 30.0), own, beside("/Near", 1.0)))
    strip = poses(crowd, given.edits[0], (3,))
    for row in strip.rows:
        assert [body.number for body in row.panels[0].bodies] == [1, 2]
