"""2005, section 11: knees and hands carry the root of who crawls, on other limbs too.

The contacts of knees and hands say who carries when. `retarget` puts it on one of two bodies.
"""

from collections.abc import Iterator
from pathlib import Path

from usdmotion.demos.acrobatics import crawl
from usdmotion.demos.body import Proportions
from usdmotion.demos.company import Member, held, one_by_one, write_company
from usdmotion.demos.figures import Figure
from usdmotion.demos.people import person

HEIGHT = 1.7
"""Of all three [m]."""
EASE = 0.3
"""How long contacts take to come and to go [s]."""
ROOT = "Crawl"
SKELETON = f"/{ROOT}/Crawler/Skeleton"
"""Of who does it."""
NEXT = (
    f"usdmotion retarget {{stage}} {{stage}} --source {SKELETON} "
    f"--skeleton /{ROOT}/LongArms/Skeleton -o crawled.usda"
)


def build(output: Path) -> None:
    """Write the stage."""
    acting = crawl()
    spans = [(each.joint.rsplit("/", 1)[-1], each.start, each.end) for each in acting.stances]
    contacts = held(acting, SKELETON, spans, kind="point", ease=EASE)
    crawler = Member("Crawler", person(HEIGHT), acting.motion, contacts)
    write_company(output, ROOT, [crawler, *others()])


def others() -> Iterator[Member]:
    """Yield those who are to crawl too, at rest."""
    for name, proportions in (
        ("LongArms", Proportions(arms=1.2)),
        ("ShortArms", Proportions(arms=0.85)),
    ):
        yield Member.at_rest(name, person(HEIGHT, proportions=proportions, rest="down"))


PICTURE = Figure(
    "2005, section 11: hands and knees carry, on other limbs",
    frames=(1.0, 22.0, 44.0, 66.0, 87.0),
    views=("side",),
    answers=one_by_one(ROOT, "Crawler", [member.name for member in others()]),
    before=False,
)
