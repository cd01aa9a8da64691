from usdmotion import recruiting
from usdmotion.recruiting import Claim, Violation, chain, mend, movers, violations

PARENTS = {
    "hips": None,
    "spine": "hips",
    "arm": "spine",
    "hand": "arm",
    "head": "spine",
    "leg": "hips",
    "foot": "leg",
}


def claim(name, priority, effectors, recruits):
    return Claim(name, priority, frozenset(effectors.split()), frozenset(recruits.split()))


def test_a_chain_goes_from_the_joint_up_to_the_top():
    assert chain(PARENTS, "hand") == ("hand", "arm", "spine", "hips")


def test_a_chain_ends_at_the_root_of_the_solve():
    assert chain(PARENTS, "hand", "spine") == ("hand", "arm", "spine")


def test_a_chain_that_never_meets_the_root_is_whole():
    assert chain(PARENTS, "foot", "spine") == ("foot", "leg", "hips")


def test_movers_of_several_effectors_are_the_union_of_their_chains():
    assert movers(PARENTS, ["hand", "foot"]) == set(PARENTS) - {"head"}


def test_a_wrist_that_recruits_the_root_moves_a_foot_that_recruits_only_its_leg():
    foot = claim("foot", 1, "foot", "foot leg")
    hand = claim("hand", 2, "hand", "hand arm spine hips")
    assert violations(PARENTS, [hand, foot]) == [Violation("foot", "hand", ("hips",))]


def test_one_shared_joint_is_enough_to_break_the_rule():
    head = claim("head", 1, "head", "head")
    hand = claim("hand", 2, "hand", "arm spine")
    assert violations(PARENTS, [head, hand]) == [Violation("head", "hand", ("spine",))]


def test_the_lower_rank_may_recruit_less_than_the_higher():
    foot = claim("foot", 1, "foot", "foot leg hips")
    hand = claim("hand", 2, "hand", "hand arm")
    assert violations(PARENTS, [foot, hand]) == []


def test_joints_that_cannot_move_both_are_nobodys_business():
    foot = claim("foot", 1, "foot", "foot leg")
    hand = claim("hand", 2, "hand", "hand arm spine")
    assert violations(PARENTS, [foot, hand]) == []


def test_equal_ranks_are_never_in_violation():
    foot = claim("foot", 1, "foot", "foot leg")
    hand = claim("hand", 1, "hand", "hand arm spine hips")
    assert violations(PARENTS, [foot, hand]) == []


def test_only_the_order_of_the_ranks_counts():
    foot = claim("foot", -7, "foot", "foot leg")
    hand = claim("hand", 40, "hand", "hips")
    assert violations(PARENTS, [foot, hand]) == [Violation("foot", "hand", ("hips",))]


def test_the_frame_of_a_moving_target_counts_as_an_effector():
    follow = claim("follow", 1, "hand head", "hand arm")
    nod = claim("nod", 2, "head", "head")
    assert violations(PARENTS, [follow, nod]) == [Violation("follow", "nod", ("head",))]


def test_mending_adds_just_the_joints_that_were_named():
    foot = claim("foot", 1, "foot", "foot leg")
    hand = claim("hand", 2, "hand", "hand arm spine hips")
    mended = mend(PARENTS, [hand, foot])
    assert [one.name for one in mended] == ["hand", "foot"]
    assert mended[1].recruits == {"foot", "leg", "hips"}
    assert mended[0] == hand


def test_mending_one_rank_is_passed_on_to_the_ranks_above():
    top = claim("top", 1, "foot", "foot leg")
    middle = claim("middle", 2, "foot hand", "arm")
    low = claim("low", 3, "hand", "hips spine")
    mended = mend(PARENTS, [top, middle, low])
    assert violations(PARENTS, mended) == []
    assert mended[1].recruits == {"arm", "hips", "spine"}
    assert mended[0].recruits == {"foot", "leg", "hips"}


def test_what_keeps_the_rule_is_mended_into_itself():
    claims = [claim("foot", 1, "foot", "foot leg hips"), claim("hand", 2, "hand", "hand hips")]
    assert mend(PARENTS, claims) == claims


def test_the_rule_knows_nothing_of_usd():
    assert "pxr" not in vars(recruiting)
