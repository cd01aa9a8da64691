"""S4D: motion without the body that it was recorded on (2005).

`NormalizedMotion` is what a motion is when every length is a fraction of the body's own.
`normalize` takes a motion off a body, `restore` puts it on one; `Morphology` is what they have to
know of it.
"""

from usdmotion.s4d.morphology import Limb, Morphology
from usdmotion.s4d.normalized import NormalizedMotion
from usdmotion.s4d.normalizing import normalize
from usdmotion.s4d.restoring import restore

__all__ = ["Limb", "Morphology", "NormalizedMotion", "normalize", "restore"]
