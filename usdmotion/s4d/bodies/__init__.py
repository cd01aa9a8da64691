"""Bodies: what there is to know of one, to take a motion off it and to put one on.

`Morphology` holds it: `places` is what carries what, `measures` are the lengths, `anatomy` is where
the axes of the parts are at rest, and `resting` finds a rest pose where none is given.
"""

from usdmotion.s4d.bodies.measures import Measures
from usdmotion.s4d.bodies.morphology import Limb, Morphology

__all__ = ["Limb", "Measures", "Morphology"]
