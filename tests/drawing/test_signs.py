"""Signs: names stand beside them and over nothing else, and what is pale gives way."""

import numpy as np

from usdmotion.drawing import drawing, strip_picture
from usdmotion.drawing.eyes import Camera
from usdmotion.drawing.strips import Panel, Row, Spot, Strip

FRONT = Camera.at(np.array((0.0, 0.0, 1.0)), np.array((0.0, 1.0, 0.0)), 0.0, 0.0)
CORNERS = tuple(Spot(np.array((x, y, 0.0)), "held", "black") for x in (0, 2) for y in (0, 2))


def texts(*spots):
    """Return where each text of a panel is drawn, by what it says."""
    with drawing():
        drawn = strip_picture(Strip((Row("", (Panel("", FRONT, marks=(*CORNERS, *spots)),)),)))
        drawn.figure.draw_without_rendering()
        (sheet,) = drawn.figure.axes
        return {
            text.get_text(): text.get_window_extent() for text in sheet.texts if text.get_text()
        }, sheet.bbox


def spot(x, y, text, sign="missed", **fields):
    return Spot(np.array((x, y, 0.0)), sign, "#d55e00", text=text, **fields)


def test_names_are_beside_each_other_and_inside_of_the_panel():
    names = ("Wrist", "Elbow", "LeftHeel", "LeftBall", "RightAnkle", "Balance")
    crowd = [spot(1.0 + 0.02 * each, 0.99, name) for each, name in enumerate(names)]
    edge = [spot(1.99, 1.0, "LeftShoulder"), spot(0.01, 0.01, "RightShoulder")]
    found, panel = texts(*crowd, *edge)
    assert set(found) == {*names, "LeftShoulder", "RightShoulder"}
    boxes = list(found.values())
    for index, box in enumerate(boxes):
        assert panel.x0 <= box.x0 and box.x1 <= panel.x1
        assert panel.y0 <= box.y0 and box.y1 <= panel.y1
        assert not any(box.overlaps(other) for other in boxes[index + 1 :])


def test_what_is_pale_is_left_out_where_there_is_no_room():
    strong = [spot(1.0, 1.0, "7", "number")]
    many = [spot(1.0, 1.0, str(100 + each), "number", opacity=0.3) for each in range(60)]
    found, _ = texts(*many, *strong)
    assert "7" in found and 10 < len(found) < 60
    assert len(texts(*strong, spot(0.5, 0.5, "8", "number", opacity=0.3))[0]) == 2
