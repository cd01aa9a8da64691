"""The benchmarks still run; what they measure is nobody's pass or fail."""

import compare
import figures
from comparison import rounds


def test_every_figure_is_measured(capsys) -> None:
    measured = figures.main(True)
    assert len(measured) == 23
    assert all(each.seconds > 0 and each.yardstick > 0 for each in measured)
    assert "one iteration" in capsys.readouterr().out


def test_the_comparison_runs_where_no_other_library_is_to_be_had(monkeypatch, capsys) -> None:
    monkeypatch.setattr(rounds, "start", lambda contestants, stack: iter(()))
    compare.main(True)
    said = capsys.readouterr().out
    assert said.count("usdmotion") == 3
    assert "within 1 mm" in said
