"""What fighters know: each motion goes out of the guard and back, within the limits of a body."""

import numpy as np
import pytest

from usdmotion.demos.body import humanoid
from usdmotion.demos.fighters import BOUTS, fighters
from usdmotion.demos.fighting import GESTURES, HEIGHT, RATE, performed
from usdmotion.kernels import forward, to_vector


@pytest.fixture(params=GESTURES)
def gesture(request):
    return GESTURES[request.param]


def named(motion, name):
    """Return the turns of a joint, as rotation vectors [degrees]."""
    skeleton, _, _ = humanoid(HEIGHT)
    tokens = [token.rsplit("/", 1)[-1] for token in skeleton.joints]
    return np.degrees(to_vector(motion.rotations[:, tokens.index(name)]))


def test_it_is_as_long_as_its_last_moment(gesture):
    motion = performed(gesture)
    assert abs(motion.times[-1] - gesture.length) <= 0.5 / RATE


def test_it_begins_and_ends_in_the_guard(gesture):
    guard = performed(GESTURES["guard"])
    motion = performed(gesture)
    for frame in (0, -1):
        assert np.allclose(motion.rotations[frame], guard.rotations[0], atol=1e-3)
        assert np.allclose(motion.translations[frame], guard.translations[0], atol=1e-3)


def test_the_left_foot_stands(gesture):
    motion, (skeleton, _, _) = performed(gesture), humanoid(HEIGHT)
    places, _ = forward(skeleton.parents, motion.translations, motion.rotations)
    foot = next(i for i, token in enumerate(skeleton.joints) if token.endswith("LeftFoot"))
    assert np.ptp(places[:, foot], axis=0).max() < 1e-9


def test_knees_and_elbows_only_bend(gesture):
    motion = performed(gesture)
    for side, sign in (("Left", -1.0), ("Right", 1.0)):
        knee, elbow = named(motion, f"{side}Leg"), named(motion, f"{side}ForeArm")
        assert knee[:, 0].min() > 1.0
        assert knee[:, 0].max() < 150.0
        assert (sign * elbow[:, 1]).min() > 1.0
        assert (sign * elbow[:, 1]).max() < 150.0
        assert np.abs(elbow[:, [0, 2]]).max() < 1e-6


def test_everybody_moves_at_the_pace_of_his_bout_and_faces_the_other():
    everybody = fighters()
    assert len(everybody) == 2 * len(BOUTS)
    for one, other in zip(everybody[::2], everybody[1::2], strict=True):
        assert one.attacks and not other.attacks
        place, turn = one.standing("Hips")
        there, turned = other.standing("Hips")
        apart = np.linalg.norm((there - place)[[0, 2]])
        assert abs(apart - one.bout.apart) < 0.1
        # Half a turn about the up axis is between them, whoever leans how.
        assert abs(np.sum(turn * turned)) < 0.05
