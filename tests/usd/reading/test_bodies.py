"""What a body weighs: as its Skeleton says, else as bodies do."""

import numpy as np

from usdmotion import usd
from usdmotion.demos.gait import walk
from usdmotion.demos.walker import FIRST, RATE, SKELETON
from usdmotion.motion import Body
from usdmotion.plugins import host


def written(path, body, parts=()):
    walking = walk(seconds=0.25)
    codes = FIRST + np.round(walking.motion.times * RATE)
    with usd.new_stage(
        path, frame_rate=RATE, first=float(codes[0]), last=float(codes[-1]), root="Walker"
    ) as stage:
        usd.author_character(
            stage,
            "/Walker",
            walking.skeleton,
            body,
            walking.motion,
            parts,
            time_codes=codes,
        )
        usd.author_edit(stage, f"{SKELETON}/Edit")
        stage.DefinePrim(f"{SKELETON}/Edit/Balance", "MotionCenterOfMassConstraint")
    return usd.read(path, kinds=host().constraints).scenes[0]


def test_authored_masses_are_kept(tmp_path):
    body = walk(seconds=0.25).body
    scene = written(tmp_path / "own.usda", body)
    np.testing.assert_allclose(scene.characters[0].body.masses, body.masses, rtol=1e-6)
    assert scene.characters[0].masses_from == "authored"
    assert scene.notes == ()


def test_without_masses_a_body_weighs_what_bodies_do_and_it_is_said(tmp_path):
    own = walk(seconds=0.25).body
    scene = written(tmp_path / "bare.usda", Body.unknown(len(own.masses)))
    (walker,) = scene.characters
    assert walker.masses_from == "anthropometric table"
    shares = own.masses / own.masses.sum()
    assert np.abs(walker.body.masses / walker.body.masses.sum() - shares).max() < 0.12
    (note,) = scene.notes
    assert f"<{SKELETON}>" in note
    assert "author usdmotion:masses" in note
