"""Which limbs carry the root, and how high they hold it on other bodies."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from usdmotion.arrays import Floats
from usdmotion.demos.body import Proportions
from usdmotion.kernels import forward, from_vector
from usdmotion.motion import Motion, Placement
from usdmotion.s4d import Held, Morphology, carriers_of, normalize, restore
from usdmotion.s4d.carrying import carried_heights

from .conftest import UP, built

TIMES = np.arange(121) / 30.0
FEET = [("l_talocrural", 0.0, 2.0), ("r_metatarsophalangeal", 0.0, 2.0)]
KNEES = [("l_knee", 0.0, 4.0), ("r_knee", 0.0, 4.0)]
HANDS = [("l_radiocarpal", 2.5, 4.0), ("r_metacarpophalangeal_3", 2.5, 4.0)]
PARTS = ("talocrural", "knee", "radiocarpal", "elbow", "shoulder")


def told(held: list[Held]) -> dict[str, Floats]:
    carriers, shares = carriers_of(TIMES, held)
    return dict(zip(carriers, shares.T, strict=True))


def test_who_walks_is_carried_by_the_ankles() -> None:
    assert not told(FEET)
    assert not told([])
    assert not told([("skullbase", 0.0, 1.0)])


def test_hands_do_not_carry_who_stands() -> None:
    holding_a_rail = [("l_radiocarpal", 0.0, 4.0)]
    assert not told([("l_talocrural", 0.0, 4.0), *holding_a_rail])


def test_a_handstand_passes_from_ankles_to_wrists() -> None:
    shares = told([*FEET, *HANDS])
    assert np.allclose(shares["l_talocrural"][:45], 0.5)
    assert np.allclose(shares["r_radiocarpal"][-30:], 0.5)
    assert max(np.abs(np.diff(share)).max() for share in shares.values()) < 0.05


def test_crawling_is_on_knees_and_wrists_in_equal_parts() -> None:
    one_hand_lifted = [("l_radiocarpal", 0.0, 4.0), ("r_radiocarpal", 1.0, 3.0)]
    toes_on_the_ground = [("l_talocrural", 0.0, 4.0), ("r_talocrural", 0.0, 4.0)]
    shares = told([*KNEES, *one_hand_lifted, *toes_on_the_ground])
    assert set(shares) == {"l_knee", "r_knee", "l_radiocarpal", "r_radiocarpal"}
    assert np.allclose(shares["l_knee"] + shares["r_knee"], 0.5)
    assert np.allclose(shares["l_radiocarpal"][:20], 0.5)


@given(
    st.lists(
        st.tuples(
            st.sampled_from([f"{side}_{part}" for side in "lr" for part in PARTS]),
            st.floats(-1.0, 5.0),
            st.floats(0.0, 3.0),
        ),
        max_size=8,
    )
)
def test_shares_add_up_and_pass_smoothly(spans: list[tuple[str, float, float]]) -> None:
    held = [(part, start, start + length) for part, start, length in spans]
    carriers, shares = carriers_of(TIMES, held)
    if carriers:
        assert np.allclose(shares.sum(axis=1), 1.0)
        assert shares.min() >= -1e-12
        assert np.abs(np.diff(shares, axis=0)).max() <= 0.1334


def upside_down(body: Morphology) -> Motion:
    """Return a body that stands still on its stretched arms."""
    turns = np.zeros((121, len(body.skeleton.joints), 3))
    turns[:, 0, 0] = np.pi
    for side, sign in (("l", 1.0), ("r", -1.0)):
        turns[:, body.joint(f"{side}_shoulder"), 2] = sign * np.pi / 2.0
    translations = np.array(np.broadcast_to(body.skeleton.rest_translations, turns.shape))
    motion = Motion(TIMES, translations, from_vector(turns))
    stand, _ = carried_heights(body.measures, ("l_radiocarpal",), np.ones((1, 1)))
    lowest = wrists(body, motion)[0]
    translations[:, 0, 1] += stand - lowest
    return Motion(TIMES, translations, from_vector(turns))


def wrists(body: Morphology, motion: Motion) -> Floats:
    """Return how high the wrists are, (F,) [m]."""
    places, _ = forward(body.skeleton.parents, motion.translations, motion.rotations)
    joints = [body.joint(f"{side}_radiocarpal") for side in "lr"]
    return np.asarray(places[:, joints, 1].mean(axis=1))


@pytest.mark.parametrize("arms", [0.85, 1.2])
def test_a_handstand_stands_on_its_hands_on_another_body(arms: float) -> None:
    body, other = built(), built(1.3, Proportions(arms=arms, legs=1.1, trunk=0.95))
    space = Placement.identity(len(TIMES))
    held = [("l_radiocarpal", 0.0, 4.0), ("r_radiocarpal", 0.0, 4.0)]
    normalized = normalize(upside_down(body), space, body, up=UP, held=held)
    assert normalized.carriers == ("l_radiocarpal", "r_radiocarpal")
    stands = wrists(other, restore(normalized, other, space, up=UP))
    expected, _ = carried_heights(other.measures, ("l_radiocarpal",), np.ones((1, 1)))
    assert np.allclose(stands, expected, atol=1e-6)
