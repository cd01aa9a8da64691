"""The same without priorities: an ankle that cannot get there pulls the planted foot along."""

from usdmotion.demos.figures import Figure
from usdmotion.demos.karate import build_weighted as build

__all__ = ["build"]


PICTURE = Figure(
    "2004, figure 5, middle right: on one priority the foot that stands is torn away",
    frames=(17.0, 24.0, 29.0, 34.0, 44.0, 54.0),
)
