"""What the menu offers."""

from dataclasses import dataclass

TITLE = "usdmotion"
"""Title of the menu, and what the name of each command begins with.

usdview loads no plugin at all, nobody's, where two commands have one name.
"""


@dataclass(frozen=True)
class Item:
    """One command of the menu."""

    verb: str
    """Name of the function in `commands`."""
    label: str
    """What the menu shows."""
    description: str
    """One sentence about it."""

    @property
    def name(self) -> str:
        """What usdview knows it by."""
        return f"{TITLE}.{self.verb}"


GROUPS = (
    (
        Item("inspect", "Inspect", "Show what is on the stage, and every fault found."),
        Item("report", "Open the Report", "Show what became of the edits, in pictures."),
    ),
    (
        Item(
            "detect",
            "Detect Contacts on the Selected Skeleton",
            "Find what its feet, or the selected props, are held by.",
        ),
        Item(
            "make_template",
            "Make the Selected Contact a Template",
            "Let the next detection learn from it.",
        ),
    ),
    (
        Item(
            "add_position_constraint",
            "New Position Constraint",
            "Hold the selected joint, or the joint nearest to the selected prim, in place.",
        ),
        Item("solve", "Solve the Selected Edit", "Find the motion that obeys its constraints."),
        Item(
            "show",
            "Show or Mute the Result",
            "Change between the result of the selected edit and its source.",
        ),
        Item(
            "jump",
            "Jump to the Worst Time of the Selected Constraint",
            "Go to the frame on which it is missed by most.",
        ),
    ),
    (Item("guides", "Refresh the Guides", "Draw what was detected, asked, met and missed."),),
)
"""The commands, with a separator between groups."""

DESTINATIONS_TITLE = "Results Go To"
DESTINATIONS = (
    Item("to_session", "The Session Layer", "Results are gone when usdview is closed."),
    Item("to_target", "The Edit Target That Is Set", "Results go where other edits go."),
    Item("to_layer", "A Layer File…", "Results go to a file, which is put over the stage."),
)
"""The commands of the submenu; the first is in force at first."""
