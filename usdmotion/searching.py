"""Contacts of a shot: looked for by a detector, written where they can be solved."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from usdmotion.answering import Say
from usdmotion.arrays import Floats
from usdmotion.asking import Asked
from usdmotion.curves import Spline
from usdmotion.detecting import KINDS, Detected, Detector, Search
from usdmotion.errors import PluginError, SceneError
from usdmotion.options import configured
from usdmotion.options import options as options_of
from usdmotion.plugins import host
from usdmotion.report.contacts import ContactReport, DetectionReport, ObjectReport, PatternReport

if TYPE_CHECKING:
    from usdmotion.usd import Stage
    from usdmotion.usd.detections import Authored, Entry, Found, Sought
    from usdmotion.usd.overlays import Overlay


def search(shot: Path, output: Path, asked: Asked, *, say: Say = lambda _: None) -> DetectionReport:
    """Look for contacts on a shot, and write a layer over it that has them.

    Args:
        shot: The stage.
        output: The layer to write; the shot is its sublayer.
        asked: What to look at, and for what.
        say: Is told what is being done.

    Raises:
        InputError: The stage, or what is asked for, is at fault.
        PluginError: A detector does not keep its contract.
    """
    from usdmotion.usd import Overlay

    say(f"reading {shot}")
    overlay = Overlay.open(shot, output)
    report = search_over(overlay, asked, say=say)
    say(f"writing {output}")
    overlay.write()
    return report


def search_over(overlay: Overlay, asked: Asked, *, say: Say = lambda _: None) -> DetectionReport:
    """Look for contacts on what a layer and its shot show, and put them into the layer.

    Nothing is written to disk.

    Args:
        overlay: The layer over its shot.
        asked: What to look at, and for what.
        say: Is told what is being done.

    Raises:
        InputError: The stage, or what is asked for, is at fault.
        PluginError: A detector does not keep its contract.
    """
    report, told = search_stage(overlay.stage, overlay.shot, asked, say=say)
    overlay.remember(detection=told)
    return report


def search_stage(
    stage: Stage, name: Path, asked: Asked, *, say: Say = lambda _: None
) -> tuple[DetectionReport, dict[str, object]]:
    """Look for contacts on a stage that is open, and put them into its edit target.

    Args:
        stage: The stage; its edit target is its strongest layer.
        name: How the stage is called in an error.
        asked: What to look at, and for what.
        say: Is told what is being done.

    Returns:
        What was found, and what the layer is to say of it.

    Raises:
        InputError: The stage, or what is asked for, is at fault.
        PluginError: A detector does not keep its contract.
    """
    from usdmotion import usd

    try:
        usd.require_composed(stage)
        searches = usd.read_searches(stage, asked)
    except SceneError as error:
        raise SceneError(f"{name}: {error}") from error
    found = []
    for each in searches:
        say(f"looking at {each.search.name}")
        found.append(_found(each))
    authored = usd.author_detections(stage, found)
    if asked.guides:
        usd.author_contact_guides(stage, authored)
    report = DetectionReport(
        tuple(_object(each) for each in authored),
        tuple(dict.fromkeys(note for each in authored for note in each.notes)),
    )
    return report, usd.detection_provenance(authored, report.notes)


def _found(sought: Sought) -> Found:
    """Return what the detector that is asked for finds, with all the options that it has."""
    from usdmotion.usd import Found

    kind = host().detector(sought.detector)
    detector = configured(kind, sought.options)
    detected = _checked(detector, sought.search)
    options = {each.name: getattr(detector, each.name) for each in options_of(kind)}
    return Found(sought, detected, options)


def _checked(detector: Detector, search: Search) -> Detected:
    """Return what a detector finds, and hold it to its contract.

    Raises:
        PluginError: What it gives back cannot be written.
    """
    detected = detector.detect(search)
    if not isinstance(detected, Detected):
        raise PluginError(
            f"the detector '{detector.name}' returns {type(detected).__name__}, not Detected"
        )
    first, last = float(search.times[0]) - 1e-6, float(search.times[-1]) + 1e-6
    for each in detected.contacts:
        if each.kind not in KINDS or not first <= each.start <= each.end <= last:
            raise PluginError(
                f"the detector '{detector.name}' finds a contact of the kind '{each.kind}' from "
                f"{each.start:g} to {each.end:g} s on {search.name}, which is none within "
                f"{search.times[0]:g} to {search.times[-1]:g} s"
            )
    return detected


def _object(authored: Authored) -> ObjectReport:
    sought = authored.found.sought
    codes = sought.trajectory.time_codes
    rate = sought.facts.time_codes_per_second
    return ObjectReport(
        path=sought.path,
        object=sought.object,
        detector=sought.detector,
        kinds=sought.search.kinds,
        frames=len(codes),
        first=float(codes[0]),
        last=float(codes[-1]),
        pattern=_pattern(authored.found),
        contacts=tuple(_contact(sought.path, entry, rate) for entry in authored.entries),
    )


def _contact(path: str, entry: Entry, rate: float) -> ContactReport:
    return ContactReport(
        path=f"{path}/{entry.name}",
        kind=entry.interval.kind,
        start=entry.interval.start,
        end=entry.interval.end,
        seconds=(entry.interval.end - entry.interval.start) / rate,
        residual=entry.contact.residual if entry.contact and entry.found else None,
        state=entry.state,
    )


def _pattern(found: Found) -> PatternReport | None:
    pattern = found.detected.pattern
    if pattern is None:
        return None
    times = found.sought.search.times
    return PatternReport(
        found.given_by, _range(pattern.sigma, times), _range(pattern.epsilon, times)
    )


def _range(spline: Spline, times: Floats) -> tuple[float, float]:
    values = spline.at(times)
    return float(values.min()), float(values.max())
