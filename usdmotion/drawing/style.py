"""How pictures look: colours that everybody can tell apart, and figures as bytes."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np

from usdmotion.arrays import Bools, Floats
from usdmotion.errors import InputError
from usdmotion.quality import runs

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# After Okabe and Ito, and a red that is darker than their vermillion, which is too near the colour
# of goals in print: told apart with any kind of colour vision, and in grey.
BEFORE = "#9aa1a9"
"""The input."""
AFTER = "#0072b2"
"""The result."""
COURSE = "#123a57"
"""Of trajectories of the result, which are seen before its body too."""
MISSED = "#c4121f"
"""Its sign is a cross besides; goals are circles."""
GOAL = "#e69f00"
SUPPORT = "#009e73"
PALE = "#cfe3f1"
"""On, but not judged."""
INK = "#1d2530"
SOFT = "#6b7480"
LINE = "#d9dee3"
WIDTH = 10.0
"""Of a picture that fills the page [inches]."""

_STYLE: dict[Any, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "text.color": INK,
    "axes.edgecolor": LINE,
    "axes.labelcolor": SOFT,
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.titleweight": "bold",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#eceff2",
    "grid.linewidth": 0.8,
    "xtick.color": SOFT,
    "ytick.color": SOFT,
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
    "lines.linewidth": 1.6,
    "lines.solid_capstyle": "round",
    "legend.frameon": False,
    "legend.fontsize": 8.0,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "svg.hashsalt": "usdmotion",
    "svg.fonttype": "none",
    "path.simplify": True,
    "path.simplify_threshold": 0.2,
}
_MOST_SAMPLES = 1200
"""More samples of a curve than this cannot be seen on a page."""


_PATH = re.compile(' d="[^"]*"')
_LONG = re.compile(r"(\.\d)\d+")
_INDENTED = re.compile(r"(?<=\n) +")
_OUTSIDE = re.compile(r'<metadata>.*?</metadata>|<style.*?</style>|(?<=<g) id="[^"]*"', re.DOTALL)
"""What a picture says of itself, and what it says to the whole page that it stands in."""


@dataclass(frozen=True, eq=False)
class Picture:
    """One picture of a report."""

    name: str
    """Of its file, without ending."""
    caption: str
    """What there is to be seen, in a sentence or two."""
    figure: "Figure"

    def __post_init__(self) -> None:
        # Laid out once: another time, for another format, it would end elsewhere.
        if self.figure.get_layout_engine() is not None:
            self.figure.draw_without_rendering()
            self.figure.set_layout_engine("none")

    def svg(self) -> str:
        """Return it as an element of SVG that stands in a page as wide as that has room for.

        The same picture is the same text.
        """
        drawn = _saved(self.figure, "svg", {"Date": None, "Creator": None}).decode()
        wide, tall = 72.0 * self.figure.get_size_inches()
        inside = _OUTSIDE.sub("", drawn[drawn.index(">", drawn.index("<svg")) + 1 :])
        # Less than a tenth of a point cannot be seen, and makes half of the page.
        inside = _PATH.sub(lambda path: _LONG.sub(r"\1", path.group()), inside)
        inside = inside.replace("'DejaVu Sans'", "'DejaVu Sans', Verdana, sans-serif")
        return (
            f'<svg role="img" viewBox="0 0 {wide:g} {tall:g}">{_INDENTED.sub("", inside)}'.rstrip()
        )

    def svg_file(self) -> bytes:
        """Return it as a file of SVG; the same picture is the same bytes."""
        wide, tall = 72.0 * self.figure.get_size_inches()
        names = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
        head = f'<svg {names} width="{wide:g}pt" height="{tall:g}pt" stroke-linejoin="round" '
        return (self.svg().replace("<svg ", head, 1) + "\n").encode()

    def png(self, dpi: float = 160.0) -> bytes:
        """Return it as PNG of few colours, so many pixels an inch; the same bytes each time."""
        from usdmotion.drawing.pixels import of_few_colors

        return of_few_colors(_saved(self.figure, "png", {"Software": None}, dpi))


@contextmanager
def drawing() -> Iterator[None]:
    """Draw in the style of reports.

    Raises:
        InputError: matplotlib is not installed.
    """
    require_matplotlib()
    from matplotlib import rc_context

    with rc_context(_STYLE):
        yield


def require_matplotlib() -> None:
    """Raise if nothing can be drawn.

    Raises:
        InputError: matplotlib is not installed.
    """
    try:
        import matplotlib  # noqa: F401
    except ImportError as error:
        raise InputError(
            "pictures are drawn with matplotlib, which is not installed; "
            "pip install 'usdmotion[report]'"
        ) from error


def figure(height: float, width: float = WIDTH) -> "Figure":
    """Return an empty figure [inches]."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def thinned(x: Floats, *curves: Floats) -> tuple[Floats, ...]:
    """Return curves with fewer samples that look the same: the least and the most of each stretch.

    Args:
        x: Where the samples are, shape (sample_count,).
        curves: Each of shape (sample_count,).

    Returns:
        x and the curves, of at most about `_MOST_SAMPLES` samples each.
    """
    if len(x) <= _MOST_SAMPLES:
        return (x, *curves)
    edges = np.linspace(0, len(x), _MOST_SAMPLES // 2 + 1).astype(np.int64)[:-1]
    places = np.repeat(x[edges], 2)
    return places, *(
        np.stack([np.minimum.reduceat(c, edges), np.maximum.reduceat(c, edges)], 1).ravel()
        for c in curves
    )


def stretches(x: Floats, mask: Bools) -> list[tuple[float, float]]:
    """Return where a mask holds as starts and widths, half a sample to either side."""
    middles = 0.5 * (x[1:] + x[:-1]) if len(x) > 1 else np.zeros(0)
    edges = np.concatenate([x[:1], middles, x[-1:]])
    if len(x) == 1:
        edges = np.array([x[0] - 0.5, x[0] + 0.5])
    return [(float(edges[a]), float(edges[b] - edges[a])) for a, b in runs(mask)]


def time_axis(axes: "Axes", time_codes: Floats, *, label: bool = True) -> None:
    """Give axes the time codes from left to right."""
    first, last = float(time_codes[0]), float(time_codes[-1])
    pad = 0.5 if first == last else 0.0
    axes.set_xlim(first - pad, last + pad)
    if label:
        axes.set_xlabel("time code")
    else:
        axes.tick_params(labelbottom=False)


def _saved(drawn: "Figure", kind: str, metadata: dict[str, None], dpi: float = 72.0) -> bytes:
    held = BytesIO()
    drawn.savefig(held, format=kind, metadata=metadata, dpi=dpi)
    return held.getvalue()
