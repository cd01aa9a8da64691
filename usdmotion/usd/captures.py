"""A capture becomes a stage of its own: markers, clusters, plates, events, a fitted skeleton."""

from pathlib import Path

from pxr import Usd, UsdGeom

from usdmotion.capture import Capture
from usdmotion.usd.event_authoring import author_events
from usdmotion.usd.marker_authoring import author_cluster, author_markers
from usdmotion.usd.new_stages import new_stage
from usdmotion.usd.plate_authoring import author_plate
from usdmotion.usd.recordings import author_recording, codes_of


def write_capture(
    capture: Capture, output: Path, *, frame_rate: float | None = None, first: float = 1.0
) -> None:
    """Write a stage with everything that was captured.

    Args:
        capture: What was captured.
        output: The layer to write.
        frame_rate: Time codes per second; None is the capture's frames per second.
        first: Time code of the first frame.

    Raises:
        FileError: It cannot be written there.
    """
    rate = frame_rate or capture.frame_rate
    codes = codes_of(capture.times, rate, first)
    root = f"/{capture.name}"
    with new_stage(
        output,
        frame_rate=rate,
        first=float(codes[0]),
        last=float(codes[-1]),
        up=capture.up,
        root=capture.name,
    ) as stage:
        UsdGeom.Xform.Define(stage, root)
        author_markers(stage, f"{root}/Markers", capture.markers, codes)
        _below(stage, f"{root}/Clusters", capture.clusters)
        for cluster in capture.clusters:
            author_cluster(stage, f"{root}/Clusters/{cluster.name}", cluster, codes)
        _below(stage, f"{root}/Plates", capture.plates)
        for plate in capture.plates:
            path = f"{root}/Plates/{plate.name}"
            author_plate(stage, path, plate, codes_of(plate.times, rate, first))
        _below(stage, f"{root}/Events", capture.events)
        author_events(stage, f"{root}/Events", capture.events, rate, first)
        if capture.fitted is not None:
            author_recording(stage, f"{root}/Body", capture.fitted, codes)


def _below(stage: Usd.Stage, path: str, things: tuple[object, ...]) -> None:
    if things:
        UsdGeom.Scope.Define(stage, path)
