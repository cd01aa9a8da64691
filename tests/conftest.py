"""What several tests need."""

import os
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def mocap() -> Path:
    """Return the folder of captured clips, which are not part of the project."""
    named = os.environ.get("USDMOTION_MOCAP")
    places = [Path(named)] if named else [up / "shared/mocap" for up in Path(__file__).parents]
    for place in places:
        if place.is_dir():
            return place
    pytest.skip("the captured clips are not here; USDMOTION_MOCAP may name their folder")
