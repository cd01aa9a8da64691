"""What the plots are drawn from says what the papers say."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from usdmotion import demos
from usdmotion.demos.plots.origin import FAR
from usdmotion.demos.plots.reading import Steps, search_of, shown_on


@pytest.fixture(scope="module")
def search(tmp_path_factory):
    return search_of(demos.build("skating", tmp_path_factory.mktemp("plots")), "LeftToeBase")


def test_in_its_own_frame_a_step_is_the_same_anywhere_and_in_the_world_it_is_not(search) -> None:
    here, there = Steps.of(search), Steps.of(search, FAR)
    np.testing.assert_allclose(there.local, here.local, atol=1e-12)
    np.testing.assert_array_equal(there.sigma, here.sigma)
    assert there.world.max() > 2.0 * here.world.max()


def test_sigma_is_the_largest_singular_value_of_what_a_step_turns(search) -> None:
    turns = Rotation.from_quat(search.rotations)
    between = (turns[1:] * turns[:-1].inv()).as_matrix() - np.eye(3)
    wanted = np.linalg.svd(between, compute_uv=False)[:, 0]
    np.testing.assert_allclose(Steps.of(search).sigma, wanted, atol=1e-7)


def test_a_walk_sways_about_the_middle_of_its_supports(tmp_path) -> None:
    (shown,) = shown_on(demos.build("reaching", tmp_path))
    (mark,) = (edit.balance for edit in shown.edits if edit.balance is not None)
    apart = (mark.before - mark.supports.mean(axis=1))[:, [0, 2]]
    assert np.abs(apart[:, 0].mean()) < 0.005 < np.abs(apart[:, 0]).max() < 0.05
    assert np.abs(apart[:, 1]).max() < 0.2
