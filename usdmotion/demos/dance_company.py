"""2005, section 6: one dance for five bodies, from 0.6 to 1.3 times the dancer's height.

They have other proportions, and skeletons of other makers: names, vertebrae, fingers, twist joints,
rest poses and axes are their own. `retarget` puts the dance on one of them after the other.
"""

from collections.abc import Iterator
from pathlib import Path

from usdmotion.demos.body import Proportions
from usdmotion.demos.company import Member, held, write_company
from usdmotion.demos.dancing import dance, stands
from usdmotion.demos.figures import Answer, Figure
from usdmotion.demos.people import Person, person

HEIGHT = 1.7
"""Of the dancer [m]."""
ROOT, DANCER = "Company", "Dancer"
SKELETON = f"/{ROOT}/{DANCER}/Skeleton"
"""Of the dancer."""
NEXT = (
    f"usdmotion retarget {{stage}} {{stage}} --source {SKELETON} "
    f"--skeleton /{ROOT}/Child/Skeleton -o danced.usda"
)


def build(output: Path) -> None:
    """Write the stage."""
    dancing = dance()
    contacts = held(dancing, SKELETON, stands(dancing))
    dancer = Member(DANCER, person(HEIGHT), dancing.motion, contacts)
    write_company(output, ROOT, [dancer, *company()])


def company() -> Iterator[Member]:
    """Yield those who are to dance, at rest."""
    for name, (who, z_up) in _people().items():
        yield Member.at_rest(name, who, z_up=z_up)


def skeletons() -> tuple[str, ...]:
    """Return the paths of their Skeletons."""
    return tuple(f"{member.path(ROOT)}/Skeleton" for member in company())


def _people() -> dict[str, tuple[Person, bool]]:
    """Return them by name, and whether they stand along Z."""
    child = Proportions(legs=0.85, arms=0.9, head=1.45)
    long_legs = Proportions(legs=1.15, arms=1.1, trunk=0.9, width=0.95)
    heavy = Proportions(legs=0.9, trunk=1.12, width=1.25, feet=1.05)
    return {
        "Child": (person(0.6 * HEIGHT, proportions=child, naming="mixamorig", rest="A"), False),
        "Long": (
            person(1.3 * HEIGHT, proportions=long_legs, naming="blender", vertebrae=5, axes=11),
            False,
        ),
        "Heavy": (
            person(
                1.05 * HEIGHT,
                proportions=heavy,
                naming="unreal",
                vertebrae=1,
                twists=True,
                rest="down",
                z_up=True,
            ),
            True,
        ),
        "Handed": (
            person(0.9 * HEIGHT, naming="h_anim", finger_joints=1, rest="I"),
            False,
        ),
        "Numbered": (
            person(
                1.15 * HEIGHT,
                proportions=Proportions(arms=0.8, feet=0.9),
                naming="numbers",
                vertebrae=4,
                axes=3,
            ),
            False,
        ),
    }


PICTURE = Figure(
    "2005, section 6: one dance, five bodies",
    frames=(22.0, 43.0, 64.0),
    views=("side",),
    answers=(
        Answer(
            steps=tuple(
                f"usdmotion retarget {{stage}} {{stage}} --source {SKELETON} --skeleton {other}"
                for other in skeletons()
            ),
        ),
    ),
    before=False,
)
