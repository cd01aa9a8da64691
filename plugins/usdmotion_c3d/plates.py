"""The force plates of a file: where they are, and how they pushed back."""

from dataclasses import dataclass

import numpy as np

from usdmotion import Bools, Floats, ForcePlate
from usdmotion_c3d.trials import Trial
from usdmotion_c3d.wrenches import CHANNELS, plate_axes, wrench

_LOADED = 20.0
"""Force across a plate that tells a foot from noise [N]."""
_OFFSET = 100.0
"""An empty plate is not off by more than this [N]."""
_QUIET = 10.0
"""Nor does it change by more than this meanwhile [N]."""
_HEAVY = 50.0
"""From this on, the sign of a force says which way it is [N]."""

_NEAR, _FAR = 0.002, 0.6
"""How far from the middle of a plate people tread, as shares of its diagonal."""


@dataclass(frozen=True)
class _Plate:
    """What a file says of a plate; lengths in metres, axes of the stage."""

    number: int
    kind: int
    corners: Floats
    origin: Floats
    matrix: Floats
    channels: Floats


def corners_of(trial: Trial, metre: float) -> list[Floats]:
    """Return the corners of each plate in the axes of the file [m], shape (4, 3) each."""
    corners = trial.numbers("FORCE_PLATFORM", "CORNERS")
    used = trial.numbers("FORCE_PLATFORM", "USED").ravel()
    if corners.ndim != 3 or corners.shape[:2] != (3, 4):
        return []
    count = min(int(used[0]) if len(used) else 0, corners.shape[2])
    return [metre * corners[:, :, each].T for each in range(count)]


def read_plates(
    trial: Trial, metre: float, axes: Floats, up: int, rate: float, notes: list[str]
) -> tuple[ForcePlate, ...]:
    """Return the force plates.

    Forces are those of the plate on the body, in the axes of the stage. They are the mean over each
    frame of the markers, around its instant, so that what is faster does not show as something
    slow; `rate` asks for more.

    Args:
        trial: The file.
        metre: Metres in its unit of length.
        axes: Rotation of its axes to those of the stage, shape (3, 3).
        up: The axis of the stage that points up.
        rate: Samples per second; 0 is one for each frame.
        notes: Is told what was decided.
    """
    found = []
    for plate in _plates(trial, metre, axes, notes):
        forces, moments = _measured(plate, trial, metre, notes)
        step = max(round(trial.analog_rate / (rate or trial.rate)), 1) if len(forces) else 1
        vertical = plate_axes(plate.corners)[:, 2]
        normal = vertical * np.sign(vertical[up] or 1.0)
        forces, moments = _pushing(forces, moments, normal, plate, notes)
        times = np.arange(0, len(forces), step) / max(trial.analog_rate, 1.0)
        forces, moments = _means(forces, step), _means(moments, step)
        loaded = forces @ normal > _LOADED
        found.append(
            ForcePlate(
                name=f"Plate{plate.number}",
                corners=plate.corners,
                times=times,
                forces=forces,
                moments=moments,
                centers=_centers(forces, moments, normal, loaded) + plate.corners.mean(axis=0),
                loaded=loaded,
            )
        )
    return tuple(found)


def _plates(trial: Trial, metre: float, axes: Floats, notes: list[str]) -> list[_Plate]:
    kinds = trial.numbers("FORCE_PLATFORM", "TYPE").ravel()
    origins = trial.numbers("FORCE_PLATFORM", "ORIGIN")
    wanted = trial.numbers("FORCE_PLATFORM", "CHANNEL")
    matrices = trial.numbers("FORCE_PLATFORM", "CAL_MATRIX")
    found = []
    for each, corners in enumerate(corners_of(trial, metre)):
        name = f"force plate {each + 1}"
        kind = int(kinds[each]) if each < len(kinds) else 0
        if kind not in CHANNELS:
            notes.append(f"{name} is of type {kind}, which is not read; left out")
            continue
        channels = _channels(trial, wanted, each, CHANNELS[kind])
        if not len(channels):
            notes.append(f"{name} has no channels with its forces; only its place is shown")
        if np.linalg.norm(np.cross(corners[0] - corners[2], corners[1] - corners[3])) < 1e-6:
            notes.append(f"{name} has corners that span no face; left out")
            continue
        full = kind == 4 and matrices.ndim == 3 and matrices.shape[:2] == (6, 6)
        found.append(
            _Plate(
                number=each + 1,
                kind=kind,
                corners=corners @ axes.T,
                origin=metre * origins[:, each] if origins.ndim == 2 else np.zeros(3),
                matrix=matrices[:, :, each] if full else np.eye(6),
                channels=channels,
            )
        )
    return found


