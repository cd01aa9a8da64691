"""What the input already does costs it nothing."""

import numpy as np

from usdmotion import demos
from usdmotion.demos.gait import walk
from usdmotion.demos.walker import SKELETON, write_walk


def assert_is_the_input(solved):
    apart = solved.after.world[:, :, 3, :3] - solved.before.world[:, :, 3, :3]
    assert solved.millimetres(apart) <= 0.1
    assert max(map(solved.turned, solved.before.joints)) <= 0.05


def test_constraints_that_the_walk_meets_give_the_walk_back(tmp_path, solve):
    assert_is_the_input(solve(demos.build("nothing_asked", tmp_path), SKELETON))


def test_no_constraints_give_the_walk_back_to_the_bit(tmp_path, solve):
    shot = tmp_path / "none.usda"
    write_walk(shot, walk(), "None_", [])
    solved = solve(shot, SKELETON)
    assert np.array_equal(solved.after.local, solved.before.local)
    assert np.array_equal(solved.after.world, solved.before.world)


def test_every_demo_is_built(tmp_path):
    for name in demos.NAMES:
        assert demos.build(name, tmp_path / "made").is_file()
