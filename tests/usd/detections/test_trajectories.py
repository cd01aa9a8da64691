"""What stands for the size of a prop is the box around its shapes in its own frame."""

import numpy as np
from pxr import Usd

from usdmotion import demos
from usdmotion.usd.detections.trajectories import read_trajectory
from usdmotion.usd.stages import read_facts


def test_a_box_is_as_large_as_what_it_is_around_however_that_is_turned(tmp_path):
    stage = Usd.Stage.Open(str(demos.build("dice", tmp_path)))
    facts = read_facts(stage)
    for path, half in (("/Dice/First", 0.1008), ("/Dice/First/Body", 0.1)):
        points = read_trajectory(stage.GetPrimAtPath(path), facts).points
        assert points.shape == (8, 3)
        np.testing.assert_allclose(np.abs(points), half, rtol=1e-6)
