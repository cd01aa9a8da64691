"""A walk to measure with."""

import pytest

from usdmotion.demos.gait import Walk, walk


@pytest.fixture(scope="session")
def walking() -> Walk:
    return walk(1.0)
