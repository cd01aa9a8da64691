"""The MOTION part of a BVH file: how many frames, how long each, and their numbers."""

import math
import re
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from usdmotion import FileError, Floats
from usdmotion_bvh.source import LARGEST_NUMBER, Source

_FRAMES = re.compile(r"\s*frames\s*:?(.*)", re.IGNORECASE)
_FRAME_TIME = re.compile(r"\s*frame\s*time\s*:?(.*)", re.IGNORECASE)
_FUSED = re.compile(r"(?<=[0-9.])(?=[-+])")
"""Between a digit and a sign: after an E it would be an exponent, so this begins a number."""


@dataclass(frozen=True)
class Rows:
    """The numbers of a motion as they stand in the file."""

    values: Floats
    """One row a frame, one column a channel, shape (frame_count, channel_count)."""
    frame_time: str
    """What the file says after Frame Time; empty where it does not."""
    frame_time_line: int
    first_line: int
    """The line of the first frame."""
    notes: tuple[str, ...]
    """What was mended."""


class _Row(NamedTuple):
    line: int
    text: str

    @property
    def numbers(self) -> list[str]:
        return self.text.split()


def parse_rows(source: Source, motion_line: int, channel_count: int) -> Rows:
    """Read the frames that follow the word MOTION.

    Raises:
        FileError: They do not fit the channels, or cannot be read without guessing.
    """
    claimed = frame_time = ""
    frame_time_line = motion_line
    rows: list[_Row] = []
    for number, line in enumerate(source.lines[motion_line:], start=motion_line + 1):
        if not line or line.isspace():
            continue
        if not rows and (match := _FRAME_TIME.fullmatch(line)):
            frame_time, frame_time_line = match[1].strip(), number
        elif not rows and (match := _FRAMES.fullmatch(line)):
            claimed = match[1].strip()
        else:
            rows.append(_Row(number, line))
    if not rows:
        raise source.refusal(len(source.lines), "the file ends without a single frame of motion")
    notes: list[str] = []
    values = _table(rows, channel_count)
    if values is None:
        rows, notes = _mended(source, rows, channel_count, claimed)
        values = _table(rows, channel_count)
    if values is None:
        raise _not_a_number(source, rows)
    if claimed != str(len(rows)):
        says = f"the header says {claimed or 'no number of'} frames"
        notes.append(f"{says}, the file has {len(rows)}: all of those are read")
    return Rows(values, frame_time, frame_time_line, rows[0].line, tuple(notes))


def _table(rows: list[_Row], channel_count: int) -> Floats | None:
    """Return all numbers in one go, which is fast; nothing where any row is at fault."""
    try:
        values = np.loadtxt([row.text for row in rows], comments=None, ndmin=2)
    except ValueError:
        return None
    fits = values.shape == (len(rows), channel_count)
    return values if fits and np.all(np.abs(values) < LARGEST_NUMBER) else None


def _mended(
    source: Source, rows: list[_Row], channel_count: int, claimed: str
) -> tuple[list[_Row], list[str]]:
    """Return rows that have one number for each channel, and what had to be mended."""
    apart = [row if len(row.numbers) == channel_count else _taken_apart(row) for row in rows]
    odd = [row for row in apart if len(row.numbers) != channel_count]
    if not odd:
        fused = [row.line for row, old in zip(apart, rows, strict=True) if row is not old]
        more = f" and {len(fused) - 1} more" if len(fused) > 1 else ""
        where = f"line {fused[0]}{more}" if fused else ""
        note = f"numbers without a space between them are taken apart at the sign: {where}"
        return apart, [note] if fused else []
    joined = _joined(rows, channel_count)
    if joined and claimed == str(len(joined)):
        return joined, ["frames that stand on several lines are joined"]
    last = rows[-1]
    cut = len(rows) > 1 and [row.line for row in odd] == [last.line]
    if cut and len(last.numbers) < channel_count and _expected(claimed, rows):
        return rows[:-1], [f"the file is cut off in line {last.line}: that frame is left out"]
    wanted = f"a number for each of the {channel_count} channels"
    found = f"this frame has {len(odd[0].numbers)} in place of {wanted}"
    raise source.refusal(odd[0].line, found)


def _expected(claimed: str, rows: list[_Row]) -> bool:
    """Return whether the header speaks of at least as many frames as there are rows."""
    return claimed.isdecimal() and int(claimed) >= len(rows)


def _taken_apart(row: _Row) -> _Row:
    return _Row(row.line, _FUSED.sub(" ", row.text))


def _joined(rows: list[_Row], channel_count: int) -> list[_Row]:
    """Return the frames of rows that are broken over lines; none where a frame ends in a line."""
    joined: list[_Row] = []
    texts: list[str] = []
    for row in rows:
        texts += row.numbers
        if len(texts) == channel_count:
            joined.append(_Row(row.line, " ".join(texts)))
            texts = []
        elif len(texts) > channel_count:
            return []
    return [] if texts else joined


def _not_a_number(source: Source, rows: list[_Row]) -> FileError:
    for row in rows:
        for text in row.numbers:
            try:
                number = float(text)
            except ValueError:
                number = math.nan
            if not abs(number) < LARGEST_NUMBER:
                return source.refusal(row.line, f"'{text}' stands where a number should")
    return source.refusal(rows[0].line, "the frames that begin here are not a table of numbers")
