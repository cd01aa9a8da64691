"""Small C3D files of our own making."""

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import pytest

from usdmotion.arrays import Floats

Write = Callable[..., Path]


@pytest.fixture
def write_c3d(tmp_path: Path) -> Write:
    """Return what writes a file from points in its units, NaN where they are not seen."""
    ezc3d = pytest.importorskip("ezc3d", reason="C3D needs the extra 'c3d'")

    def write(
        points: Floats,
        labels: list[str],
        *,
        name: str = "trial.c3d",
        rate: float = 100.0,
        first: int = 1,
        channels: Floats | None = None,
        parameters: Mapping[str, Mapping[str, object]] | None = None,
    ) -> Path:
        content = ezc3d.c3d()
        content["header"]["points"]["first_frame"] = first - 1
        point = content["parameters"]["POINT"]
        point["RATE"]["value"] = [rate]
        point["LABELS"]["value"] = labels
        point["UNITS"]["value"] = ["mm"]
        padded = np.concatenate([points, np.ones((*points.shape[:2], 1))], axis=2)
        content["data"]["points"] = padded.transpose(2, 1, 0)
        if channels is not None:
            factor = len(channels) // len(points)
            content["parameters"]["ANALOG"]["RATE"]["value"] = [rate * factor]
            names = [f"A{each}" for each in range(channels.shape[1])]
            content["parameters"]["ANALOG"]["LABELS"]["value"] = names
            content["data"]["analogs"] = channels.T[None]
        for group, values in (parameters or {}).items():
            for key, value in values.items():
                content.add_parameter(group, key, value)
        path = tmp_path / name
        content.write(str(path))
        return path

    return write


@pytest.fixture
def standing() -> tuple[Floats, list[str]]:
    """Return points [mm] and labels of a head over a foot that both drift along x, Z up."""
    frames = np.arange(20)[:, None]
    drift = 50.0 * frames * np.array([1.0, 0.0, 0.0])
    places = ((0.0, 0.0, 1700.0), (20.0, 100.0, 1650.0), (0.0, 0.0, 50.0), (90.0, 100.0, 40.0))
    labels = ["TOP", "EAR", "HEEL", "TIP"]
    points = drift[:, None] + np.array(places)
    # Heights are not quite still, so that no axis is without an answer.
    points[..., 2] += 5.0 * np.sin(frames)
    return points, labels
