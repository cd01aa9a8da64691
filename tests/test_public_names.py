"""The public names, once; and that they are cheap and need no USD."""

import subprocess
import sys

import pytest

import usdmotion
import usdmotion.kernels
import usdmotion.s4d
import usdmotion.testing

NAMES = """
AimTask Axes Body Bools Capture Cast Character Cluster Constraint Contact Demand Detected Detector
DistanceTask Edit Event Example FileError Floats ForcePlate Goal Ground InputError Ints Joint Live
Markers Motion NoisePattern NormalizedMotion OptionError OrientationConstraint Performance Placement
PluginError PointTask Pose PositionConstraint Problem Reader Recording RotationTask Scene SceneError
Search Session Skeleton Solution Solver Spline Template Term TurnGoal UsdMotionError attribute
composite_point composite_turn configured cue detect ease hookimpl host import_motion inspect
normalize option relation retarget solve
""".split()


def test_the_public_names_are_these() -> None:
    assert usdmotion.__all__ == NAMES
    assert dir(usdmotion) == sorted(NAMES)


@pytest.mark.parametrize("module", [usdmotion, usdmotion.kernels, usdmotion.s4d, usdmotion.testing])
def test_every_public_name_is_there(module: object) -> None:
    names = module.__all__  # type: ignore[attr-defined]
    assert sorted(names) == sorted(set(names))
    for name in names:
        assert getattr(module, name) is not None


def test_a_name_that_is_not_public_is_no_attribute() -> None:
    with pytest.raises(AttributeError, match="module 'usdmotion' has no attribute 'seal'"):
        usdmotion.seal  # noqa: B018


def modules_after(statement: str) -> set[str]:
    script = f"import sys; {statement}; print(*sys.modules)"
    said = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    return set(said.stdout.split())


def test_importing_the_package_imports_nothing_that_is_slow() -> None:
    assert not {"numpy", "numba", "scipy", "pxr"} & modules_after("import usdmotion")


def test_the_help_of_the_command_line_imports_nothing_that_is_slow() -> None:
    loaded = modules_after("import usdmotion.cli")
    assert not {"numpy", "numba", "scipy", "pxr"} & loaded


def test_no_public_name_needs_usd() -> None:
    loaded = modules_after("from usdmotion import *; import usdmotion.testing")
    assert "numba" in loaded
    assert "pxr" not in loaded
