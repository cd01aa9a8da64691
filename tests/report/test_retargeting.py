"""What is told of a motion on another body: nothing that nobody knows, one row for one thing."""

from rich.console import Console

from usdmotion.report.normalizing import travellers_of, travellers_table
from usdmotion.report.retargeting import MappedReport, RetargetingReport, SlideReport
from usdmotion.travelling import Left


def shown(tables):
    console = Console(width=200)
    with console.capture() as capture:
        console.print(*tables)
    return capture.get()


def told(before):
    slide = SlideReport("l_talocrural", 2, before, 0.0012, before, 0.0007)
    return RetargetingReport(
        source="/Walk",
        skeleton="/Body/Skeleton",
        animation="/Body/Walk",
        edit="",
        frames=10,
        first=1.0,
        last=10.0,
        leg_before=None,
        leg=0.8,
        mapped=MappedReport((), (), (), (), (), ()),
        slides=(slide,),
        travellers=(),
        edits=(),
    )


def test_a_slide_before_that_nobody_knows_is_no_slide_of_zero():
    unknown = shown(told(None).tables())
    assert unknown.count("—") == 3 and "nobody knows the body" in unknown
    assert "1.20 mm" in unknown and "0.00 mm" not in unknown
    known = shown(told(0.0).tables())
    assert known.count("0.00 mm") == 2 and "—" not in known


def test_contacts_that_stay_behind_for_one_reason_take_one_row():
    left = [Left(f"Toes/Contact{index:02d}", "there is no joint 'toe'") for index in range(16)]
    left += [Left("Toes/Other", "it is about a prop"), Left("Hand", "there is no joint 'hand'")]
    table = shown(travellers_table(travellers_of((), left, ())))
    assert "16 of Toes" in table and table.count("there is no joint 'toe'") == 1
    assert "Toes/Other" in table and "no: it is about a prop" in table
    assert "Hand" in table and "Contact01" not in table
