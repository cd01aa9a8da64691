"""What is decided from the data where a file leaves it open."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from usdmotion_bvh import BvhReader

from usdmotion.arrays import Floats
from usdmotion.errors import FileError
from usdmotion.options import configured, options
from usdmotion.recording import Reader, Recording

Lines = Sequence[str]
HIP_HEIGHT = 95.0
LEG = ((10, 0, 0), (0, -45, 0), (0, -45, 0), (0, -5, 12))
ARM = ((15, 20, 0), (28, 0, 0), (25, 0, 0), (15, 0, 0))
HANGING_ARM = ((15, 20, 0), (0, -28, 0), (0, -25, 0), (0, -15, 0))
TRUNK = ((0, 25, 0), (0, 25, 0), (0, 20, 0), (0, 20, 0))


class Person:
    """A person of 1.8 m in a T-pose, in centimetres and Y up unless said otherwise."""

    def __init__(
        self,
        *,
        scale: float = 1.0,
        z_up: bool = False,
        arm: tuple[tuple[int, ...], ...] = ARM,
    ) -> None:
        self.scale, self.z_up, self.arm = scale, z_up, arm

    def file(self, offset: Floats, positions: Floats, turns: Floats | None = None) -> str:
        """Write frames of the root's positions and of its turns about Z, X, Y."""
        turns = np.zeros(positions.shape) if turns is None else turns
        six = "Xposition Yposition Zposition Zrotation Xrotation Yrotation"
        lines = ["HIERARCHY", "ROOT Hips", "{", self.offset(offset), f"CHANNELS 6 {six}"]
        arms = self.limb("Arm", self.arm) + self.limb("OtherArm", self.arm, side=-1)
        lines += self.limb("Trunk", TRUNK, branches=arms)
        lines += self.limb("Leg", LEG) + self.limb("OtherLeg", LEG, side=-1)
        lines += ["}", "MOTION", f"Frames: {len(positions)}", "Frame Time: 0.0333333"]
        rows = np.concatenate([self.turned(positions), turns], axis=1)
        return "\n".join([*lines, *(" ".join(map(str, row)) for row in rows)])

    def limb(
        self, name: str, steps: tuple[tuple[int, ...], ...], side: int = 1, branches: Lines = ()
    ) -> list[str]:
        """Write joints in a row; branches hang from the second."""
        lines: list[str] = []
        for number, (x, y, z) in enumerate(steps, start=1):
            lines += [f"JOINT {name}{number}", "{", self.offset(np.array((side * x, y, z)))]
            lines += branches if number == 2 else ()
        return lines + ["}"] * len(steps)

    def offset(self, place: Floats) -> str:
        return "OFFSET " + " ".join(map(str, self.turned(place)))

    def turned(self, vectors: Floats) -> Floats:
        scaled: Floats = vectors * self.scale
        return scaled[..., [2, 0, 1]] if self.z_up else scaled


def standing(frame_count: int = 30, height: float = HIP_HEIGHT) -> Floats:
    sway = 3.0 * np.sin(np.linspace(0.0, 6.0, frame_count))
    return np.stack([sway, np.full(frame_count, height), np.zeros(frame_count)], axis=1)


def read(folder: Path, text: str, **wishes: object) -> Recording:
    path = folder / "person.bvh"
    path.write_text(text)
    return configured(BvhReader, wishes).read(path)


def root_heights(recording: Recording) -> Floats:
    heights: Floats = recording.motion.translations[:, 0, 1]
    return heights


def test_the_reader_keeps_the_contract() -> None:
    assert isinstance(BvhReader(), Reader)
    assert [each.name for each in options(BvhReader)] == [
        "rate",
        "unit",
        "root",
        "up",
        "root_scale",
        "skip",
    ]


