"""What ezc3d makes of a C3D file, as arrays."""

import warnings
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from usdmotion import FileError, Floats
from usdmotion_c3d.copies import sound_copy
from usdmotion_c3d.records import read_source


@dataclass(frozen=True, eq=False)
class Trial:
    """The contents of a C3D file, in its own units and axes."""

    path: Path
    points: Floats
    """Positions, NaN where a point was not seen, shape (frame_count, point_count, 3)."""
    analog: Floats
    """Channels in their units, shape (sample_count, channel_count)."""
    rate: float
    """Frames of the points per second."""
    analog_rate: float
    """Samples of the channels per second."""
    first: int
    """Number of the first frame of the recording, which begins with 1."""
    parameters: dict[str, dict[str, Any]]
    """Values of the parameters by group and name."""
    notes: tuple[str, ...]

    def texts(self, group: str, *names: str) -> list[str]:
        """Return the texts of a parameter and those that go on with it; empty where it has none."""
        found: list[str] = []
        for name in names:
            value = self.parameters.get(group, {}).get(name, ())
            found += [str(text).strip(" \0") for text in np.ravel(value)]
        return found

    def numbers(self, group: str, name: str) -> Floats:
        """Return the numbers of a parameter; of length 0 where it has none."""
        value = np.asarray(self.parameters.get(group, {}).get(name, ()))
        return value.astype(np.float64) if value.dtype.kind in "iuf" else np.zeros(0)


def read_trial(path: Path, wanted: float = 0.0) -> Trial:
    """Read a C3D file.

    Args:
        path: The file.
        wanted: Frames per second, whatever the file says; 0 takes what it says.

    Raises:
        FileError: ezc3d is not there, or the file cannot be read.
    """
    source = read_source(path)
    content = _load(path, sound_copy(source))
    points = np.array(content["data"]["points"][:3], dtype=np.float64)
    # Many makers write a point that was not seen as one at the very origin.
    points[:, (points == 0.0).all(axis=0)] = np.nan
    analog = np.array(content["data"]["analogs"][0], dtype=np.float64)
    parameters = {
        group: {
            name: entry["value"]
            for name, entry in entries.items()
            if isinstance(entry, dict) and "value" in entry
        }
        for group, entries in content["parameters"].items()
    }
    rate = wanted or _rate(path, parameters)
    frames = points.shape[2]
    return Trial(
        path=path,
        points=np.ascontiguousarray(points.transpose(2, 1, 0)),
        analog=np.ascontiguousarray(analog.T),
        rate=rate,
        analog_rate=rate * analog.shape[1] / frames,
        first=source.first_frame,
        parameters=parameters,
        notes=tuple(source.notes),
    )


def _load(path: Path, copy: bytes) -> Any:
    """Return what ezc3d makes of the sound copy of a file."""
    try:
        import ezc3d
    except ImportError as error:
        raise FileError(
            f"{path}: C3D files are read with ezc3d, which is not installed; run "
            "pip install 'usdmotion[c3d]'"
        ) from error
    with TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        sound = Path(folder) / "sound.c3d"
        sound.write_bytes(copy)
        try:
            return ezc3d.c3d(str(sound))
        except Exception as error:
            what = str(error).replace("\n", " ").strip(" .")
            raise FileError(f"{path}: ezc3d cannot read it: {what}") from error


def _rate(path: Path, parameters: dict[str, dict[str, Any]]) -> float:
    rate = float(np.ravel(parameters["POINT"]["RATE"])[0])
    if not (np.isfinite(rate) and rate > 0.0):
        raise FileError(f"{path}: it says no frame rate; set the option `rate`")
    return rate
