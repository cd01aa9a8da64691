"""The same without priorities: footplants and ankle on one rank, and nobody is obeyed."""

from usdmotion.demos.figures import Figure
from usdmotion.demos.stepping import build_weighted as build

__all__ = ["build"]


PICTURE = Figure(
    "2004, figure 4, middle: on one priority nobody is obeyed",
    frames=(63.0, 70.0, 78.0, 88.0, 97.0),
    views=("side",),
)
