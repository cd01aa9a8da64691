"""What was done to put an input on its ground, for people and as data."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Grounding:
    """What was done to the input of one edit; its fields are keys of the JSON."""

    footprints: int
    """How many there are."""
    detected: bool
    """Whether they were looked for, as the edit has no contacts of feet."""
    without_ground: int
    """Under how many of them there is no ground."""
    made_on: float
    """Height of the ground that the input was made on, along the up axis [m]."""
    lowest: float
    """How far feet were moved along the up axis at least [m], downwards if negative."""
    highest: float
    """How far at most [m]."""
    given_way: float
    """How much lower the root is than it goes along with the feet, at most: legs are too short
    [m]."""
    given_way_time: float | None
    """The time code of that, None where it is not."""
    staying: tuple[str, ...] = ()
    """Paths of the contacts that do not go along: of hands and knees, and what slides."""

    def sentence(self, edit: str) -> str:
        """Return what a person is told of it."""
        told = f"{self._footprints()}{self._root()}{self._staying()}"
        return f"<{edit}> starts from an input on the ground: {told}"

    def _footprints(self) -> str:
        if not self.footprints:
            return (
                "no foot stands in it, so that it stays as it is; author contacts of the feet, or "
                "let `usdmotion detect` find them"
            )
        found = ", found by looking for them" if self.detected else ""
        told = (
            f"{_count(self.footprints)}{found}, moved by {round(self.lowest * 1e3)} to "
            f"{round(self.highest * 1e3)} mm along the up axis"
        )
        if self.without_ground:
            told += (
                f"; there is no ground under {self.without_ground} of them, or it is overhead, and "
                "the input stays as it is there"
            )
        return told

    def _root(self) -> str:
        if self.given_way_time is None:
            return ""
        return (
            f"; legs are too short at {self.given_way_time:g}, where the body gives way by "
            f"{self.given_way * 1e3:.0f} mm"
        )

    def _staying(self) -> str:
        if not self.staying:
            return ""
        names = [f"<{path}>" for path in self.staying[:3]]
        more = len(self.staying) - len(names)
        named = ", ".join(names) + (f" and {more} more" if more else "")
        return (
            f"; {named} hold on to where they were, "
            "as only ankles and balls of feet that are held in place go along"
        )


def _count(footprints: int) -> str:
    return "1 footprint" if footprints == 1 else f"{footprints} footprints"
