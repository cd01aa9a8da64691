"""The HIERARCHY part of a BVH file: joints, their OFFSETs and their CHANNELS."""

import dataclasses
import re
from dataclasses import dataclass
from typing import NamedTuple

from usdmotion_bvh.source import Source
from usdmotion_bvh.words import Word, Words

_CHANNEL = re.compile(r"([XYZ])(POSITION|ROTATION)")


class Channel(NamedTuple):
    """One number of a joint in every frame."""

    axis: int
    """0, 1 or 2 for X, Y or Z."""
    turns: bool
    """Whether it is an angle; a position otherwise."""


@dataclass(frozen=True)
class Joint:
    """One ROOT or JOINT as the file has it."""

    name: str
    parent: int
    """Index of the joint above, -1 for the ROOT."""
    line: int
    """Where the joint begins."""
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    channels: tuple[Channel, ...] = ()

    @property
    def moves(self) -> bool:
        """Whether the joint has position channels."""
        return any(not channel.turns for channel in self.channels)


class Tip(NamedTuple):
    """One End Site."""

    joint: int
    """Index of the joint it belongs to."""
    offset: tuple[float, float, float]


@dataclass(frozen=True)
class Hierarchy:
    """All joints in the order of the file, which is the order of the columns of the motion."""

    joints: tuple[Joint, ...]
    tips: tuple[Tip, ...]
    motion_line: int
    """The line that says MOTION."""

    @property
    def channel_count(self) -> int:
        """How many numbers a frame has."""
        return sum(len(joint.channels) for joint in self.joints)


def parse_hierarchy(source: Source) -> Hierarchy:
    """Read the joints of a file, down to the word MOTION.

    Raises:
        FileError: The hierarchy cannot be read without guessing.
    """
    words = Words(source)
    first = words.take()
    if first.keyword != "HIERARCHY":
        words.refuse(first, f"'{first.text}' stands where a BVH file says HIERARCHY")
    branch = _Branch(words)
    while True:
        word = words.take()
        if word.keyword == "MOTION" and branch.joints:
            return Hierarchy(tuple(branch.joints), tuple(branch.tips), word.line)
        if word.keyword != "ROOT":
            words.refuse(word, f"'{word.text}' stands where ROOT or MOTION should")
        if branch.joints:
            words.refuse(word, "this is a second ROOT, but only one skeleton a file can be read")
        branch.read(word)


class _Branch:
    """Reads a joint and all below it, in a loop: a file may be deeper than Python's stack."""

    def __init__(self, words: Words) -> None:
        self.words = words
        self.joints: list[Joint] = []
        self.tips: list[Tip] = []
        self.open: list[int] = []
        """Indices of the joints whose closing brace is still to come."""
        self.seen: set[tuple[int, str]] = set()
        """Joints by index, and which of OFFSET and CHANNELS they have had."""

    def read(self, root: Word) -> None:
        self.begin(root)
        while self.open:
            word = self.words.take()
            if word.keyword in ("OFFSET", "CHANNELS"):
                self.give(self.open[-1], word)
            elif word.keyword == "JOINT":
                self.begin(word)
            elif word.keyword == "END":
                self.tip(self.open[-1], word)
            elif word.text == "}":
                self.end(word)
            else:
                name = self.joints[self.open[-1]].name
                wanted = "OFFSET, CHANNELS, JOINT, End Site or '}'"
                self.words.refuse(word, f"'{word.text}' stands in joint '{name}', not {wanted}")

    def begin(self, word: Word) -> None:
        name = self.words.take_line(word.line)
        if not name:
            self.words.refuse(word, f"{word.text} has no name")
        self.words.expect("{", f"joint '{name}'")
        self.joints.append(Joint(name, self.open[-1] if self.open else -1, word.line))
        self.open.append(len(self.joints) - 1)

    def end(self, brace: Word) -> None:
        index = self.open.pop()
        if (index, "OFFSET") not in self.seen:
            self.words.refuse(brace, f"joint '{self.joints[index].name}' ends without an OFFSET")

    def give(self, index: int, word: Word) -> None:
        """Read what follows OFFSET or CHANNELS."""
        joint = self.joints[index]
        if (index, word.keyword) in self.seen:
            self.words.refuse(word, f"joint '{joint.name}' has a second {word.keyword}")
        self.seen.add((index, word.keyword))
        if word.keyword == "OFFSET":
            joint = dataclasses.replace(joint, offset=self.offset())
        else:
            joint = dataclasses.replace(joint, channels=self.channels(joint.name))
        self.joints[index] = joint

    def tip(self, joint: int, end: Word) -> None:
        """Read an End Site; neither the word after End nor its case matters."""
        self.words.take_line(end.line)
        for wanted in ("{", "OFFSET"):
            self.words.expect(wanted, "an End Site")
        self.tips.append(Tip(joint, self.offset()))
        self.words.expect("}", "an End Site")

    def offset(self) -> tuple[float, float, float]:
        x, y, z = (self.words.take_number("an OFFSET") for _ in range(3))
        return x, y, z

    def channels(self, name: str) -> tuple[Channel, ...]:
        count = self.words.take()
        if not count.text.isdecimal():
            self.words.refuse(count, f"CHANNELS of joint '{name}' has no count but '{count.text}'")
        channels: list[Channel] = []
        for _ in range(int(count.text)):
            word = self.words.take()
            match = _CHANNEL.fullmatch(word.keyword)
            if match is None:
                wanted = f"one of the {count.text} channels of joint '{name}'"
                self.words.refuse(word, f"'{word.text}' stands where {wanted} should")
            channel = Channel("XYZ".index(match[1]), match[2] == "ROTATION")
            if channel in channels and not channel.turns:
                self.words.refuse(word, f"joint '{name}' has a second {word.text}")
            channels.append(channel)
        return tuple(channels)
