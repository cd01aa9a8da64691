"""When it is worth looking at a stage: where goals and contacts are on, where most is missing."""

from collections.abc import Sequence

from usdmotion.guides import ContactMark
from usdmotion.showing import ShownScene
from usdmotion.showing.telling import tiers_of as tiers_of_edit


def tiers_of(scenes: Sequence[ShownScene], contacts: Sequence[ContactMark]) -> list[list[float]]:
    """Return time codes of what there is to be seen, the most important first.

    They are those of the edits, with the middles of contacts before what is asked without a goal.
    """
    worst: list[float] = []
    wanted: list[float] = []
    asked: list[float] = []
    for scene in scenes:
        codes = scene.scene.time_codes
        for edit in scene.edits:
            for told, frames in zip((worst, wanted, asked), tiers_of_edit(edit), strict=True):
                told += codes[frames].tolist()
    holds = [0.5 * (each.start + each.end) for each in contacts if not each.always]
    return [worst, wanted, holds, asked]
