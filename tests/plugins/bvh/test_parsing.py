"""What is read, mended and refused in the text of a file."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pxr import Sdf
from usdmotion_bvh import BvhReader

from usdmotion.errors import FileError
from usdmotion.recording import Recording

HEAD = """HIERARCHY
ROOT Hips
{
	OFFSET 0 0 0
	CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
	JOINT Spine
	{
		OFFSET 0 10 0
		CHANNELS 3 Zrotation Xrotation Yrotation
		End Site
		{
			OFFSET 0 5 0
		}
	}
}
"""
MOTION = """MOTION
Frames: 2
Frame Time: 0.0333333
0 90 0 1 2 3 4 5 6
0 91 0 2 3 4 5 6 7
"""
PLAIN = HEAD + MOTION

Read = Callable[..., Recording]
Refusal = Callable[..., str]


@pytest.fixture
def read(tmp_path: Path) -> Read:
    def read_text(text: str | bytes, **options: float | str) -> Recording:
        path = tmp_path / "take 1.bvh"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return BvhReader(unit=1.0, **options).read(path)

    return read_text


@pytest.fixture
def refusal(read: Read, tmp_path: Path) -> Refusal:
    """Return a function that gives what a refusal says after the name of the file."""

    def refuse(text: str | bytes, **options: float | str) -> str:
        with pytest.raises(FileError) as error:
            read(text, **options)
        said, file = str(error.value), f"{tmp_path / 'take 1.bvh'}, "
        assert said.startswith(file)
        assert "\n" not in said
        return said.removeprefix(file)

    return refuse


def same(a: Recording, b: Recording) -> bool:
    return (
        a.skeleton.joints == b.skeleton.joints
        and np.array_equal(a.motion.times, b.motion.times)
        and np.array_equal(a.motion.translations, b.motion.translations)
        and np.array_equal(a.motion.rotations, b.motion.rotations)
        and np.array_equal(a.tip_points, b.tip_points)
    )


@pytest.mark.parametrize(
    "text",
    [
        PLAIN.replace("\n", "\r\n"),
        PLAIN.replace("\n", "\r"),
        PLAIN.replace("\n", "\r\n", 7),
        PLAIN.replace("\t", "    "),
        "\ufeff" + PLAIN,
        PLAIN.encode("utf-16"),
        PLAIN.replace("\n{", " {"),
        PLAIN.replace("End Site", "end site"),
        PLAIN.replace("End Site", "End Spine_End"),
        PLAIN.replace("Zrotation", "zrotation").replace("JOINT", "Joint"),
        PLAIN.replace("Frames: 2", "Frames:2").replace("Frame Time:", "Frame Time:\t"),
        PLAIN.replace(" 91 ", " 9.1E+01 ").replace(" 5 6 7", "\t5  6\t7  "),
        PLAIN.replace("MOTION\n", "\n\nMOTION\n\n") + "\n\n",
        PLAIN.replace("0.0333333", "3.33333e-2"),
    ],
)
def test_the_way_a_file_is_written_makes_no_difference(read: Read, text: str | bytes) -> None:
    recording = read(text)
    assert same(recording, read(PLAIN))
    assert recording.notes == ()


def test_a_recording_has_what_the_file_says(read: Read) -> None:
    recording = read(PLAIN)
    assert recording.name == "take_1"
    assert recording.skeleton.joints == ("Hips", "Hips/Spine")
    assert recording.skeleton.rest_translations.tolist() == [[0, 0, 0], [0, 10, 0]]
    assert recording.motion.translations[1].tolist() == [[0, 91, 0], [0, 10, 0]]
    assert recording.motion.times.tolist() == [0.0, 1 / 30]
    assert (recording.tip_joints.tolist(), recording.tip_points.tolist()) == ([1], [[0, 5, 0]])


def test_rotations_are_composed_in_the_order_of_the_channels(read: Read) -> None:
    turned = [
        read(PLAIN.replace("Zrotation Xrotation Yrotation\n\t\tEnd", f"{order}\n\t\tEnd"))
        .motion.rotations[0, 1]
        .tolist()
        for order in ("Zrotation Xrotation Yrotation", "Xrotation Yrotation Zrotation")
    ]
    assert turned[0] != turned[1]


def test_positions_may_stand_behind_rotations(read: Read) -> None:
    order = "Zrotation Xrotation Yrotation Xposition Yposition Zposition"
    text = PLAIN.replace("Xposition Yposition Zposition Zrotation Xrotation Yrotation", order)
    text = text.replace("0 90 0 1 2 3", "1 2 3 0 90 0").replace("0 91 0 2 3 4", "2 3 4 0 91 0")
    assert same(read(text), read(PLAIN))


def test_a_joint_may_have_no_channels_or_no_end_site(read: Read) -> None:
    more = "JOINT Tail\n{\nOFFSET 0 1 0\n}\nJOINT Fin\n{\nOFFSET 0 2 0\nCHANNELS 0\n}\n"
    recording = read(PLAIN.replace("\tJOINT Spine", more + "\tJOINT Spine"))
    assert recording.skeleton.joints == ("Hips", "Hips/Tail", "Hips/Fin", "Hips/Spine")
    assert recording.motion.rotations[1, 2].tolist() == [0, 0, 0, 1]
    assert np.array_equal(recording.motion.rotations[:, 3], read(PLAIN).motion.rotations[:, 1])


def test_names_become_valid_and_unique_and_the_originals_are_kept(read: Read) -> None:
    names = ["mixamorig7:Left Arm", "mixamorig7_Left_Arm", "1.Finger-é", "Ärmel", "End", "JOINT"]
    joints = "".join(f"JOINT {name}\n{{\nOFFSET 0 1 0\n}}\n" for name in names)
    recording = read(PLAIN.replace("\tJOINT Spine", joints + "\tJOINT Spine"))
    assert list(recording.original_names[1:-1]) == names
    tokens = [token.removeprefix("Hips/") for token in recording.skeleton.joints[1:-1]]
    wanted = [
        "mixamorig7_Left_Arm",
        "mixamorig7_Left_Arm_2",
        "_1_Finger_é",
        "Ärmel",
        "End",
        "JOINT",
    ]
    assert tokens == wanted
    assert all(Sdf.Path.IsValidIdentifier(token) for token in tokens)
    assert any("'mixamorig7:Left Arm' to 'mixamorig7_Left_Arm'" in each for each in recording.notes)


def test_old_code_pages_are_read(read: Read) -> None:
    recording = read(PLAIN.replace("Spine", "Rücken").encode("latin-1"))
    assert recording.original_names[1] == "Rücken"


@pytest.mark.parametrize(("claimed", "found"), [("1", 2), ("3", 2), ("", 2), ("many", 2)])
def test_a_wrong_number_of_frames_is_said(read: Read, claimed: str, found: int) -> None:
    recording = read(PLAIN.replace("Frames: 2", f"Frames: {claimed}"))
    assert recording.motion.frame_count == found
    assert "all of those are read" in recording.notes[0]


def test_fused_numbers_are_taken_apart_where_the_count_is_then_right(read: Read) -> None:
    text = PLAIN.replace("91 0 2 3", "91 0-2 3")
    recording = read(text)
    assert same(recording, read(PLAIN.replace("91 0 2 3", "91 0 -2 3")))
    assert recording.notes == (
        "numbers without a space between them are taken apart at the sign: line 20",
    )


def test_an_exponent_is_not_taken_for_fused_numbers(read: Read) -> None:
    recording = read(PLAIN.replace("91 0 2 3", "91 0-2e-1 3"))
    assert same(recording, read(PLAIN.replace("91 0 2 3", "91 0 -0.2 3")))


def test_frames_on_several_lines_are_joined(read: Read) -> None:
    recording = read(PLAIN.replace(" 4 5 6\n", "\n4 5 6\n").replace(" 5 6 7\n", "\n5 6 7\n"))
    assert same(recording, read(PLAIN))
    assert "joined" in recording.notes[0]


def test_a_file_cut_off_in_its_last_line_loses_that_frame(read: Read) -> None:
    recording = read(PLAIN.removesuffix(" 5 6 7\n"))
    assert recording.motion.frame_count == 1
    assert "cut off in line 20" in recording.notes[0]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (b"", "line 1: the file ends"),
        (b"\x89PNG\0\0", "line 1: this is not text"),
        (PLAIN.removeprefix("HIERARCHY\n"), "line 1: 'ROOT' stands where"),
        (HEAD, "line 16: the file ends before its MOTION"),
        (PLAIN.partition("\n0 90")[0], "line 18: the file ends without a single frame"),
        (PLAIN.replace("ROOT Hips", "ROOT"), "line 2: ROOT has no name"),
        (PLAIN.replace("\t\tOFFSET 0 10 0\n", ""), "line 13: joint 'Spine' ends without"),
        (PLAIN.replace("10 0", "10"), "line 9: 'CHANNELS' stands where a number"),
        (PLAIN.replace("10 0", "10 nan"), "line 8: 'nan' stands where a number"),
        (PLAIN.replace("Xrotation", "Xscale", 1), "line 5: 'Xscale' stands where one of the 6"),
        (PLAIN.replace("CHANNELS 3 Z", "CHANNELS 4 Z"), "line 10: 'End' stands where one of the 4"),
        (PLAIN.replace("CHANNELS 3 Z", "CHANNELS Z"), "line 9: CHANNELS of joint 'Spine' has no"),
        (PLAIN.replace("Yposition", "Xposition"), "line 5: joint 'Hips' has a second Xposition"),
        (PLAIN.replace("JOINT Spine", "OFFSET 0 0 0\nJOINT Spine"), "line 6: joint 'Hips' has a"),
        (PLAIN.replace("\t}\n}\n", "\t}\n"), "line 15: 'MOTION' stands in joint 'Hips'"),
        (PLAIN.replace("}\nMOTION", "}\n}\nMOTION"), "line 16: '}' stands where ROOT or MOTION"),
        (HEAD + HEAD.partition("\n")[2] + MOTION, "line 16: this is a second ROOT"),
        (PLAIN.replace("0 90 0 1 2 3", "0 90 0 1 2"), "line 19: this frame has 8 in place"),
        (PLAIN.replace("0 90 0 1 2 3", "0 90 0 1 2 3 3"), "line 19: this frame has 10 in place"),
        (PLAIN.replace("0 91 0", "0 9,1 0"), "line 20: '9,1' stands where a number should"),
        (PLAIN.replace("0 91 0", "0 inf 0"), "line 20: 'inf' stands where a number should"),
        (PLAIN.replace("0 91 0", "0 1e300 0"), "line 20: '1e300' stands where a number should"),
        (PLAIN.replace("0 91 0", "0 1.2.3 0"), "line 20: '1.2.3' stands where a number should"),
        (PLAIN.replace("Frame Time: 0.0333333\n", ""), "line 16: there is no Frame Time"),
        (PLAIN.replace("0.0333333", "0"), "line 18: '0' is no Frame Time"),
        (PLAIN.replace("0.0333333", "-1"), "line 18: '-1' is no Frame Time"),
        (PLAIN.replace("0.0333333", "fast"), "line 18: 'fast' is no Frame Time"),
    ],
)
def test_what_is_broken_is_refused_by_its_line(
    refusal: Refusal, text: str | bytes, said: str
) -> None:
    assert refusal(text).startswith(said)


def test_a_file_that_is_not_there_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"none\.bvh cannot be read: No such file"):
        BvhReader().read(tmp_path / "none.bvh")


def test_a_rate_from_outside_stands_in_for_a_missing_frame_time(read: Read) -> None:
    assert read(PLAIN.replace("Frame Time: 0.0333333\n", ""), rate=60.0).frame_rate == 60.0


@pytest.mark.parametrize(
    ("written", "rate"),
    [
        ("0.0333333", 30.0),
        (".0333", 30.0),
        ("0.033367", 30000 / 1001),
        ("0.041667", 24.0),
        ("0.0417083750417", 23.976),
        ("0.0417083", 24000 / 1001),
        ("0.04", 25.0),
        ("0.008333", 120.0),
        ("0.00833330", 120.0),
        ("0.008342", 120000 / 1001),
        ("0.008", 125.0),
        ("0.01", 100.0),
        ("0.0166", 1 / 0.0166),
        ("1.0", 1.0),
    ],
)
def test_a_rounded_frame_time_is_the_rate_that_was_meant(
    read: Read, written: str, rate: float
) -> None:
    recording = read(PLAIN.replace("0.0333333", written))
    assert recording.frame_rate == pytest.approx(rate, rel=1e-12)


@given(
    cut=st.integers(0, len(PLAIN)),
    length=st.integers(0, 40),
    put=st.one_of(st.binary(max_size=8), st.sampled_from(PLAIN.encode().split())),
)
def test_any_damage_is_read_or_refused(
    tmp_path_factory: pytest.TempPathFactory, cut: int, length: int, put: bytes
) -> None:
    path = tmp_path_factory.getbasetemp() / "damaged.bvh"
    path.write_bytes(PLAIN.encode()[:cut] + put + PLAIN.encode()[cut + length :])
    try:
        recording = BvhReader().read(path)
    except FileError as refused:
        assert str(refused).startswith(f"{path}, line ")
        assert "\n" not in str(refused)
    else:
        assert np.isfinite(recording.motion.translations).all()
        assert np.allclose(np.linalg.norm(recording.motion.rotations, axis=-1), 1.0)


@pytest.mark.parametrize("written", ["1.0", "0.00001"])
def test_an_implausible_frame_time_is_said(read: Read, written: str) -> None:
    assert "not plausible" in read(PLAIN.replace("0.0333333", written)).notes[0]


def test_a_chain_may_be_deeper_than_the_stack_of_python(read: Read) -> None:
    deep = "JOINT J\n{\nOFFSET 0 1 0\n" * 2000 + "}\n" * 2000
    assert len(read(PLAIN.replace("\tJOINT Spine", deep + "\tJOINT Spine")).original_names) == 2002
