"""What there is to see of a scene: guides and pictures are drawn from the same values."""

from usdmotion.showing.scenes import shown, shown_before
from usdmotion.showing.shown import (
    Actor,
    BalanceMark,
    Course,
    GoalMark,
    Link,
    Miss,
    ShownEdit,
    ShownScene,
)

__all__ = [
    "Actor",
    "BalanceMark",
    "Course",
    "GoalMark",
    "Link",
    "Miss",
    "ShownEdit",
    "ShownScene",
    "shown",
    "shown_before",
]
