"""2004, section 3: five ranks that get less and less, and no rank disturbs the one above it.

Each constraint that is switched off (`active = false`) gives to those under it, and takes nothing
from those above.
"""

from pathlib import Path

import numpy as np

from usdmotion.constraints import (
    Constraint,
    Goal,
    OrientationConstraint,
    PositionConstraint,
)
from usdmotion.demos.figures import Figure
from usdmotion.demos.gait import Walk, walk
from usdmotion.demos.walker import SKELETON, balance, feet, token, write_walk
from usdmotion.kernels import from_vector


def build(output: Path) -> None:
    """Write the stage."""
    walking = walk(seconds=2.0)
    write_walk(output, walking, "Strictness", asked(walking))


def asked(walking: Walk) -> list[Constraint]:
    """Return feet (1), balance (2), a wrist (3) and an elbow (4) out of reach, a head (5)."""
    planted = feet(walking, priority=1)

    def reach(name: str, joint: str, priority: int, way: tuple[float, ...]) -> PositionConstraint:
        goal = Goal(path="Away", mode="offset", translation=np.array(way))
        return PositionConstraint(
            path=name,
            skeleton=SKELETON,
            joint=token(walking, joint),
            priority=priority,
            goals=(goal,),
        )

    nod = Goal(path="Nod", mode="offset", rotation=from_vector(np.array((0.6, 0.0, 0.0))))
    head = OrientationConstraint(
        path="Head", skeleton=SKELETON, joint=token(walking, "Head"), priority=5, goals=(nod,)
    )
    wrist = reach("Wrist", "LeftHand", 3, (0.9, 0.3, 0.6))
    elbow = reach("Elbow", "LeftForeArm", 4, (0.2, -0.3, 0.2))
    return [*planted, balance(planted, priority=2), wrist, elbow, head]


PICTURE = Figure(
    "2004, section 3: five ranks, of which the last get nothing",
    frames=(1.0, 13.0, 25.0, 37.0, 49.0),
)
