"""The solver keeps the contract of usdmotion."""

from collections.abc import Callable

import pytest
from usdmotion_least_squares import LeastSquares

from usdmotion import Solver
from usdmotion.testing import SOLVER_CHECKS


@pytest.mark.parametrize("check", SOLVER_CHECKS)
def test_least_squares_keeps_the_contract(check: Callable[[Solver], None]) -> None:
    check(LeastSquares())
