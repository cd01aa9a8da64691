"""Captured motion on hills that it was not captured on: feet stand on them, and no knee pops."""

import numpy as np
import pytest
from pxr import Sdf, Usd

from usdmotion import pipeline, usd

APART = 0.1
"""How far the points of the hills are apart [m]."""
HIGHEST = {"talocrural": 0.15, "metatarsophalangeal": 0.05}
"""What a foot is at most from its sole to its ankle, and to its ball [m]."""
OWN = 0.02
"""What stands so much higher than the others may have stood on something of its own [m]."""


def hills(across):
    """Return how high the hills are at places along the ground [m], (…, 2) to (…)."""
    x, y = across[..., 0], across[..., 1]
    waves = 0.05 * np.sin(1.9 * x + 0.4) * np.cos(1.6 * y)
    return waves + 0.04 * np.sin(1.2 * y + 0.5 * x)


class Hills:
    """A mesh of hills around a clip."""

    def __init__(self, clip):
        self.up = int(np.argmax(clip.up))
        self.along = [axis for axis in range(3) if axis != self.up]
        places = clip.take.world[:, :, 3][..., self.along]
        low, high = places.min(axis=(0, 1)) - 1.0, places.max(axis=(0, 1)) + 1.0
        counts = np.ceil((high - low) / APART).astype(int) + 1
        a, b = np.meshgrid(*map(np.linspace, low, high, counts), indexing="ij")
        flat = np.stack([a, b], axis=-1).reshape(-1, 2)
        self.points = np.insert(flat, self.up, hills(flat), axis=1)
        index = np.arange(len(flat)).reshape(a.shape)
        corners = (index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:])
        self.faces = np.stack([each.ravel() for each in corners], axis=1).tolist()

    def height(self, places):
        return hills(places[:, self.along])


@pytest.fixture(scope="module")
def climbed(clip, solve, contacts_on, tmp_path_factory):
    """Return a clip on hills, its contacts as they were found before, and the hills."""
    tmp_path = tmp_path_factory.mktemp("hills")
    contacts, shot = tmp_path / "contacts.usda", tmp_path / "hills.usda"
    pipeline.detect(clip.shot, contacts, options={"rounds": 1}, minimum=0.1, guides=False)
    layer, made = Sdf.Layer.CreateNew(str(shot)), Hills(clip)
    layer.subLayerPaths.append(str(contacts))
    source, stage = Usd.Stage.Open(str(contacts)), Usd.Stage.Open(layer)
    for name in ("metersPerUnit", "upAxis", "timeCodesPerSecond", "framesPerSecond"):
        stage.SetMetadata(name, source.GetMetadata(name))
    stage.SetStartTimeCode(clip.frames[0])
    stage.SetEndTimeCode(clip.frames[1])
    usd.author_mesh(stage, "/Hills", made.points, made.faces, color=(0.4, 0.5, 0.3))
    layer.Save()
    solved = solve(shot, clip.skeleton, frames=clip.frames, ground=["/Hills"])
    first, last = clip.frames
    found = [
        each for each in contacts_on(contacts) if first <= each.keys[1] <= each.keys[2] <= last
    ]
    return solved, found, made


def over_ground(take, each, made):
    """Return how high what a contact holds is over the hills while it holds [m]."""
    places = take.point(each.joint, each.point)[each.during(take)]
    return places[:, made.up] - made.height(places)


@pytest.mark.parametrize("part", ["talocrural", "metatarsophalangeal"])
def test_feet_stand_on_hills_as_they_stood_on_level_ground(climbed, clip, part):
    solved, found, made = climbed
    joints = [clip.parts.joint(f"{side}_{part}") for side in "lr"]
    tokens = [clip.recording.skeleton.joints[each] for each in joints if each is not None]
    held = [each for each in found if each.joint in tokens]
    for each in held:
        assert each.slide(solved.after) <= 2e-3
    if not held:
        pytest.skip(f"no contact of a {part} was found here")
    over = [over_ground(solved.after, each, made) for each in held]
    # Whatever it stood on: nothing is under the hills, and not all of it is in the air.
    lowest = min(each.min() for each in over)
    assert -5e-3 <= lowest <= HIGHEST[part]
    source = [clip.take.point(each.joint)[each.during(clip.take), made.up].mean() for each in held]
    usual = np.abs(source - np.median(source)) <= OWN
    same = [each for each, is_usual in zip(over, usual, strict=True) if is_usual]
    # As high over the hills as over the level ground that they were captured on. Where the feet of
    # a capture stand at no common height, they are brought to the ground that there is now.
    level = np.median(source) - solved.report.edits[0].ground.made_on
    off = np.concatenate(same) - level if same else np.zeros(1)
    # Where there is a ball it is what stands, and an ankle goes up and down about it.
    stands = part == "metatarsophalangeal" or clip.parts.joint("l_metatarsophalangeal") is None
    assert off.min() >= (-5e-3 if stands else -1.5e-2)
    # Where an ankle cannot be bent as far as the hill is steep, the heel is in the air.
    assert part == "talocrural" or off.max() <= 5e-3


def test_no_knee_pops_and_what_is_not_of_the_legs_keeps_its_posture(climbed, clip):
    solved, _, _ = climbed
    for side in "lr":
        assert solved.pops(clip.token(f"{side}_knee")) <= 2.0
    legs = [clip.token(f"{side}_hip") for side in "lr"]
    rest = [name for name in solved.before.joints if not name.startswith(tuple(legs))]
    assert max(solved.turned(name) for name in rest) <= 5.0