@pytest.mark.parametrize("metres", [1.0, 0.1, 0.01, 0.001, 0.0254, 0.0254 / 0.45])
@pytest.mark.parametrize("z_up", [False, True])
def test_known_units_are_told_by_the_height_of_a_body(
    tmp_path: Path, metres: float, z_up: bool
) -> None:
    person = Person(scale=0.01 / metres, z_up=z_up)
    recording = read(tmp_path, person.file(np.zeros(3), standing()))
    axis = 2 if z_up else 1
    assert recording.up == ("Z" if z_up else "Y")
    assert np.allclose(recording.motion.translations[:, 0, axis], 0.01 * HIP_HEIGHT)
    assert recording.skeleton.rest_translations[1, axis] == pytest.approx(0.25)


def test_the_unit_does_not_depend_on_what_the_person_does(tmp_path: Path) -> None:
    lying = np.tile((0.0, 90.0, 0.0), (30, 1))
    text = Person().file(np.zeros(3), standing(height=12.0), lying)
    assert read(tmp_path, text, up="Y").skeleton.rest_translations[1, 1] == pytest.approx(0.25)


def test_an_unusual_height_is_said_and_overruled(tmp_path: Path) -> None:
    text = Person(scale=0.65).file(np.zeros(3), standing())
    assert any("unusual" in note for note in read(tmp_path, text).notes)
    overruled = read(tmp_path, text, unit=0.01 / 0.65)
    assert not any("unusual" in note for note in overruled.notes)
    assert root_heights(overruled)[0] == pytest.approx(0.01 * HIP_HEIGHT)


def test_an_offset_of_the_root_that_its_channel_repeats_is_not_added(tmp_path: Path) -> None:
    offset = np.array([0.0, HIP_HEIGHT, 0.0])
    recording = read(tmp_path, Person().file(offset, standing()))
    assert np.allclose(root_heights(recording), 0.01 * HIP_HEIGHT)
    assert any("taking the place" in note for note in recording.notes)


def test_an_offset_of_the_root_that_its_channel_lacks_is_added(tmp_path: Path) -> None:
    offset = np.array([0.0, HIP_HEIGHT, 0.0])
    recording = read(tmp_path, Person().file(offset, standing(height=0.0)))
    assert np.allclose(root_heights(recording), 0.01 * HIP_HEIGHT)
    assert any("differences" in note for note in recording.notes)


def test_the_rule_of_the_root_can_be_overruled(tmp_path: Path) -> None:
    text = Person().file(np.array([0.0, HIP_HEIGHT, 0.0]), standing(height=0.0))
    assert np.allclose(root_heights(read(tmp_path, text, root="absolute")), 0.0)


def test_a_root_that_nothing_decides_is_read_as_most_are_and_that_is_said(tmp_path: Path) -> None:
    text = Person().file(np.array([5.0, 0.0, 0.0]), standing())
    recording = read(tmp_path, text)
    assert np.allclose(recording.motion.translations[0, 0], (0.0, 0.95, 0.0))
    assert any("option root overrules it" in note for note in recording.notes)


@pytest.mark.parametrize("z_up", [False, True])
def test_a_crawl_does_not_turn_the_world_over(tmp_path: Path, z_up: bool) -> None:
    person = Person(z_up=z_up, arm=HANGING_ARM)
    crawl = np.stack([np.zeros(90), np.full(90, 12.0), np.linspace(0.0, 500.0, 90)], axis=1)
    # The turns are about Z, X, Y of the file: lie down along the way that is crawled.
    lying = np.tile((0.0, 0.0, 90.0) if z_up else (0.0, 90.0, 0.0), (90, 1))
    recording = read(tmp_path, person.file(np.zeros(3), crawl, lying))
    assert recording.up == ("Z" if z_up else "Y")


def test_a_climb_does_not_turn_the_world_over(tmp_path: Path) -> None:
    climb = standing(90) + np.linspace(0.0, 400.0, 90)[:, None] * (0.0, 1.0, 0.0)
    assert read(tmp_path, Person().file(np.zeros(3), climb)).up == "Y"


