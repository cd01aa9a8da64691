"""The page: verdicts first, self-contained, the same bytes from the same outcome."""

import re
from html.parser import HTMLParser

import numpy as np
import pytest

from usdmotion import Goal, PositionConstraint
from usdmotion.drawing import strip_picture
from usdmotion.report.findings import findings_of
from usdmotion.report.page import Chapter, page
from usdmotion.report.pictures import drawing, pictures_of, postures_of
from usdmotion.showing import shown
from usdmotion.showing.poses import poses
from usdmotion.testing import HUMANOID

PICTURES = ("overview", "errors", "changes", "balance", "feet", "jerk")
VOID = {"meta", "br", "img", "path", "use", "image", "rect", "circle", "line"}


def page_of(given, *, bare=True):
    """Return the page of an outcome; a bare one has no pictures, which take their time."""
    findings = findings_of(given)
    if bare:
        nothing = {name: [] for name in PICTURES}
        return page("shot & co", [Chapter(findings, edit, nothing, []) for edit in findings.edits])
    seen = shown(given, findings)
    with drawing():
        chapters = [
            Chapter(
                findings,
                edit,
                pictures_of(findings, edit),
                [*postures_of(findings, edit)],
                strip_picture(poses(seen, seen.edits[0], (0, -1))),
            )
            for edit in findings.edits
        ]
        return page("shot & co", chapters)


def reach(outcome, lift, name="left_wrist", priority=1):
    goal = Goal(mode="offset", translation=np.array((0.0, lift, 0.0)))
    return PositionConstraint(
        path=f"{HUMANOID}/Edit/{name}",
        skeleton=HUMANOID,
        joint=outcome.token(name),
        goals=(goal,),
        priority=priority,
    )


class Balanced(HTMLParser):
    """Holds every element to be closed."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []

    def handle_starttag(self, tag, attrs):
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag not in VOID:
            assert self.open.pop() == tag


def test_the_verdict_comes_before_anything_else(outcome):
    asked = [reach(outcome, 0.05), reach(outcome, 0.0, "right_wrist", 2)]
    text = page_of(outcome(asked), bare=False)
    said = "1 of 2 constraints is missed, most of all left_wrist: 50.0 mm at "
    assert said in text
    assert text.index(said) < text.index("<table>") < text.index("<svg")
    assert text.index(said) < text.index('<img alt="The input above,') < text.index("<table>")
    assert "Priority 1" in text and "0 of 1 met" in text and "1 of 1 met" in text


@pytest.mark.parametrize("count", [0, 1, 2])
def test_what_is_met_is_said_to_be(outcome, count):
    asked = [reach(outcome, 0.0, name) for name in ("left_wrist", "right_wrist")[:count]]
    said = ("Nothing was asked.", "The one constraint is met.", "All 2 constraints are met.")
    assert said[count] in page_of(outcome(asked))


def test_a_stale_result_is_called_one_and_a_fresh_one_is_not(outcome):
    assert "is stale" in page_of(outcome(hash_now="other"))
    assert "is not what is shown" in page_of(outcome(shown=False))
    fresh = page_of(outcome())
    assert "is stale" not in fresh and "is not what is shown" not in fresh


def test_where_it_comes_from_and_the_notes_are_told(outcome):
    text = page_of(outcome())
    for said in ("usdmotion 7.8.9", "by_hand", "patience = 3", "abc", "shot &amp; co"):
        assert said in text
    assert "beware &lt;this&gt;" in text


def test_it_is_whole_needs_nothing_from_elsewhere_and_is_the_same_each_time(outcome):
    text = page_of(outcome([reach(outcome, 0.05)]), bare=False)
    fetched = re.findall(r"""(?:src|href)=["']?(?!#|data:)([^"'\\s>]+)""", text)
    assert not fetched and "url(http" not in text and "@import" not in text
    parser = Balanced()
    parser.feed(text)
    parser.close()
    assert parser.open == []
    assert page_of(outcome([reach(outcome, 0.05)]), bare=False) == text
