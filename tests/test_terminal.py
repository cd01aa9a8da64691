"""What a terminal shows: tables of plain values, documents written whole."""

from dataclasses import dataclass
from pathlib import Path

import pytest
from rich.table import Table

from usdmotion.errors import FileError
from usdmotion.terminal import Terminal, table, tables, to_json, write_text


@dataclass(frozen=True)
class Line:
    name: str
    size: float
    good: bool = True
    tags: tuple[str, ...] = ()
    note: str | None = None


@dataclass(frozen=True)
class Sheet:
    title_of_it: str
    empty: str
    lines: tuple[Line, ...]


def shown(table: Table) -> dict[str, list[str]]:
    return {str(column.header): [str(cell) for cell in column.cells] for column in table.columns}


def test_a_table_has_a_column_for_each_field_that_says_something() -> None:
    lines = [Line("[one]", 0.5, tags=("a", "b")), Line("two", 2.0, good=False)]
    assert shown(table("lines", lines)) == {
        "name": ["[one]", "two"],
        "size": ["0.5", "2"],
        "good": ["yes", "no"],
        "tags": ["a, b", ""],
    }


def test_a_long_list_is_cut_and_counted() -> None:
    line = Line("", 0.0, tags=tuple("abcdefg"))
    assert shown(table("lines", [line]))["tags"] == ["a, b, c, d, … (7)"]


def test_values_are_shown_line_by_line_and_lists_as_tables() -> None:
    first, second = tables(Sheet("sheet", "", (Line("one", 1.0),)))
    assert first == "title of it: sheet"
    assert isinstance(second, Table) and second.title == "lines"


def test_json_has_the_fields_as_keys() -> None:
    assert to_json(Line("one", 1.5)) == (
        '{\n  "name": "one",\n  "size": 1.5,\n  "good": true,\n  "tags": [],\n  "note": null\n}'
    )


def test_text_is_shown_as_it_is_and_markup_means_nothing(
    capsys: pytest.CaptureFixture[str],
) -> None:
    terminal = Terminal.open()
    terminal.tell("[bold]no[/]")
    terminal.note("[red]beware[/]")
    said = capsys.readouterr()
    assert said.out == "[bold]no[/]\n"
    assert said.err == "note: [red]beware[/]\n"


def test_stdout_is_left_to_the_json_where_that_goes_there(
    capsys: pytest.CaptureFixture[str],
) -> None:
    Terminal.open(json="-").tell("for people")
    write_text("{}", "-")
    said = capsys.readouterr()
    assert said.out == "{}\n"
    assert said.err == "for people\n"


def test_quiet_says_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    terminal = Terminal.open(quiet=True)
    terminal.tell("for people")
    terminal.note("this")
    with terminal.busy() as say:
        say("working")
    assert capsys.readouterr() == ("", "")


def test_a_document_is_written_whole_and_nothing_is_left_beside_it(tmp_path: Path) -> None:
    target = tmp_path / "report.json"
    target.write_text("old")
    write_text("{}", str(target))
    assert target.read_text() == "{}\n"
    assert list(tmp_path.iterdir()) == [target]


def test_a_place_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"report\.json: cannot be written: No such file"):
        write_text("{}", str(tmp_path / "absent" / "report.json"))
