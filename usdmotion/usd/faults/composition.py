"""What could not be composed: files that are not there, arcs that lead nowhere."""

from collections.abc import Iterator

from pxr import Usd

from usdmotion.usd.faults.fault import Fault


def find_composition_errors(stage: Usd.Stage) -> Iterator[Fault]:
    """Find what could not be composed: files that are not there, arcs that lead nowhere."""
    for error in stage.GetCompositionErrors():
        path = str(error.rootSite.path)
        said = " ".join(str(error).split())
        yield Fault(path, "Composition", f"<{path}> does not compose: {said}")
