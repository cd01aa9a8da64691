"""Standing: a motion is put onto its footprints, and these onto a ground (2005, section 7).

`stand` does it (`footing`). A `Footprint` becomes a stance of a foot; `treads` are the ways of the
feet from one to the next, on soles (`soles`) and clear of what is between (`clearance`); `heights`
is how high the root is then, and `legs` and `ankles` follow.
"""

from usdmotion.s4d.standing.footing import Standing, stand
from usdmotion.s4d.standing.footprints import Footprint
from usdmotion.s4d.standing.legs import Pose

__all__ = ["Footprint", "Pose", "Standing", "stand"]
