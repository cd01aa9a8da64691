"""What whoever planted feet should look at: what is not held, and what did not stand."""

from collections.abc import Iterator

from usdmotion.constraints import ContactConstraint
from usdmotion.report.planting import slide_of
from usdmotion.report.verdict import EditReport
from usdmotion.report.wording import amount
from usdmotion.scene import Edit, Scene

FAR = 0.05
"""What goes so far from its mean place while it is held did not stand, but move [m]: feet that
skate slide by less, and an ankle that rolls over its ball goes farther."""
NAMED = 4
"""How many contacts a sentence names."""


def not_held(edit: EditReport) -> Iterator[str]:
    """Yield a sentence about the contacts of an edit that are not met, the worst first."""
    contacts = [row for row in edit.constraints if row.type == ContactConstraint.schema]
    missed = {row.path: row.max for row in contacts if not row.met}
    if missed:
        times = {row.path: row.worst_time for row in contacts}
        worst = max(missed, key=lambda path: missed[path])
        yield (
            f"{edit.path}: {len(missed)} of {len(contacts)} contacts are not held, the worst by "
            f"{amount(missed[worst], 'm')} at {times[worst]:g}: {_names(edit.path, missed)}; "
            "make them shorter, or switch off what asks for too much"
        )


def not_still(scene: Scene, edit: Edit) -> Iterator[str]:
    """Yield a sentence about the contacts of an edit that hold what goes far in the source."""
    cast = scene.cast
    source = cast.positions, cast.orientations
    slides: dict[str, float] = {}
    for each in edit.constraints:
        if isinstance(each, ContactConstraint) and (when := each.plateau(cast)).any():
            slides[each.path] = slide_of(cast, each, when, source)
    far = {path: slide for path, slide in slides.items() if slide > FAR}
    if far:
        yield (
            f"{edit.path}: {len(far)} of {len(slides)} contacts hold what goes by up to "
            f"{amount(max(far.values()), 'm')} meanwhile, so that limbs are moved far: "
            f"{_names(edit.path, far)}; see whether it stands there"
        )


def _names(above: str, amounts: dict[str, float]) -> str:
    """Return the names of some prims below another, the largest amount first."""
    paths = sorted(amounts, key=lambda path: -amounts[path])
    names = ", ".join(path.removeprefix(f"{above}/") for path in paths[:NAMED])
    more = len(paths) - NAMED
    return f"{names} and {more} more" if more > 0 else names
