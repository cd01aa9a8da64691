"""What the name of a joint says: a side, a word, numbers."""

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from usdmotion.humanoid.words import KNOWN, NOISE

_WORDS = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")
_SIDES = {"l": "l", "left": "l", "r": "r", "right": "r"}
_GLUED = re.compile(r"(left|right|l|r)(.+)")


@dataclass(frozen=True, slots=True)
class Name:
    """The name of a joint, taken apart."""

    compact: str
    """All of it in small letters and digits, without what all the names begin with."""
    words: tuple[str, ...]
    """Its words in small letters, without side and numbers."""
    side: str
    """"l", "r", or "" where it says none."""
    core: str
    """The word of the vocabulary that its words make, as one; else just its words as one."""
    numbers: tuple[int, ...]

    @property
    def is_digit(self) -> bool:
        """Whether it counts a finger or toe and its joints, such as `toe2-1`."""
        return self.core in ("finger", "toe") and len(self.numbers) > 1


def read_names(names: Sequence[str]) -> list[Name]:
    """Return what each name says, by itself: no side or part is told from its parents.

    Args:
        names: Names or paths of all the joints of one skeleton.
    """
    leaves = [re.split(r"[/|:]", name)[-1] for name in names]
    return [_read(words) for words in _without_prefix([_split(leaf) for leaf in leaves])]


def _split(leaf: str) -> list[str]:
    return [word.lower() for word in _WORDS.findall(leaf)]


def _without_prefix(names: list[list[str]]) -> list[list[str]]:
    """Take away what a rig puts before its names, such as `CC_Base_` or `mixamorig7_`."""
    while len(names) > 1:
        word, count = Counter(words[0] if words else "" for words in names).most_common(1)[0]
        if 2 * count <= len(names) or word == "" or word in _SIDES or word in KNOWN:
            break
        names = [words[1:] if words and words[0] == word else words for words in names]
    return names


def _read(words: list[str]) -> Name:
    letters = [word for word in words if not word.isdigit()]
    sides = {_SIDES[word] for word in letters if word in _SIDES}
    bare = tuple(word for word in letters if word not in _SIDES)
    side = sides.pop() if len(sides) == 1 and bare else ""
    core = _core(bare)
    glued = _GLUED.fullmatch(core)
    if not side and core not in KNOWN and glued and glued[2] in KNOWN:
        side, core = _SIDES[glued[1]], glued[2]
    numbers = tuple(int(word) for word in words if word.isdigit())
    return Name("".join(words), bare, side, core, numbers)


def _core(words: tuple[str, ...]) -> str:
    whole = "".join(words)
    if whole in KNOWN or _GLUED.sub(r"\2", whole) in KNOWN:
        return whole
    bare = "".join(word for word in words if word not in NOISE)
    return bare if bare in KNOWN else whole
