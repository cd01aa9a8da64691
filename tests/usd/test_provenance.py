"""What a layer says of itself when results are put beside others."""

from typing import Any

import numpy as np
import pytest

from usdmotion.constraints import TrajectoryConstraint
from usdmotion.usd.provenance import hash_of, joined, records


def solved(*edits: str, by: str) -> dict[str, Any]:
    return {
        "version": "1",
        "solver": by,
        "options": {edit: {"by": by} for edit in edits},
        "hashes": dict.fromkeys(edits, by),
    }


def told(said: dict[str, Any]) -> dict[str, str]:
    """Return by whom each edit was solved."""
    return {edit: by for each in records(said) for edit, by in each["hashes"].items()}


def test_each_solve_is_told_of_apart_and_the_last_of_an_edit_counts() -> None:
    first, second = solved("/A", "/B", by="one"), solved("/B", "/C", by="two")
    both = joined(joined({}, first), second)
    assert told(both) == {"/A": "one", "/B": "two", "/C": "two"}
    assert [list(each["options"]) for each in records(both)] == [["/B", "/C"], ["/A"]]
    assert joined(both, solved("/A", by="three"))["solver"] == "three"
    all_again = joined(both, solved("/A", "/B", "/C", by="three"))
    assert all_again == solved("/A", "/B", "/C", by="three")


def test_what_several_solves_made_goes_over_what_others_made() -> None:
    above = joined(joined({}, solved("/A", by="one")), solved("/B", by="two"))
    below = joined(joined({}, solved("/A", by="old")), solved("/D", by="old"))
    assert told(joined(below, above)) == {"/A": "one", "/B": "two", "/D": "old"}


def test_detections_and_solves_leave_each_other_alone() -> None:
    found = joined(solved("/A", by="one"), {"detection": {"hashes": {"/A/Foot": "x"}}})
    assert told(found) == {"/A": "one"}
    again = joined(found, {"detection": {"hashes": {"/A/Hand": "y"}}})
    assert again["detection"]["hashes"] == {"/A/Foot": "x", "/A/Hand": "y"}
    assert joined(again, solved("/A", by="two"))["detection"] == again["detection"]


@pytest.mark.parametrize("field", ["times", "keys"])
def test_seconds_that_an_offset_rounds_are_the_same(field):
    def digest(second):
        times = {field: (0.0, second)}
        return hash_of(
            TrajectoryConstraint(path="/A", skeleton="/B", points=np.zeros((2, 3)), **times)
        )

    assert digest(1.3) == digest(101.3 - 100.0) == digest(1.3 + 1e-13)
    assert digest(1.3) != digest(1.3001)
