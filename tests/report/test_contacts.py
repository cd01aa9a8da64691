"""What is told of a detection: tables for people, JSON for programs."""

import json

from rich.console import Console

from usdmotion.report.contacts import ContactReport, DetectionReport, ObjectReport, PatternReport


def contact(name: str, state: str = "detected", residual: float | None = 0.002) -> ContactReport:
    return ContactReport(f"/Edit/Foot/{name}", "space", 4.0, 16.5, 0.5, residual, state)  # type: ignore[arg-type]


def of(*contacts: ContactReport, pattern: PatternReport | None = None) -> DetectionReport:
    foot = ObjectReport(
        "/Edit/Foot", "hips/foot", "contacts", ("space", "line"), 24, 1.0, 24.0, pattern, contacts
    )
    return DetectionReport((foot,), ("a note",))


def shown(report: DetectionReport) -> str:
    console = Console(width=120, record=True, force_terminal=False)
    for each in report.tables():
        console.print(each, markup=False)
    return console.export_text()


def test_a_row_says_what_holds_from_when_to_when_and_how_well() -> None:
    said = shown(of(contact("Contact01"), contact("Mine", "own", None)))
    first, mine = (line for line in said.splitlines() if "space │" in line)
    assert [cell.strip() for cell in first.split("│")[1:-1]] == [
        "Contact01",
        "space",
        "4",
        "16.5",
        "0.50",
        "2.00 mm",
        "",
    ]
    assert [cell.strip() for cell in mine.split("│")[6:-1]] == ["", "kept"]


def test_the_title_says_where_the_noise_pattern_is_from() -> None:
    pattern = PatternReport("templates", (0.01, 0.02), (0.001, 0.001))
    said = shown(of(contact("Contact01"), pattern=pattern))
    assert "</Edit/Foot>: space, line by contacts, σ up to 0.01 to 0.02" in said
    assert "ε up to 1 mm by templates" in said


def test_nothing_found_is_one_line() -> None:
    assert shown(of()).strip() == "</Edit/Foot>: space, line by contacts: no contact"


def test_what_is_off_does_not_count() -> None:
    states = ("detected", "template", "own", "off", "dropped")
    assert of(*(contact(f"C{n}", state) for n, state in enumerate(states))).count == 3


def test_json_has_all_of_it() -> None:
    data = json.loads(of(contact("Contact01")).to_json())
    assert data["notes"] == ["a note"]
    (foot,) = data["objects"]
    assert foot["kinds"] == ["space", "line"]
    assert foot["contacts"][0]["end"] == 16.5
