"""What was done to an input, for people and as data."""

from dataclasses import dataclass

_NAMED = 3
"""How many joints a sentence names."""


@dataclass(frozen=True)
class Replaced:
    """A joint with outliers; its fields are keys of the JSON."""

    joint: str
    samples: int


@dataclass(frozen=True)
class Held:
    """A joint that was held where it is at rest; its fields are keys of the JSON."""

    joint: str
    rests: int
    """In how many intervals."""
    slide_before: float
    """How far it moves in all of them together in the input, without its outliers [m]."""
    slide_after: float
    """How far it does so in the cleaned motion [m]."""


@dataclass(frozen=True)
class Cleaning:
    """What was done to the input of one edit; its fields are keys of the JSON."""

    cutoff: float
    """Of the filter [Hz]."""
    low_passed: bool
    """Whether the samples hold anything above the cutoff, so that they were filtered."""
    replaced: tuple[Replaced, ...]
    """Joints with outliers, in the order of the skeleton."""
    moved: float
    """The largest distance of a joint from where it was, in frames without outliers [m]."""
    moved_joint: str
    """The joint that it is of, "" where nothing moved."""
    moved_time: float | None
    """The time code of it, None where nothing moved."""
    feet_known: bool
    """Whether it is known which joints are the feet, so that their rests were looked for."""
    held: tuple[Held, ...]
    """What was at rest and was held there."""

    @property
    def samples(self) -> int:
        """How many samples of all joints were replaced."""
        return sum(each.samples for each in self.replaced)

    def sentence(self, edit: str) -> str:
        """Return what a person is told of it."""
        return f"<{edit}> starts from a cleaned input: {self._replaced()}; {self._rest()}"

    def _replaced(self) -> str:
        if not self.replaced:
            return "no sample is an outlier"
        most = sorted(self.replaced, key=lambda each: -each.samples)
        names = [f"{_leaf(each.joint)} {each.samples}" for each in most[:_NAMED]]
        more = [] if len(most) <= _NAMED else [f"and {len(most) - _NAMED} more joints"]
        return f"{_count(self.samples)} replaced ({', '.join(names + more)})"

    def _rest(self) -> str:
        if not self.low_passed:
            return f"the samples hold nothing above {self.cutoff:g} Hz, so that none is filtered"
        told = f"low-passed at {self.cutoff:g} Hz"
        if self.moved_time is not None:
            told += (
                f", which moves joints by at most {self.moved * 1e3:.1f} mm "
                f"({_leaf(self.moved_joint)} at {self.moved_time:g})"
            )
        if not self.held:
            unknown = ", for nobody says which joints are the feet: author usdmotion:parts"
            return f"{told}; no contact was preserved{'' if self.feet_known else unknown}"
        before, after = (
            sum(getattr(each, name) for each in self.held) * 1e3
            for name in ("slide_before", "slide_after")
        )
        names = ", ".join(_leaf(each.joint) for each in self.held)
        return f"{told}; {names} held where at rest, sliding {after:.1f} mm instead of {before:.1f}"


def _count(samples: int) -> str:
    return "1 sample is an outlier and" if samples == 1 else f"{samples} samples are outliers and"


def _leaf(joint: str) -> str:
    return joint.rsplit("/", 1)[-1]
