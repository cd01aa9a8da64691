"""The solver keeps every promise of the contract."""

import pytest
from usdmotion_ccd import CyclicDescent

from usdmotion.testing import SOLVER_CHECKS


@pytest.mark.parametrize("check", SOLVER_CHECKS, ids=lambda check: check.__name__)
def test_it_keeps_the_promise(check):
    check(CyclicDescent())
