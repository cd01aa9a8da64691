"""What was asked, what was met, what was disturbed.

`verdict` is the table and the JSON; `findings` is everything that can be told of an outcome;
`pictures` draws it, which needs matplotlib; `page` is one file of HTML.
"""

from usdmotion.report.verdict import ConstraintReport, EditReport, Report, judge

__all__ = ["ConstraintReport", "EditReport", "Report", "judge"]
