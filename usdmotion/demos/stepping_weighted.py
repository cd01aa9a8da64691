"""The same without priorities: footplants and ankle on one rank, and nobody is obeyed."""

from usdmotion.demos.stepping import build_weighted as build

__all__ = ["build"]
