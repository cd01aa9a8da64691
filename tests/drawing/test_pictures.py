"""Strips: what is near hides what is far, all is inside, and the same strip is the same bytes."""

from io import BytesIO

import numpy as np
import pytest
from matplotlib.image import imread

from usdmotion.drawing import drawing, strip_picture
from usdmotion.drawing.eyes import Camera, Perspective
from usdmotion.drawing.framing import shows, size, windows
from usdmotion.drawing.strips import Curve, Panel, Patch, Row, Spot, Strip, Surface

UP = np.array((0.0, 1.0, 0.0))
FRONT = Camera.at(np.array((0.0, 0.0, 1.0)), UP, 0.0, 0.0)
RED, GREEN = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
SQUARE = np.array(((-1.0, -1.0, 0.0), (1.0, -1.0, 0.0), (1.0, 1.0, 0.0), (-1.0, 1.0, 0.0)))
HALVES = np.array(((0, 1, 2), (0, 2, 3)))


def square(middle, half, color, **said):
    return Surface(half * SQUARE + np.array(middle), HALVES, color, **said)


def strip(*panels, **said):
    return Strip((Row("", panels),), **said)


def pixels(drawn):
    """Return red, green and blue of each pixel, the top row first."""
    with drawing():
        return imread(BytesIO(strip_picture(drawn).png()))[..., :3]


def dominant(seen):
    """Tell of which pixels red, and of which green, is by far the most."""
    red, green = seen[..., 0], seen[..., 1]
    return red > green + 0.3, green > red + 0.3


@pytest.mark.parametrize("first", [0, 1])
def test_what_is_near_hides_what_is_far(first):
    # One that is large reaches nearer and farther than a small one that stands before its middle.
    tilted = Surface(
        np.array(((-1.0, 0.0, 2.0), (1.0, 0.0, 2.0), (1.0, 1.0, -2.0), (-1.0, 1.0, -2.0))),
        HALVES,
        RED,
    )
    small = square((0.6, 0.75, 0.1), 0.2, GREEN)
    surfaces = (tilted, small) if first else (small, tilted)
    red, green = dominant(pixels(strip(Panel("", FRONT, surfaces=surfaces))))
    # All of the small one is seen, and all else is the tilted one.
    assert green.sum() / (red.sum() + green.sum()) == pytest.approx(0.16 / 2.0, rel=0.05)


def test_the_same_strip_is_the_same_bytes():
    marks = (
        Curve(np.array(((0.0, 0.0, 0.5), (0.5, 0.5, 0.5))), "#0072b2"),
        Patch(SQUARE[:, [0, 2, 1]], "#009e73"),
        Spot(np.zeros(3), "missed", "#d55e00", text="Wrist"),
        Spot(np.array((0.1, 0.0, 0.0)), "mass", "#1d2530"),
    )
    shown = Panel("frame 1", FRONT, surfaces=(square(UP, 0.5, RED),), marks=marks, ground=0.0)
    drawn = strip(shown, shown, caption="Two panels.")
    with drawing():
        one, other = (strip_picture(drawn, name="poses") for _ in range(2))
        assert one.png() == other.png() == one.png()
    assert (one.name, one.caption) == ("poses", "Two panels.")


@pytest.mark.parametrize(
    "empty",
    [
        {},
        {"surfaces": (Surface(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64), RED),)},
        {"marks": (Curve(UP[None], "black"), Patch(UP[None], "black"))},
    ],
)
def test_what_has_nothing_to_be_seen_is_drawn_empty(empty):
    assert (pixels(strip(Panel("", FRONT, **empty))) == 1.0).all()


def test_a_row_has_one_scale_and_its_panels_show_all_that_has_to_be_seen():
    middles = ((0.0, 0.0, 0.0), (9.0, 0.5, 0.0), (18.0, 3.0, 0.0))
    ground = square((9.0, -1.0, 0.0), 90.0, GREEN, beyond=True)
    panels = tuple(
        Panel("", FRONT, surfaces=(square(middle, 1.0 + index, RED), ground))
        for index, middle in enumerate(middles)
    )
    (shown,) = windows((Row("", panels),))
    assert np.allclose([size(each) for each in shown], size(shown[0]))
    for index, (window, middle) in enumerate(zip(shown, middles, strict=True)):
        left, bottom, right, top = window
        assert left < middle[0] - 1.0 - index and middle[0] + 1.0 + index < right
        assert bottom < middle[1] - 1.0 - index and middle[1] + 1.0 + index < top
    assert size(shown[0])[0] < 9.0


def test_before_and_after_are_seen_at_one_place():
    rows = [
        Row(title, (Panel("", FRONT, surfaces=(square((shift, 0.0, 0.0), 1.0, RED),)),))
        for title, shift in (("before", 0.0), ("after", 0.7))
    ]
    before, after = windows(rows)
    assert before == after
    turned = Camera.at(np.array((0.0, 0.0, 1.0)), UP, 90.0, 0.0)
    aside = Row("side", (Panel("", turned, surfaces=(square((0.0, 0.0, 5.0), 1.0, RED),)),))
    assert windows([*rows, aside])[:2] == [before, after]


@pytest.mark.parametrize("scale", [1e-4, 1e3])
def test_what_is_small_fills_its_panel_as_what_is_large(scale):
    usual, other = (
        windows(strip(Panel("", FRONT, surfaces=(square((0.0, 0.3, 0.0), each, RED),))).rows)
        for each in (1.0, scale)
    )
    (((left, _, right, _),),), (((small_left, _, small_right, _),),) = usual, other
    assert small_right - small_left == pytest.approx(scale * (right - left))


@pytest.mark.parametrize(
    ("middle", "is_seen"),
    [((0, 0, -5), True), ((0, 0, 5), False), ((5.9, 0, -5), True), ((7, 0, -5), False)],
)
def test_a_panel_shows_what_is_before_its_eye_and_inside_of_its_frame(middle, is_seen):
    eye = Perspective(np.zeros(3), *np.eye(3), focal=1.0, window=(-1.0, -1.0, 1.0, 1.0))
    assert shows(Panel("", eye, surfaces=(square(middle, 1.0, RED),))) == is_seen
    around = square((0.0, 0.0, -5.0), 100.0, RED)
    assert shows(Panel("", eye, surfaces=(around,)))


def test_what_is_behind_the_eye_is_not_drawn():
    eye = Perspective(np.zeros(3), *np.eye(3), focal=1.0, window=(-1.0, -1.0, 1.0, 1.0))
    floor = np.array(((-9.0, -1.0, 9.0), (9.0, -1.0, 9.0), (9.0, -1.0, -9.0), (-9.0, -1.0, -9.0)))
    way = Curve(np.array(((0.0, 0.5, -5.0), (0.0, 0.5, 5.0))), "#00ff00", width=6.0)
    behind = Spot(np.array((0.0, 0.9, 5.0)), "held", "#00ff00")
    surfaces = (Surface(floor, HALVES, RED),)
    red, green = dominant(
        pixels(strip(Panel("", eye, surfaces=surfaces, marks=(way, behind), ground=-1.0)))
    )
    # The floor goes to the horizon at nine metres; the way rises from there, out of the picture.
    tall, wide = red.shape
    assert red[int(0.7 * tall) : -9, 9 : wide // 3].all() and not red[: tall // 2].any()
    columns = np.flatnonzero(green.any(axis=0))
    assert green.any() and abs(columns.mean() - 0.5 * wide) < 0.02 * wide
    assert green[: tall // 4].any()
