"""Skeletons that nobody has thought of, written as text and read back."""

import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from usdmotion_bvh import BvhReader

POSITIONS = [f"{axis}position" for axis in "XYZ"]
ROTATIONS = [f"{axis}rotation" for axis in "XYZ"]


@dataclass
class Style:
    tab: str
    end: str
    number: str


styles = st.builds(
    Style,
    tab=st.sampled_from(["\t", "  ", ""]),
    end=st.sampled_from(["\n", "\r\n"]),
    number=st.sampled_from(["{:.6f}", "{:.12g}", "{:.9e}"]),
)


@st.composite
def texts(draw: st.DrawFn) -> str:
    """Draw a file: any tree, any channels in any order, any numbers."""
    style = draw(styles)
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    parents = [-1] + [int(rng.integers(0, index)) for index in range(1, draw(st.integers(1, 9)))]
    columns: list[float] = []
    """Spread of each column around its middle; positions below the root stay near to OFFSET."""
    middles: list[float] = []

    def numbers(values: np.ndarray) -> str:
        return " ".join(style.number.format(value) for value in values)

    def joint(index: int, depth: int) -> list[str]:
        channels = list(rng.permutation(ROTATIONS)[: draw(st.integers(0, 3))])
        offset = rng.normal(size=3) * (5.0 * (rng.random() > 0.2))
        if index == 0 or draw(st.integers(0, 5)) == 0:
            place = draw(st.sampled_from([0, len(channels)]))
            channels[place:place] = POSITIONS
        for channel in channels:
            turns = channel.endswith("rotation")
            columns.append(180.0 if turns else 50.0 if index == 0 else 0.0)
            middles.append(0.0 if turns else offset["XYZ".index(channel[0])])
        body = [f"OFFSET {numbers(offset)}", f"CHANNELS {len(channels)} {' '.join(channels)}"]
        below = [child for child, parent in enumerate(parents) if parent == index]
        for child in below:
            body += joint(child, depth + 1)
        if not below:
            body += ["End Site", "{", f"OFFSET {numbers(rng.normal(size=3))}", "}"]
        word = "JOINT" if depth else "ROOT"
        return [f"{word} joint {index}", "{", *(style.tab + line for line in body), "}"]

    lines = ["HIERARCHY", *joint(0, 0)]
    rows = rng.uniform(-1, 1, (draw(st.integers(1, 4)), len(columns))) * columns + middles
    lines += ["MOTION", f"Frames: {len(rows)}", "Frame Time: 0.01", *map(numbers, rows)]
    return style.end.join(lines) + style.end


@settings(max_examples=60, deadline=None)
@given(text=texts())
def test_poses_are_those_of_the_text(farthest_off: Callable[..., float], text: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "drawn.bvh"
        path.write_bytes(text.encode())
        recording = BvhReader(unit=0.5, root="absolute", up="Y").read(path)
        frames = range(recording.motion.frame_count)
        off = farthest_off(recording, path, 0.5, relative=False, frames=frames)
    assert off < 1e-9
