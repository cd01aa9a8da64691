"""Contacts of an ankle and of the ball of its foot hold together, as they are written."""

import numpy as np
import pytest
from pxr import Gf, Usd

from usdmotion import demos, pipeline, usd
from usdmotion.constraints import built_in
from usdmotion.curves import ease
from usdmotion.kernels import conjugate, rotate

BALL, ANKLE = "LeftToeBase", "LeftFoot"


@pytest.fixture(scope="module")
def looked_at(tmp_path_factory):
    """Return what writes the contacts of some joints of a walk whose feet skate, and reads them."""
    folder = tmp_path_factory.mktemp("agreeing")
    demos.build("skating", folder)

    def look(*joints, shot="skating.usda", output="contacts.usda"):
        pipeline.detect(folder / shot, folder / output, joints=joints)
        (scene,) = usd.read(folder / output, kinds=built_in()).scenes
        contacts = scene.edits[0].constraints
        return scene, {
            leaf: [each for each in contacts if each.joint.endswith(leaf)] for leaf in (ANKLE, BALL)
        }

    look.folder = folder
    return look


@pytest.fixture(scope="module")
def feet(looked_at):
    """Return the scene, and the contacts of the left ankle and ball."""
    return looked_at()


def together(feet):
    """Return the pairs of a contact of the ankle and one of the ball that both hold at a time."""
    pairs = [
        (ankle, ball)
        for ankle in feet[ANKLE]
        for ball in feet[BALL]
        if min(ankle.times[2], ball.times[2]) >= max(ankle.times[1], ball.times[1])
    ]
    assert len(pairs) >= 2
    return pairs


def ball_in_foot(scene):
    cast = scene.cast
    ankle, ball = (
        next(i for i, (_, token) in enumerate(cast.joints) if token.endswith(f"/{leaf}"))
        for leaf in (ANKLE, BALL)
    )
    return rotate(
        conjugate(cast.orientations[0, ankle]), cast.positions[0, ball] - cast.positions[0, ankle]
    )


def test_a_foot_that_is_held_has_its_ball_where_that_is_held(feet):
    scene, contacts = feet
    offset = ball_in_foot(scene)
    for ankle, ball in together(contacts):
        carried = ankle.location + rotate(ankle.orientation, offset)
        assert np.abs(carried - ball.location).max() < 1e-6


def test_what_is_longer_stays_where_it_was_found(feet, looked_at):
    alone = looked_at(BALL, output="ball.usda")[1][BALL]
    for one, other in zip(alone, feet[1][BALL], strict=True):
        assert np.abs(one.location - other.location).max() < 1e-9


def test_what_was_moved_says_how_far_the_motion_is_from_it(feet):
    scene, contacts = feet
    node = next(i for i, (_, t) in enumerate(scene.cast.joints) if t.endswith(f"/{ANKLE}"))
    for each in contacts[ANKLE]:
        held = ease(scene.times, each.times[1:3]) > 0.0
        apart = np.linalg.norm(scene.cast.positions[held, node] - each.location, axis=1)
        assert each.residual == pytest.approx(apart.max(), abs=1e-6)


def test_the_ball_does_not_ease_while_the_foot_is_held_and_ranks_above_it(feet):
    for ankle, ball in together(feet[1]):
        assert ball.priority < ankle.priority
        t0, t1, t2, t3 = ball.times
        for eased, at in ((t1 - t0, t1), (t3 - t2, t2)):
            if ankle.times[1] - 1e-6 <= at <= ankle.times[2] + 1e-6:
                assert eased < 1e-6


def test_a_foot_alone_is_as_it_was_found(looked_at):
    alone = looked_at(ANKLE, output="ankle.usda")[1][ANKLE]
    assert {each.priority for each in alone} == {1}
    assert all(each.times[0] < each.times[1] for each in alone)


def test_detecting_again_changes_nothing(looked_at):
    before = looked_at()[1]
    after = looked_at(shot="contacts.usda", output="again.usda")[1]
    for leaf in (ANKLE, BALL):
        for one, other in zip(before[leaf], after[leaf], strict=True):
            assert (one.path, one.priority) == (other.path, other.priority)
            assert one.times == pytest.approx(other.times)
            assert np.abs(one.location - other.location).max() < 1e-9


def test_what_a_person_moves_takes_what_it_carries_along(looked_at):
    before = looked_at(output="person.usda")[1]
    person = looked_at.folder / "person.usda"
    stage = Usd.Stage.Open(str(person))
    location = stage.GetAttributeAtPath(f"{before[ANKLE][1].path}.usdmotion:location")
    location.Set(location.Get() + Gf.Vec3d(3.0, 0.0, 5.0))
    stage.Save()
    after = looked_at(shot="person.usda", output="again.usda")[1]
    moved = np.array([0.03, 0.0, 0.05])
    carried = [ball for ankle, ball in together(before) if ankle is before[ANKLE][1]]
    assert carried
    for one, other in zip(before[BALL], after[BALL], strict=True):
        along = moved if one in carried else 0.0
        assert np.abs(other.location - one.location - along).max() < 1e-6
    assert np.abs(after[ANKLE][1].location - before[ANKLE][1].location - moved).max() < 1e-9
