"""Feet without a template, at the rates that captures have, with and without noise."""

import pytest


@pytest.mark.parametrize("rate", [25.0, 50.0, 100.0])
@pytest.mark.parametrize(
    ("noise", "outliers"), [(0.0, 0.0), (0.0, 0.02), (0.005, 0.0), (0.01, 0.02), (0.02, 0.0)]
)
def test_feet_on_force_plates_are_right_at_any_rate_and_noise(
    limbs, said, tell, rate, noise, outliers
):
    group = [limb.thinned(rate).noisy(noise, outliers) for limb in limbs["force plates"]]
    first, *others = [limb.judge(said(limb)) for limb in group]
    f1 = sum(others, first).f1
    tell(f"feet at {rate:.0f} Hz, {noise * 1e3:.0f} mm, {outliers:.0%} outliers: F1 {f1:.3f}")
    assert f1 > 0.9
