"""What characters stand on: a plane, meshes, a function, or several of these (2005, section 7)."""

from usdmotion.ground.contract import Ground
from usdmotion.ground.functions import FunctionGround
from usdmotion.ground.meshes import STEP, MeshGround
from usdmotion.ground.planes import PlaneGround
from usdmotion.ground.several import SeveralGrounds

__all__ = ["STEP", "FunctionGround", "Ground", "MeshGround", "PlaneGround", "SeveralGrounds"]
