"""What a reader of captured markers promises about them."""

import numpy as np

from usdmotion.capture import Capture, Cluster, ForcePlate


def check_capture(capture: Capture) -> None:
    """Check that a capture says nothing that cannot be.

    Raises:
        AssertionError: A promise is not kept; the sentence says which.
    """
    assert capture.name.isidentifier(), f"'{capture.name}' must be a valid prim name"
    assert capture.up in ("Y", "Z"), "up must be 'Y' or 'Z'"
    assert capture.frame_rate > 0.0, "the frame rate must be above 0"
    assert len(capture.times) > 0, "a capture must have a frame"
    wanted = np.arange(len(capture.times)) / capture.frame_rate
    assert np.allclose(capture.times, wanted, rtol=0.0, atol=1e-6), (
        "frames must start at 0 s and follow each other at the frame rate"
    )
    _check_markers(capture)
    for cluster in capture.clusters:
        _check_cluster(cluster, capture)
    for plate in capture.plates:
        _check_plate(plate)
    for names in ([c.name for c in capture.clusters], [p.name for p in capture.plates]):
        assert len(names) == len(set(names)), "no two clusters or plates may have one name"
    times = [event.time for event in capture.events]
    assert times == sorted(times), "events must be in the order of their times"
    assert all(event.label for event in capture.events), "every event must have a label"


def _check_markers(capture: Capture) -> None:
    markers = capture.markers
    assert markers.labels and all(markers.labels), "every marker must have a label"
    assert len(set(markers.labels)) == len(markers.labels), "labels must be unique"
    assert np.isfinite(markers.positions).all(), "positions must be finite, seen or not"
    held = ~markers.seen[1:] & (markers.seen.cumsum(axis=0)[:-1] > 0)
    still = (markers.positions[1:] == markers.positions[:-1]).all(axis=2)
    assert still[held].all(), "a marker that is out of sight must stay where it was seen last"


def _check_cluster(cluster: Cluster, capture: Capture) -> None:
    name = cluster.name
    assert name.isidentifier(), f"the cluster '{name}' must have a valid prim name"
    assert len(cluster.labels) >= 3, f"the cluster '{name}' must have three markers"
    assert set(cluster.labels) <= set(capture.markers.labels), (
        f"the markers of the cluster '{name}' must be among the capture's"
    )
    assert len(cluster.translations) == len(capture.times), (
        f"the cluster '{name}' must be placed on every frame"
    )
    lengths = np.linalg.norm(cluster.rotations, axis=1)
    assert np.abs(lengths - 1.0).max() < 1e-6, "rotations must be unit quaternions"


def _check_plate(plate: ForcePlate) -> None:
    name = plate.name
    assert name.isidentifier(), f"the force plate '{name}' must have a valid prim name"
    assert (np.diff(plate.times) > 0.0).all(), f"the samples of '{name}' must be in order"
    values = (plate.corners, plate.forces, plate.moments, plate.centers)
    assert all(np.isfinite(each).all() for each in values), f"'{name}' must be finite"
