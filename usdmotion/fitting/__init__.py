"""A skeleton for captured markers: scaled to whoever wore them, moved by the project's own IK.

Where the joints are is told from the markers by published regressions (`landmarks`), which gives
every segment an orientation of its own (`segments`), and those a skeleton, with the place of each
marker on it (`skeletons`). Then the markers are what the solver is asked to reach (`fitting`). The
markers of OptiTrack's suit are brought to the places of the regressions first (`optitrack`).
"""

from usdmotion.fitting.fitting import fit

__all__ = ["fit"]
