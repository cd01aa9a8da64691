"""The unit and the axes of a file: what it says, or what its data tell."""

import re
import warnings
from collections.abc import Sequence
from typing import Literal

import numpy as np

from usdmotion import FileError, Floats
from usdmotion_c3d.trials import Trial

_UNITS = {"mm": 0.001, "mill": 0.001, "cm": 0.01, "cent": 0.01, "dm": 0.1, "deci": 0.1}
_UNITS |= {"m": 1.0, "mete": 1.0, "metr": 1.0, "in": 0.0254, "inch": 0.0254}
_UNITS |= {"ft": 0.3048, "feet": 0.3048, "foot": 0.3048}
"""Metres by the first letters of a unit, as many as the files keep."""
_SCREEN = re.compile(r"([+-]?)([XYZ])", re.IGNORECASE)
_ROOM = 30.0
"""No volume in which people are captured is larger than this [m]."""
_CLEAR = 5.0
"""An axis that a file says is doubted only where another one looks so much more upright."""
_CUBES = {
    # Rotations that lay an axis on the one that USD has for it, as rows.
    "+Y": np.eye(3),
    "+Z": np.eye(3),
    "-Y": np.diag((1.0, -1.0, -1.0)),
    "-Z": np.diag((1.0, -1.0, -1.0)),
    "+X": np.array(((0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))),
    "-X": np.array(((0.0, 1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, 1.0))),
}


def metres_of(trial: Trial, wanted: float, notes: list[str]) -> Floats:
    """Return the metres per unit of each point, shape (point_count,).

    Args:
        trial: The file.
        wanted: What somebody says that it is; 0 takes what the file says, or its data.
        notes: Is told what was decided.

    Raises:
        FileError: The file names a unit that is no length.
    """
    count = trial.points.shape[1]
    if wanted > 0.0:
        return np.full(count, wanted)
    said = [text.lower() for text in trial.texts("POINT", "UNITS")]
    if not any(said):
        spread = np.nanpercentile(np.abs(trial.points), 95)
        unit = 0.001 if spread > _ROOM else 1.0
        name = "millimetres" if unit < 1.0 else "metres"
        notes.append(f"no unit is said; the positions look like {name}; `unit` says otherwise")
        return np.full(count, unit)
    if len(said) < count:
        said = [said[0]] * count
    return np.array([_length(text or said[0], trial) for text in said[:count]])


def _length(text: str, trial: Trial) -> float:
    for letters in (text, text[:4], text.rstrip("s")):
        if letters in _UNITS:
            return _UNITS[letters]
    raise FileError(
        f"{trial.path}: POINT:UNITS is '{text}', which is no length that is known; set `unit` to "
        "the metres of one"
    )


def decide_up(
    trial: Trial, markers: Floats, corners: Sequence[Floats], wanted: str, notes: list[str]
) -> str:
    """Return the axis of the file that points up, with its sign.

    Args:
        trial: The file.
        markers: Positions, NaN where not seen, shape (frame_count, marker_count, 3).
        corners: Of each force plate, shape (4, 3).
        wanted: What somebody says that it is, or "auto".
        notes: Is told what was decided.
    """
    if wanted != "auto":
        return wanted if wanted[0] in "+-" else f"+{wanted}"
    screen = trial.texts("POINT", "Y_SCREEN")
    said = _SCREEN.fullmatch(screen[0]) if screen else None
    up = f"{said[1] or '+'}{said[2].upper()}" if said else ""
    floor, body = _floor(corners, markers), _upright(markers, up)
    if up:
        told = f"the file's own picture has {up} there"
    else:
        told = "the file does not say"
    if floor and floor != up:
        notes.append(f"{floor} is up, as it is across the force plates, under the markers; {told}")
        return floor
    if not floor and body != up:
        notes.append(f"{body} is up, as the markers stand along it; {told}; `up` says otherwise")
        return body
    return up


def _floor(corners: Sequence[Floats], markers: Floats) -> str:
    """Return the axis across the force plates, towards the markers; "" where they do not agree."""
    ups = set()
    for each in corners:
        normal = np.cross(each[1] - each[0], each[2] - each[0])
        size = np.linalg.norm(normal)
        axis = int(np.abs(normal).argmax())
        if size == 0.0 or abs(normal[axis]) < 0.95 * size:
            return ""
        height = np.nanmedian(markers[..., axis]) - each[:, axis].mean()
        ups.add(f"{'+' if height > 0.0 else '-'}{'XYZ'[axis]}")
    return ups.pop() if len(ups) == 1 else ""


def _upright(markers: Floats, up: str) -> str:
    """Return the axis along which a body is spread most for what it moves along it.

    People stand, and walk about: their markers are far apart in height, and each stays at its own.

    Args:
        markers: Positions, NaN where not seen, shape (frame_count, marker_count, 3).
        up: The axis that is said to be up; another one must show it clearly to be believed.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        spread = np.nanstd(np.nanmean(markers, axis=0), axis=0)
        moving = np.nanmean(np.nanstd(markers, axis=0), axis=0)
    scores = spread / np.maximum(moving, 1e-3 * spread.max() + 1e-9)
    expected = "XYZ".index(up[1]) if up else (2 if scores[2] > scores[1] else 1)
    best = int(scores.argmax())
    clear = scores[best] > _CLEAR * scores[expected] and spread[best] > 2.0 * spread[expected]
    if best == expected or not clear:
        return up or f"+{'XYZ'[expected]}"
    return f"+{'XYZ'[best]}"


def upright(up: str) -> tuple[Literal["Y", "Z"], Floats]:
    """Return the axis that is up on the stage, and the rotation of the file's axes to it (3, 3)."""
    return ("Z" if up[1] == "Z" else "Y"), _CUBES[up]
