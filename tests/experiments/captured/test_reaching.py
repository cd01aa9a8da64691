"""2004, figure 3: whoever was captured reaches for a point; feet and balance are kept."""

import numpy as np
import pytest

from usdmotion.constraints import CenterOfMassConstraint, Goal, PositionConstraint

WRIST = "l_radiocarpal"
SHOULDER = "l_shoulder"
ASIDE, DOWN = 0.65, 0.3
"""Where the point is from the shoulder's place, as shares of the arm's length."""


@pytest.fixture(scope="module")
def keys(clip):
    return clip.keys(clip.calm(SHOULDER))


@pytest.fixture(scope="module")
def target(clip, keys):
    aside = np.cross(clip.up, clip.ahead(clip.calm(SHOULDER)))
    shoulder = clip.take.point(clip.token(SHOULDER))[clip.within(keys)].mean(axis=0)
    return shoulder + clip.arm * (ASIDE * aside - DOWN * clip.up)


def asked(clip, target, keys):
    wrist = PositionConstraint(
        path="Wrist",
        skeleton=clip.skeleton,
        joint=clip.token(WRIST),
        priority=2,
        goals=(Goal(path="Reach", translation=target, times=keys),),
    )
    return [*clip.feet(priority=1), wrist]


def balance(clip):
    soles = [sole for side in "lr" for sole in clip.soles(side)]
    return CenterOfMassConstraint(
        path="Balance",
        skeleton=clip.skeleton,
        priority=3,
        supports=tuple(joint for joint, _ in soles),
        support_points=np.array([point for _, point in soles]),
        axes=clip.ground_axes,
    )


@pytest.fixture(scope="module")
def kept(clip, ask, target, keys):
    return ask(clip, [*asked(clip, target, keys), balance(clip)])


@pytest.fixture(scope="module")
def lost(clip, ask, target, keys):
    return ask(clip, asked(clip, target, keys), knees="")


def test_the_feet_stay_where_they_were(clip, kept):
    for side in "lr":
        for joint, point in clip.soles(side):
            assert kept.moved(joint, point) <= 1.0


def test_the_wrist_is_at_its_goal_on_the_plateau(clip, kept, target, keys):
    left = kept.after.point(clip.token(WRIST)) - target
    assert clip.within(keys).sum() == 9
    assert kept.millimetres(left[clip.within(keys)]) <= 2.0


def from_supports(clip, take):
    """Return the centre of mass from the middle of its supports, along the ground [m], (F, 3)."""
    soles = [take.point(*sole) for side in "lr" for sole in clip.soles(side)]
    apart = take.center_of_mass(clip.body) - np.mean(soles, axis=0)
    return apart - np.outer(apart @ clip.up, clip.up)


def test_without_the_constraint_the_centre_of_mass_leaves_its_supports(clip, kept, lost):
    with_it, without = (
        each.millimetres(from_supports(clip, each.after) - from_supports(clip, each.before))
        for each in (kept, lost)
    )
    assert without >= 2.0 * with_it
    assert without >= 10.0


def test_what_is_drawn_of_it_is_where_it_is(clip, kept, keys, tmp_path, drawn):
    composed = kept.edit_layer.with_name(kept.edit_layer.name.replace(".edit.", ".shot."))
    guides = drawn(composed, tmp_path / "guides.usda")
    edit = f"{clip.skeleton}/Edit"
    for name, take in (("Before", kept.before), ("After", kept.after)):
        way = take.point(clip.token(WRIST))
        assert guides.off(f"{edit}/Wrist/Guides/{name}", way).max() < 3e-3
    middle = int(np.flatnonzero(clip.within(keys))[4])
    code, masses = kept.after.times[middle], kept.after.center_of_mass(clip.body)
    (place,) = guides.points(f"{edit}/Balance/Guides/CenterOfMass/Spot", code)
    assert np.linalg.norm(place - masses[middle]) < 3e-3
    wrist = kept.after.point(clip.token(WRIST))[middle]
    marker = guides.points(f"{edit}/Wrist/Guides/Reach/Marker", code).mean(axis=0)
    assert np.linalg.norm(marker - wrist) < 6e-3
    assert guides.size < composed.with_name(kept.edit_layer.name).stat().st_size
