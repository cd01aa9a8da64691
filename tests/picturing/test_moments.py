"""It is worth looking where most is missed, whatever it is that is missed."""

from types import SimpleNamespace

import numpy as np

from usdmotion.picturing.moments import tiers_of
from usdmotion.showing import Miss


def test_the_worst_of_what_wants_no_place_is_where_its_error_is_largest():
    errors = np.array((30.0, 1.0, 9.0, 2.0))
    missed = np.array((False, True, True, True))
    miss = Miss("/Edit/Head", "Head", np.zeros((4, 3)), None, missed, errors)
    edit = SimpleNamespace(misses=(miss,), goals=(), links=(), courses=())
    codes = np.array((1.0, 2.0, 3.0, 4.0))
    scene = SimpleNamespace(scene=SimpleNamespace(time_codes=codes), edits=(edit,))
    assert tiers_of([scene], []) == [[3.0], [], [], []]