def test_the_axis_that_points_up_can_be_overruled(tmp_path: Path) -> None:
    assert read(tmp_path, Person().file(np.zeros(3), standing()), up="Z").up == "Z"


def test_positions_below_an_idle_root_are_the_roots(tmp_path: Path) -> None:
    text = Person().file(np.array([0.0, HIP_HEIGHT, 0.0]), standing(height=0.0))
    six = "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation"
    idle = f"HIERARCHY\nROOT Reference\n{{\nOFFSET 0 0 0\n{six}\n"
    head, rows = text.removeprefix("HIERARCHY\n").split("\nMOTION\n")
    lines = rows.split("\n")
    lines[2:] = ["0 0 0 0 0 0 " + line for line in lines[2:]]
    whole = idle + head.replace("ROOT", "JOINT") + "\n}\nMOTION\n" + "\n".join(lines)
    recording = read(tmp_path, whole)
    assert np.allclose(recording.motion.translations[:, 1, 1], 0.01 * HIP_HEIGHT)


def test_positions_below_the_root_may_repeat_or_lack_their_offset(tmp_path: Path) -> None:
    text = Person().file(np.zeros(3), standing())
    moving = "OFFSET 0.0 25.0 0.0\nCHANNELS 3 Xposition Yposition Zposition"
    text = text.replace("OFFSET 0.0 25.0 0.0", moving, 1)
    for said, height in (("0 25.1 0", 0.251), ("0 0.1 0", 0.251)):
        head, rows = text.split("0.0333333\n")
        rows = "\n".join(f"{row} {said}" for row in rows.split("\n"))
        recording = read(tmp_path, f"{head}0.0333333\n{rows}")
        assert np.allclose(recording.motion.translations[:, 1, 1], height)
        assert any("keeps the lengths" in note for note in recording.notes)


def test_positions_below_the_root_that_are_places_in_the_world_are_refused(tmp_path: Path) -> None:
    text = Person().file(np.zeros(3), standing())
    moving = "OFFSET 0.0 25.0 0.0\nCHANNELS 3 Xposition Yposition Zposition"
    head, rows = text.replace("OFFSET 0.0 25.0 0.0", moving, 1).split("0.0333333\n")
    lines = [f"{row} {row.split()[0]} {HIP_HEIGHT + 25.0} 0" for row in rows.split("\n")]
    with pytest.raises(FileError, match=r"line 6: .* 'Trunk1' are places in the world"):
        read(tmp_path, head + "0.0333333\n" + "\n".join(lines))


def test_a_jump_from_frame_0_is_said_and_kept(tmp_path: Path) -> None:
    walk = standing(60)
    walk[0] += (0.0, 0.0, 200.0)
    recording = read(tmp_path, Person().file(np.zeros(3), walk))
    assert recording.motion.frame_count == 60
    assert any("skip=1 leaves it out" in note for note in recording.notes)


def test_a_steady_run_is_not_taken_for_jumps(tmp_path: Path) -> None:
    run = standing(60) + np.linspace(0.0, 1000.0, 60)[:, None] * (0.0, 0.0, 1.0)
    recording = read(tmp_path, Person().file(np.zeros(3), run))
    assert not any("jumps" in note for note in recording.notes)


def test_frames_at_the_start_are_left_out_on_request(tmp_path: Path) -> None:
    path = tmp_path / "posed.bvh"
    path.write_text(
        "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\n"
        "End Site\n{\nOFFSET 0 10 0\n}\n}\nMOTION\nFrames: 4\nFrame Time: 0.05\n"
        "0 90 0\n1 90 0\n2 90 0\n3 90 0\n"
    )
    whole, rest = BvhReader(unit=0.01).read(path), BvhReader(unit=0.01, skip=2).read(path)
    assert rest.motion.times.tolist() == whole.motion.times[:2].tolist()
    assert np.array_equal(rest.motion.translations, whole.motion.translations[2:])
    assert BvhReader(skip=99).read(path).motion.frame_count == 1
