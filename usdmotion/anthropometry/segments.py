"""The published table of what the segments of a body weigh, and where their centres are.

P. de Leva, "Adjustments to Zatsiorsky-Seluyanov's segment inertia parameters", Journal of
Biomechanics 29 (1996), table 4, men.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Segment:
    """A segment of a body on a line of the skeleton that goes from 0 to 1.

    It may span several joints. Its density changes linearly along the line, so that slices of it
    add up to the mass and the centre of the table.
    """

    start: float
    end: float
    mass: float
    """Fraction of the body's mass."""
    center: float
    """Where on the line its mass is centred."""

    def cut(self, low: float, high: float) -> tuple[float, float]:
        """Return the mass between two places of the line, and its moment about 0."""
        length, middle = self.end - self.start, 0.5 * (self.start + self.end)
        a, b = (min(max(place, self.start), self.end) - middle for place in (low, high))
        lean = 12.0 * (self.center - middle) / length**2
        first, second, third = b - a, (b**2 - a**2) / 2.0, (b**3 - a**3) / 3.0
        mass = self.mass / length * (first + lean * second)
        return mass, self.mass / length * (second + lean * third) + middle * mass


# Along the trunk, from the middle between the hip joints (0) to the cervicale (1), 603.3 mm of
# table 4: the navel is at 145.7 mm, the lower end of the breastbone at 361.2 mm.
LOWER_TRUNK = Segment(0.0, 0.2415, 0.1117, 0.0938)
MIDDLE_TRUNK = Segment(0.2415, 0.5987, 0.1633, 0.4379)
UPPER_TRUNK = Segment(0.5987, 1.0, 0.1596, 0.7966)

LIMBS = {
    ("shoulder", "elbow"): Segment(0.0, 1.0, 0.0271, 0.5772),
    ("elbow", "radiocarpal"): Segment(0.0, 1.0, 0.0162, 0.4574),
    ("hip", "knee"): Segment(0.0, 1.0, 0.1416, 0.4095),
    ("knee", "talocrural"): Segment(0.0, 1.0, 0.0433, 0.4459),
}
"""From joint to joint."""

HEAD_MASS, HAND_MASS, FOOT_MASS = 0.0694, 0.0061, 0.0137

HAND_CENTER = 0.79
"""Centre of the hand from the wrist (0) to the third knuckle (1)."""
FOOT_CENTER = 0.4
"""Centre of the foot from the ankle (0) to the ball (1): it is 0.4415 of a foot from the heel, a
fourth of which is behind the ankle."""

# What follows is measured in legs from hip to ankle, 0.49 of the height, where a skeleton ends.
HAND_BEYOND = 0.08
"""Centre of the hand from the wrist on: 0.3624 of a hand."""
HEAD_BEYOND = 0.05
"""Centre of the head from the base of the skull on: halfway from the vertex to the cervicale."""
NECK_BELOW = 0.1
"""The cervicale from the base of the skull down, where a skeleton has no neck."""
