"""S4D: motion without the body that it was recorded on (2005).

`NormalizedMotion` is what a motion is when every length is a fraction of the body's own.
`normalize` takes a motion off a body, `restore` puts it on one; `Morphology` is what they have to
know of it. `blend` and `warp` mix normalized motions. `stand` puts a motion onto its footprints,
and these onto a ground; `hinged` bends knees and elbows about their hinges.
"""

from usdmotion.s4d.bodies import Limb, Morphology
from usdmotion.s4d.carrying import Held, carriers_of
from usdmotion.s4d.hinges import hinged
from usdmotion.s4d.mixing import blend, warp
from usdmotion.s4d.normalized import NormalizedMotion
from usdmotion.s4d.normalizing import normalize
from usdmotion.s4d.postures import lacking
from usdmotion.s4d.restoring import restore
from usdmotion.s4d.standing import Footprint, Standing, stand

__all__ = [
    "Footprint",
    "Held",
    "Limb",
    "Morphology",
    "NormalizedMotion",
    "Standing",
    "blend",
    "carriers_of",
    "hinged",
    "lacking",
    "normalize",
    "restore",
    "stand",
    "warp",
]
