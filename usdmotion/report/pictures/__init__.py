"""The pictures of a report, one kind a file; all need matplotlib.

Draw inside `drawing()`, which gives them their style.
"""

from collections.abc import Iterator, Sequence

from usdmotion.drawing.style import Picture, drawing, require_matplotlib
from usdmotion.report.findings import EditFindings, Findings
from usdmotion.report.moments import marks, moments
from usdmotion.report.pictures.balance import balance
from usdmotion.report.pictures.changes import changes
from usdmotion.report.pictures.errors import errors
from usdmotion.report.pictures.feet import feet
from usdmotion.report.pictures.overview import overview
from usdmotion.report.pictures.postures import posture
from usdmotion.report.pictures.smoothness import smoothness

__all__ = ["Picture", "drawing", "pictures_of", "postures_of", "require_matplotlib"]


def pictures_of(findings: Findings, edit: EditFindings) -> dict[str, list[Picture]]:
    """Return the pictures of one edit by what they show, those left out that would be empty."""
    found: dict[str, Sequence[Picture | None]] = {
        "overview": [overview(findings, edit)],
        "errors": errors(findings, edit),
        "changes": [changes(findings, edit)],
        "balance": [balance(findings, edit)],
        "feet": [feet(findings, edit)],
        "jerk": [smoothness(findings, edit)],
    }
    return {
        what: [picture for picture in pictures if picture is not None]
        for what, pictures in found.items()
    }


def postures_of(findings: Findings, edit: EditFindings) -> Iterator[Picture]:
    """Yield the picture of each frame of an edit that is worth looking at."""
    for number, moment in enumerate(moments(findings, edit), start=1):
        yield posture(findings, moment, marks(findings, moment.frame), number)
