"""A sound copy of a C3D file, for a library that trusts what it reads.

ezc3d does not know MIPS files, refuses parameters that another library reads, and on some broken
files it crashes or never ends. So it is not given a file but a copy: the same numbers with every
length checked and every record where it is said to be.
"""

import struct
from dataclasses import dataclass

import numpy as np

from usdmotion import FileError
from usdmotion_c3d.records import BLOCK, DEC, MIPS, Parameter, Source

_INTEL = 84
_LIMIT = 255 * BLOCK
"""Most that parameters can take up, as their length is one byte of blocks."""
_LONGEST = 0xFFFF
"""Most frames that the header can count."""
_MOST = 255
"""Most elements along one axis of a parameter; what is more goes on in a second one."""


@dataclass(frozen=True)
class Layout:
    """How the data of a file are laid out."""

    frames: int
    size: int
    """Bytes of a frame."""
    real: bool
    """Whether numbers are real, or whole ones to be scaled."""
    samples: int
    """Analogue samples of a frame, all channels together."""


def sound_copy(source: Source) -> bytes:
    """Return the bytes of a file that says the same in a sound way.

    Raises:
        FileError: It has no frames, or says of itself what cannot be.
    """
    swapped = source.processor == MIPS
    layout = _layout(source)
    groups = {name: dict(parameters) for name, parameters in source.groups.items()}
    _complete(source, groups, layout)
    section = _parameters(groups, swapped)
    if len(section) + 4 > _LIMIT:
        raise FileError(f"{source.path}: its parameters are longer than C3D allows")
    blocks = -(-(len(section) + 4) // BLOCK)
    place = section.find(b"DATA_START") + len(b"DATA_START") + 4
    section = section[:place] + struct.pack("<H", 2 + blocks) + section[place + 2 :]
    kind = _INTEL if swapped else source.processor
    head = bytes((1, 0x50, blocks, kind))
    data = source.data[: layout.frames * layout.size]
    if swapped:
        data = np.frombuffer(data, ">u4" if layout.real else ">u2").byteswap().tobytes()
    return (
        _header(source, layout, 2 + blocks)
        + (head + section).ljust(blocks * BLOCK, b"\0")
        + data.ljust(-(-len(data) // BLOCK) * BLOCK, b"\0")
    )


def _layout(source: Source) -> Layout:
    """Return how the data are laid out, as far as they are really there."""
    points, _, first, last = source.words(2, 4)
    real = _scale(source) < 0.0
    count = last - first + 1
    # The header holds 16 bits; of a longer recording, only the parameters know the length.
    if last == 0xFFFF:
        count = max(count, *(int(each) for each in _lengths(source)))
    size = (4 if real else 2) * (4 * points + _samples(source, points, count, real))
    if points == 0:
        raise FileError(
            f"{source.path}: it holds no points, so there are no markers to show"
            + ("; its rotations are not read" if "ROTATION" in source.groups else "")
        )
    there = min(count, len(source.data) // size)
    if there < count:
        source.notes.append(f"the file says that it has {count} frames, but holds {there}")
    if there <= 0:
        raise FileError(f"{source.path}: it holds no frames")
    if there > _LONGEST:
        source.notes.append(f"of its {there} frames, the first {_LONGEST} are read")
        there = _LONGEST
    return Layout(there, size, real, (size // (4 if real else 2)) - 4 * points)


def _lengths(source: Source) -> list[float]:
    """Return what parameters say about how many frames there are."""
    point, trial = source.groups.get("POINT", {}), source.groups.get("TRIAL", {})
    found = [source.numbers(point.get(name)) for name in ("FRAMES", "LONG_FRAMES")]
    start, end = (source.numbers(trial.get(f"ACTUAL_{name}_FIELD")) for name in ("START", "END"))
    if len(start) == 2 and len(end) == 2:
        found.append([end[0] - start[0] + 65536.0 * (end[1] - start[1]) + 1.0])
    return [0.0, *(each[0] for each in found if each)]


def _samples(source: Source, points: int, frames: int, real: bool) -> int:
    """Return how many analogue samples a frame has.

    Where header and parameters do not agree, the one is right with which the file is fuller.
    """
    told, per_frame = source.words(3)[0], source.words(10)[0]
    used = source.numbers(source.groups.get("ANALOG", {}).get("USED"))
    wanted = int(used[0]) * per_frame if used else told
    width = frames * (4 if real else 2)
    fits = [n for n in {told, wanted} if width * (4 * points + n) <= len(source.data)]
    return int(max(fits, default=told))


def _scale(source: Source) -> float:
    raw = source.header[12:16]
    if source.processor == DEC:
        # DEC: the halves are the other way round, and the exponent is two higher.
        raw = raw[2:4] + raw[0:2]
    return float(struct.unpack(f"{source.order}f", raw)[0])  # only its sign matters


def _header(source: Source, layout: Layout, data_block: int) -> bytes:
    points, _, _, _, gap = source.words(2, 5)
    (per_frame,) = source.words(10)
    scale, rate = source.header[12:16], source.header[20:24]
    if source.processor == MIPS:
        scale, rate = scale[::-1], rate[::-1]
    # It begins with frame 1, so that the 16 bits hold as many as they can.
    words = struct.pack("<5H", points, layout.samples, 1, layout.frames, gap)
    tail = struct.pack("<2H", data_block, per_frame)
    # Events of the header are left out: the parameters have them, with sides and exact times.
    return (bytes((2, 0x50)) + words + scale + tail + rate).ljust(BLOCK, b"\0")


def _complete(source: Source, groups: dict[str, dict[str, Parameter]], layout: Layout) -> None:
    """Give a file the parameters without which nothing can be read, from its header."""
    order = source.order
    point = groups.setdefault("POINT", {})
    analog = groups.setdefault("ANALOG", {})
    if "USED" not in point:
        source.notes.append("its parameters are missing; rate and count are those of its header")
    (points,), (per_frame,) = source.words(2), source.words(10)

    def whole(group: dict[str, Parameter], name: str, value: int) -> None:
        group[name] = Parameter(name, 2, (), struct.pack(f"{order}H", value & 0xFFFF))

    whole(point, "USED", points)
    whole(point, "FRAMES", min(layout.frames, 0xFFFF))
    whole(point, "DATA_START", 0)
    point["SCALE"] = Parameter("SCALE", 4, (), source.header[12:16])
    if "RATE" not in point:
        point["RATE"] = Parameter("RATE", 4, (), source.header[20:24])
    channels = layout.samples // per_frame if per_frame else 0
    whole(analog, "USED", channels)
    offset = analog.pop("OFFSETS", None) or analog.get("OFFSET")
    if offset is not None:
        analog["OFFSET"] = _as_whole(offset, source)
    if channels > _MOST and not {"OFFSET2", "SCALE2"} <= analog.keys():
        raise FileError(f"{source.path}: it says no scale for some of its {channels} channels")
    # Channels of which it says no offset have none, those of which it says no scale have 1.
    one = {2: b"\0\0", 4: _number(1.0, source)}
    for name, kind in (("OFFSET", 2), ("SCALE", 4)):
        known = analog[name].values if name in analog and analog[name].kind == kind else b""
        values = known + one[kind] * (min(channels, _MOST) - len(known) // kind)
        analog[name] = Parameter(name, kind, (len(values) // kind,), values)


def _number(value: float, source: Source) -> bytes:
    """Return a real number as the file writes them."""
    if source.processor != DEC:
        return struct.pack(f"{source.order}f", value)
    raw = struct.pack("<f", 4.0 * value)
    return raw[2:4] + raw[0:2]


def _as_whole(parameter: Parameter, source: Source) -> Parameter:
    """Return offsets that were written as numbers, as the whole numbers that they are."""
    if parameter.kind != 4:
        return parameter
    count = len(parameter.values) // 4
    numbers = struct.unpack(f"{source.order}{count}f", parameter.values)
    values = struct.pack(f"{source.order}{count}h", *(int(number) for number in numbers))
    return Parameter("OFFSET", 2, parameter.shape, values)


def _parameters(groups: dict[str, dict[str, Parameter]], swapped: bool) -> bytes:
    """Return the records of groups and parameters."""
    out = bytearray()
    for number, group in enumerate(groups, start=1):
        name = group.encode("ascii")
        out += struct.pack("<bb", len(name), -number) + name + struct.pack("<HB", 3, 0)
    for number, parameters in enumerate(groups.values(), start=1):
        for each in parameters.values():
            name, values = each.name.encode("ascii"), each.values
            if swapped and each.kind in (2, 4):
                values = np.frombuffer(values, f">u{each.kind}").byteswap().tobytes()
            body = struct.pack("<bB", each.kind, len(each.shape)) + bytes(each.shape)
            body += values + b"\0"
            out += struct.pack("<bb", len(name), number) + name
            out += struct.pack("<H", len(body) + 2) + body
    return bytes(out) + b"\0\0"
