"""2005, section 11: hands carry the root in a handstand, also on arms that are longer or shorter.

The contacts of hands and feet say who carries when. `retarget` puts it on one of two bodies.
"""

from collections.abc import Iterator
from pathlib import Path

from usdmotion.demos.acrobatics import handstand
from usdmotion.demos.body import Proportions
from usdmotion.demos.company import Member, held, one_by_one, write_company
from usdmotion.demos.figures import Figure
from usdmotion.demos.people import person

HEIGHT = 1.7
"""Of all three [m]."""
EASE = 0.6
"""How long contacts take to come and to go [s]."""
ROOT = "Handstand"
SKELETON = f"/{ROOT}/Acrobat/Skeleton"
"""Of who does it."""
NEXT = (
    f"usdmotion retarget {{stage}} {{stage}} --source {SKELETON} "
    f"--skeleton /{ROOT}/LongArms/Skeleton -o stood.usda"
)


def build(output: Path) -> None:
    """Write the stage."""
    acting = handstand()
    spans = [(each.joint.rsplit("/", 1)[-1], each.start, each.end) for each in acting.stances]
    contacts = held(acting, SKELETON, spans, ease=EASE)
    acrobat = Member("Acrobat", person(HEIGHT), acting.motion, contacts)
    write_company(output, ROOT, [acrobat, *others()])


def others() -> Iterator[Member]:
    """Yield those who are to do it too, at rest."""
    for name, arms in (("LongArms", 1.25), ("ShortArms", 0.8)):
        yield Member.at_rest(name, person(HEIGHT, proportions=Proportions(arms=arms), rest="A"))


PICTURE = Figure(
    "2005, section 11: hands carry, on arms that are longer or shorter",
    frames=(1.0, 22.0, 44.0, 65.0, 87.0, 109.0),
    views=("side",),
    answers=one_by_one(ROOT, "Acrobat", [member.name for member in others()]),
    before=False,
)
