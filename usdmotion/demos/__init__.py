"""The stages that the project makes itself: one figure of a paper a module."""

from importlib import import_module
from pathlib import Path

from usdmotion.errors import FileError

NAMES = (
    "reaching",
    "reaching_again",
    "goals",
    "sunshade",
    "against_the_wind",
    "stepping",
    "stepping_weighted",
    "karate",
    "karate_weighted",
    "raised_arms",
    "elbow_and_wrist",
    "stairs",
    "strictness",
    "ranks",
    "recruiting",
    "limits",
    "nothing_asked",
    "activation",
    "above_the_table",
    "two_hands",
    "wrist_and_elbow",
    "grasp",
    "trunk_last",
    "per_articulation",
    "terrain",
    "fight",
    "dice",
    "taps",
    "skating",
    "growing",
    "dance_company",
    "handstand",
    "crawl",
)
"""Every demo, in the order in which they explain themselves."""


def build(name: str, folder: Path) -> Path:
    """Write the stage of a demo into a folder, which is made where it is missing.

    Args:
        name: One of `NAMES`.
        folder: Where; the stage is `NAME.usda` in it.

    Returns:
        The stage.

    Raises:
        FileError: It cannot be written there.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileError(f"{folder}: cannot be made: {error.strerror}") from error
    output = folder / f"{name}.usda"
    import_module(f"usdmotion.demos.{name}").build(output)
    return output


def following(name: str, stage: Path) -> str:
    """Return the command to run next on the stage of a demo: solve it, where it has an edit."""
    module = import_module(f"usdmotion.demos.{name}")
    return str(getattr(module, "NEXT", "usdmotion solve {stage}")).format(stage=stage)
