"""The same without priorities: an ankle that cannot get there pulls the planted foot along."""

from usdmotion.demos.karate import build_weighted as build

__all__ = ["build"]
