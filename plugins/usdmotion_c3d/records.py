"""The header and the parameters of a C3D file, taken apart record by record.

Every record says how far the next one is, and that is believed before anything else in it, as the
files of many makers disagree with themselves. Format: C3D.org, "The C3D File Format User Guide".
"""

import math
import struct
from dataclasses import dataclass, field
from pathlib import Path

from usdmotion import FileError

BLOCK = 512
DEC, MIPS = 85, 86
"""Processors: DEC has real numbers of its own, MIPS the highest byte first; 84 is Intel."""
_PROCESSORS = (84, DEC, MIPS)
_SIZES = {-1: 1, 1: 1, 2: 2, 4: 4}
"""Bytes of an element by its type: text, bytes, whole numbers, numbers."""


@dataclass
class Parameter:
    """One parameter; its values are bytes in the order of the file."""

    name: str
    kind: int
    """-1 text, 1 bytes, 2 whole numbers, 4 numbers."""
    shape: tuple[int, ...]
    values: bytes


@dataclass
class Source:
    """What a C3D file is made of."""

    path: Path
    header: bytes
    """Its first block."""
    processor: int
    groups: dict[str, dict[str, Parameter]]
    """Parameters by group and name, in capitals."""
    data: bytes
    """All that follows the parameters, from the block that the header names."""
    notes: list[str] = field(default_factory=list)

    @property
    def order(self) -> str:
        """How `struct` calls the order of the bytes."""
        return ">" if self.processor == MIPS else "<"

    def words(self, first: int, count: int = 1) -> tuple[int, ...]:
        """Return whole numbers of the header; the first word is number 1."""
        return struct.unpack_from(f"{self.order}{count}H", self.header, 2 * (first - 1))

    @property
    def first_frame(self) -> int:
        """Number of the first frame in the recording that it was cut from, which begins with 1."""
        told = self.numbers(self.groups.get("TRIAL", {}).get("ACTUAL_START_FIELD"))
        # The header has but 16 bits for it.
        if len(told) == 2 and min(told) >= 0:
            return max(int(told[0] + 65536.0 * told[1]), 1)
        return max(self.words(4)[0], 1)

    def numbers(self, parameter: "Parameter | None") -> list[float]:
        """Return the numbers of a parameter; none where there is no such parameter, or of text."""
        letter = {1: "B", 2: "H", 4: "f"}.get(parameter.kind) if parameter else None
        if parameter is None or letter is None or (letter == "f" and self.processor == DEC):
            return []
        count = len(parameter.values) // parameter.kind
        found = struct.unpack_from(f"{self.order}{count}{letter}", parameter.values)
        return [float(each) for each in found if math.isfinite(each)]


def read_source(path: Path) -> Source:
    """Take a file apart.

    Raises:
        FileError: It is not there, or no C3D file.
    """
    try:
        content = path.read_bytes()
    except OSError as error:
        raise FileError(f"{path}: cannot be read: {error.strerror}") from error
    if not content:
        raise FileError(f"{path}: the file is empty")
    start = BLOCK * (content[0] - 1)
    whole = len(content) >= 2 * BLOCK and content[1] == 0x50
    if not whole or start < BLOCK or len(content) < start + 4:
        raise FileError(f"{path}: this is no C3D file; its first bytes are not those of one")
    processor = content[start + 3]
    if processor not in _PROCESSORS:
        raise FileError(
            f"{path}: its parameters name a processor {processor}, which C3D does not have; it is "
            "damaged"
        )
    source = Source(path, content[:BLOCK], processor, {}, b"")
    (block,) = source.words(9)
    last = BLOCK * (block - 1)
    if not start + 4 <= last < len(content):
        raise FileError(f"{path}: its header says that the data are outside of the file")
    source.data = content[last:]
    _read_parameters(source, content[start + 4 : last])
    return source


def _read_parameters(source: Source, section: bytes) -> None:
    """Read groups and parameters; what stands before its group is put there all the same."""
    names: dict[int, str] = {}
    found: list[tuple[int, Parameter]] = []
    place, last = 0, "the beginning"
    while place + 2 <= len(section):
        length, number = abs(struct.unpack_from("b", section, place)[0]), section[place + 1]
        if length == 0:
            break
        name = section[place + 2 : place + 2 + length]
        step = place + 2 + length
        readable = len(name) == length and all(32 <= byte < 127 for byte in name)
        if not readable or step + 2 > len(section):
            source.notes.append(f"the parameters after {last} cannot be read and are left out")
            break
        (offset,) = struct.unpack_from(f"{source.order}H", section, step)
        end = step + offset if offset else len(section)
        last = name.decode("ascii").strip().upper()
        if number > 127:
            names[256 - number] = last
        else:
            parameter = _parameter(last, section[step + 2 : min(end, len(section))])
            if parameter is None:
                source.notes.append(f"the parameter {last} cannot be read and is left out")
            else:
                found.append((number, parameter))
        if end > len(section):
            source.notes.append(f"the parameters end in the middle of {last}; the rest is missing")
        if not offset:
            break
        place = end
    for name_of_group in names.values():
        source.groups.setdefault(name_of_group, {})
    for number, parameter in found:
        if number in names:
            source.groups[names[number]][parameter.name] = parameter


def _parameter(name: str, body: bytes) -> Parameter | None:
    """Return a parameter from what stands after its offset, cut down to what is really there."""
    if len(body) < 2:
        return None
    (kind,) = struct.unpack_from("b", body)
    axes = body[1]
    if kind not in _SIZES or axes > 7 or len(body) < 2 + axes:
        return None
    shape = tuple(body[2 : 2 + axes])
    values = body[2 + axes :]
    if _SIZES[kind] * math.prod(shape) > len(values):
        if not shape:
            return None
        slab = _SIZES[kind] * math.prod(shape[:-1])
        shape = (*shape[:-1], len(values) // slab if slab else 0)
    return Parameter(name, kind, shape, values[: _SIZES[kind] * math.prod(shape)])
