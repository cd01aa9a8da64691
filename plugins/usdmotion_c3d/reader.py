"""The reader of C3D files."""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np

from usdmotion import Capture, Markers, option
from usdmotion_c3d.events import read_events
from usdmotion_c3d.plates import corners_of, read_plates
from usdmotion_c3d.points import choose_markers, fill_gaps
from usdmotion_c3d.scales import decide_up, metres_of, upright
from usdmotion_c3d.trials import read_trial


@dataclass(frozen=True)
class C3dReader:
    """Reads C3D files of any maker; what a file leaves open is decided from its data and said."""

    name: ClassVar[str] = "c3d"
    suffixes: ClassVar[tuple[str, ...]] = (".c3d",)

    rate: float = option(
        0.0, "Frames per second where the file's rate is wrong; 0 trusts it.", minimum=0.0
    )
    unit: float = option(0.0, "Metres per unit of the file; 0 is what the file says.", minimum=0.0)
    up: str = option(
        "auto",
        "The axis of the file that points up.",
        choices=("auto", "X", "Y", "Z", "-X", "-Y", "-Z"),
    )
    force_rate: float = option(
        0.0, "Samples per second of the force plates; 0 is one for each frame.", minimum=0.0
    )

    def read(self, path: Path) -> Capture:
        """Read one file.

        Raises:
            FileError: The file is refused; one sentence with the file.
        """
        trial = read_trial(path, self.rate)
        kept, labels, notes = choose_markers(trial)
        metres = metres_of(trial, self.unit, notes)
        raw = trial.points[:, kept] * metres[kept, None]
        metre = float(np.median(metres))
        up, axes = upright(decide_up(trial, raw, corners_of(trial, metre), self.up, notes))
        height = "XYZ".index(up)
        plates = read_plates(trial, metre, axes, height, self.force_rate, notes)
        return Capture(
            name=_name(path),
            up=up,
            frame_rate=trial.rate,
            times=np.arange(len(raw)) / trial.rate,
            markers=Markers(labels, fill_gaps(raw) @ axes.T, ~np.isnan(raw[..., 0])),
            plates=plates,
            events=read_events(trial),
            notes=(*trial.notes, *notes),
        )


def _name(path: Path) -> str:
    """Return a prim name like that of a file."""
    name = re.sub(r"\W", "_", path.stem, flags=re.ASCII)
    return name if name[:1].isalpha() or name[:1] == "_" else f"_{name}"
