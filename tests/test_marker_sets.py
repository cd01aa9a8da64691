"""What labels say: whose markers they are, at which place of the body, on which segment."""

from usdmotion.marker_sets import places, plain, segments_of, subjects

FOOT = ["LANK", "LHEE", "LTOE"]


def test_every_label_is_of_one_subject_and_plain_without_it() -> None:
    labels = ["Matt:LASI", "RASI", "Matt:RASI", "Ann:LASI"]
    found = subjects(labels)
    assert sorted(label for own in found.values() for label in own) == sorted(labels)
    assert found["Matt"] == ["Matt:LASI", "Matt:RASI"]
    assert [plain(label) for label in found["Matt"]] == ["LASI", "RASI"]
    assert found[""] == ["RASI"]


def test_a_place_is_known_by_any_of_its_names_and_has_the_first_label() -> None:
    for name in ("LKNE", "L_Knee", "lknee1", "Matt:L.KNEE"):
        assert places([name]) == {"LKNE": name}
    assert places(["SACRUM", "VSAC"]) == {"SACR": "SACRUM"}


def test_a_numbered_copy_of_a_label_stands_at_no_place() -> None:
    assert places(["LKNE_2"]) == {}


def test_a_segment_needs_three_of_its_markers() -> None:
    assert segments_of(FOOT) == {"LeftFoot": tuple(FOOT)}
    assert segments_of(FOOT[:2]) == {}


def test_a_marker_on_the_axis_of_a_joint_rides_on_both_segments() -> None:
    found = segments_of([*FOOT, "LKNE", "LTIB"])
    assert set(found["LeftShank"]) & set(found["LeftFoot"]) == {"LANK"}


def test_a_second_subject_is_named_before_its_segments() -> None:
    labels = [f"{name}:{label}" for name in ("Matt", "Ann") for label in FOOT]
    assert list(segments_of(labels)) == ["LeftFoot", "Ann_LeftFoot"]


def test_a_few_numbers_are_a_segment_and_many_are_none() -> None:
    assert segments_of(["RFT1", "RFT2", "RFT3"]) == {"RFT": ("RFT1", "RFT2", "RFT3")}
    assert segments_of(["RFT1", "RFT2", "RFT4"]) == {}
    assert segments_of([f"M{number}" for number in range(1, 20)]) == {}
