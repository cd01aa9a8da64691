"""Outcomes beside the input that they were made from."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from usdmotion.answering import beside_its_input
from usdmotion.errors import FileError


def test_what_stands_on_a_ground_that_only_a_program_knows_is_left_to_it(outcome):
    told = replace(outcome(), told=True)
    with pytest.raises(FileError, match=r"arm.usda: .*a ground that a program told.*; call look "):
        beside_its_input(told, None, Path("arm.usda"), "look")
    put = beside_its_input(told, lambda places, seconds: places[..., 0], Path("arm.usda"), "look")
    assert put.scene.edits[0].ground is not None


def test_an_input_that_nothing_was_done_to_stays_as_it_was(outcome):
    given = outcome(turns={"head": (0.2, 0.0, 0.0)})
    same = beside_its_input(given, None, Path("arm.usda"), "look")
    assert np.array_equal(same.scene.cast.positions, given.scene.cast.positions)
    assert same.motions is given.motions
