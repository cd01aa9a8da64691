"""How numbers are worded."""

import pytest

from usdmotion.report.wording import amount, kind_of


@pytest.mark.parametrize(
    ("value", "unit", "said"),
    [
        (0.0, "m", "0.000 mm"),
        (4e-8, "m", "under 0.001 mm"),
        (0.000123, "m", "0.123 mm"),
        (0.00456, "m", "4.56 mm"),
        (0.0421, "m", "42.1 mm"),
        (0.5, "m", "500 mm"),
        (12.0, "m", "12000 mm"),
        (0.0, "deg", "0°"),
        (1e-5, "deg", "under 0.001°"),
        (12.345, "deg", "12.3°"),
        (3.14159, "m/s³", "3.14 m/s³"),
        (1510.4, "m/s³", "1510 m/s³"),
    ],
)
def test_a_number_is_as_long_as_it_is_worth(value, unit, said):
    assert amount(value, unit) == said


def test_a_kind_goes_by_its_own_name():
    assert kind_of("MotionCenterOfMassConstraint") == "CenterOfMass"