def _channels(trial: Trial, wanted: Floats, plate: int, count: int) -> Floats:
    """Return the channels of a plate; no samples where the file does not have them."""
    numbers = wanted[:count, plate].astype(int) - 1 if wanted.ndim == 2 else np.zeros(0, dtype=int)
    there = len(numbers) == count and numbers.min() >= 0
    if not there or numbers.max() >= trial.analog.shape[1]:
        return np.zeros((0, count))
    return np.asarray(trial.analog[:, numbers])


def _measured(plate: _Plate, trial: Trial, metre: float, notes: list[str]) -> tuple[Floats, Floats]:
    """Return forces [N] and moments about the middle of the face [N m], in the stage's axes.

    The unit of length of moments is seldom said and sometimes wrongly: it is the first of the
    file's own, millimetres and metres with which the pressure is on the plate.
    """
    channels = _zeroed(plate, trial)
    axes = plate_axes(plate.corners)
    size = np.linalg.norm(plate.corners[0] - plate.corners[2])
    tried = []
    for arm in (metre, *sorted({0.001, 1.0} - {metre})):
        forces, moments = wrench(plate.kind, channels, plate.origin, plate.matrix, arm)
        _, raw = wrench(plate.kind, channels, np.zeros(3), plate.matrix, arm)
        heavy = np.abs(forces[:, 2]) > _HEAVY
        away = np.linalg.norm(raw[heavy, :2], axis=1) / np.abs(forces[heavy, 2])
        tried.append((forces @ axes.T, moments @ axes.T))
        # What is a thousand times too small is on the face too: always in its very middle.
        if plate.kind == 3 or not heavy.any() or _NEAR * size < np.median(away) < _FAR * size:
            return tried[-1]
    notes.append(f"the pressure on force plate {plate.number} is not on its face")
    return tried[0]


def _zeroed(plate: _Plate, trial: Trial) -> Floats:
    """Return the channels without what they show while nothing is on the plate.

    FORCE_PLATFORM:ZERO names the frames for it; where somebody stands on the plate meanwhile, they
    are no zero.
    """
    named = trial.numbers("FORCE_PLATFORM", "ZERO").ravel()
    if plate.kind == 1 or len(named) < 2 or not len(plate.channels):
        return plate.channels
    step = round(trial.analog_rate / trial.rate)
    rows = slice((max(int(named[0]), 1) - 1) * step, int(named[1]) * step)
    rest = plate.channels[rows]
    if len(rest) == 0:
        return plate.channels
    forces, _ = wrench(plate.kind, rest, plate.origin, plate.matrix, 1.0)
    across = forces[:, 2]
    if abs(across.mean()) > _OFFSET or np.ptp(across) > _QUIET:
        return plate.channels
    return np.asarray(plate.channels - rest.mean(axis=0))


def _pushing(
    forces: Floats, moments: Floats, normal: Floats, plate: _Plate, notes: list[str]
) -> tuple[Floats, Floats]:
    """Return the wrench of the plate on the body, whichever of the two the file holds."""
    across = forces @ normal
    heavy = np.abs(across) > _HEAVY
    if heavy.any() and np.median(across[heavy]) < 0.0:
        notes.append(f"force plate {plate.number} holds the force on it; its reaction is shown")
        return -forces, -moments
    return forces, moments


def _means(values: Floats, step: int) -> Floats:
    """Return the mean of so many samples around every so-manieth, (sample_count, 3)."""
    if step == 1 or not len(values):
        return values
    sums = np.concatenate([np.zeros((1, 3)), np.cumsum(values, axis=0)])
    middles = np.arange(0, len(values), step)
    starts = np.maximum(middles - step // 2, 0)
    ends = np.minimum(middles - step // 2 + step, len(values))
    return np.asarray((sums[ends] - sums[starts]) / (ends - starts)[:, None])


def _centers(forces: Floats, moments: Floats, normal: Floats, loaded: Bools) -> Floats:
    """Return where a force attacks on the face, from its middle [m], (sample_count, 3).

    There the moment has no part but that about the normal.
    """
    across = np.where(loaded, forces @ normal, 1.0)
    centers = np.cross(normal, moments) / across[:, None]
    if not loaded.any():
        return np.zeros_like(centers)
    samples = np.arange(len(loaded))
    last = np.maximum.accumulate(np.where(loaded, samples, -1))
    return np.asarray(centers[np.where(last < 0, loaded.argmax(), last)])
