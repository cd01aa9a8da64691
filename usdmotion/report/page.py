"""One file of HTML that tells everything: verdicts first, then pictures, then where it is from."""

from base64 import b64encode
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from importlib.resources import files

from usdmotion.report.effects import Effect, effects
from usdmotion.report.findings import EditFindings, Findings, Trace
from usdmotion.report.pictures import Picture
from usdmotion.report.wording import amount, kind_of


@dataclass(frozen=True, eq=False)
class Chapter:
    """One edit with its pictures."""

    findings: Findings
    edit: EditFindings
    pictures: Mapping[str, Sequence[Picture]]
    """By what they show."""
    frames: Sequence[Picture]
    """Postures that are worth looking at."""
    strip: Picture | None = None
    """The motion before and after, at the frames that tell it."""


_SECTIONS = (
    ("errors", "What is left, over time"),
    ("changes", "What was changed"),
    ("balance", "Balance"),
    ("feet", "Feet"),
    ("jerk", "Smoothness"),
)
"""The sections of a chapter, by their pictures."""


def page(title: str, chapters: Sequence[Chapter]) -> str:
    """Return a report as a page that needs nothing else.

    Args:
        title: Name of the shot.
        chapters: One for each edit.
    """
    style = files(__package__).joinpath("page.css").read_text(encoding="utf-8")
    body = [f"<h1>{escape(title)}</h1>", _verdict(chapters), *_stale(chapters), *_notes(chapters)]
    for chapter in chapters:
        body += _chapter(chapter)
    return "\n".join(
        [
            '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>{escape(title)}</title>\n<style>\n{style}</style>\n</head>\n<body>",
            *body,
            "</body>\n</html>",
        ]
    )


def _verdict(chapters: Sequence[Chapter]) -> str:
    traces = [trace for chapter in chapters for trace in chapter.edit.traces]
    missed = [trace for trace in traces if not trace.verdict.met]
    if not traces:
        return '<p class="verdict">Nothing was asked.</p>'
    if not missed:
        every = (
            "The one constraint is" if len(traces) == 1 else f"All {len(traces)} constraints are"
        )
        return f'<p class="verdict">✓ {every} met.</p>'
    worst = max(missed, key=lambda trace: trace.verdict.max / trace.tolerance)
    largest = amount(worst.verdict.max, worst.verdict.unit)
    return (
        f'<p class="verdict missed">✗ {len(missed)} of {len(traces)} constraints '
        f"{'is' if len(missed) == 1 else 'are'} missed, most of all "
        f"{escape(worst.name)}: {largest} at "
        f"{worst.verdict.worst_time:g}.</p>"
    )


def _stale(chapters: Sequence[Chapter]) -> Iterable[str]:
    for chapter in chapters:
        record = chapter.edit.record
        path = f"<code>{escape(record.edit)}</code>"
        if record.stale:
            yield (
                f'<p class="stale"><strong>The result of {path} is stale.</strong> The shot has '
                "changed since it was solved, so that what is told here is how far an old answer "
                "is from what is asked now. Solve it again.</p>"
            )
        if not record.shown:
            yield (
                f'<p class="stale"><strong>The result of {path} is not what is shown.</strong> Its '
                "Skeleton is bound to another animation.</p>"
            )


def _notes(chapters: Sequence[Chapter]) -> list[str]:
    notes = dict.fromkeys(note for chapter in chapters for note in chapter.findings.notes)
    if not notes:
        return []
    return ['<ul class="notes">', *(f"<li>{escape(note)}</li>" for note in notes), "</ul>"]


def _chapter(chapter: Chapter) -> Iterable[str]:
    edit, scene = chapter.edit, chapter.findings.scene
    codes = scene.time_codes
    yield f"<h2>{escape(edit.edit.path)}</h2>"
    yield (
        f'<p class="facts">{len(codes)} frames, {codes[0]:g} to {codes[-1]:g}, '
        f"{float(scene.cast.times[-1]):.2f} s · {escape(edit.record.solver)}</p>"
    )
    if chapter.strip is not None:
        yield _pixels(chapter.strip)
    yield from _table(edit)
    yield from map(_figure, chapter.pictures["overview"])
    yield from _effects(effects(edit, scene.up))
    if chapter.frames:
        yield "<h3>Frames to look at</h3>"
        yield (
            '<p class="quiet">The input pale, the result solid, its right side darker. Crossed '
            "circles are goals, rings are joints of which something else than a place is asked, "
            "green dots are what is kept where it was.</p>"
        )
        yield '<div class="frames">'
        yield from map(_figure, chapter.frames)
        yield "</div>"
    for name, heading in _SECTIONS:
        if chapter.pictures[name]:
            yield f"<h3>{heading}</h3>"
            yield from map(_figure, chapter.pictures[name])
    yield from _origin(edit)


def _table(edit: EditFindings) -> Iterable[str]:
    yield '<div class="table"><table>'
    heads = ("Constraint", "Kind", "Largest error", "At", "rms", "Tolerance", "Verdict")
    numbers = (2, 3, 4, 5)
    cells = (
        f"<th{' class=number' if index in numbers else ''}>{head}</th>"
        for index, head in enumerate(heads)
    )
    yield f"<thead><tr>{''.join(cells)}</tr></thead><tbody>"
    for rank, traces in edit.levels:
        met = sum(trace.verdict.met for trace in traces)
        yield (
            f'<tr class="level"><td colspan="6">Priority {rank}</td>'
            f"<td>{met} of {len(traces)} met</td></tr>"
        )
        yield from map(_row, traces)
    yield "</tbody></table></div>"


def _effects(found: Sequence[Effect]) -> Iterable[str]:
    if found:
        yield '<h3>What else it did</h3><div class="table"><table><thead><tr><th></th>'
        yield '<th class="number">Input</th><th class="number">Result</th></tr></thead><tbody>'
        for each in found:
            told = (amount(value, each.unit) for value in (each.before, each.after))
            numbers = "".join(f'<td class="number">{value}</td>' for value in told)
            yield f"<tr><td>{escape(each.name)}</td>{numbers}</tr>"
        yield "</tbody></table></div>"


def _row(trace: Trace) -> str:
    verdict, unit = trace.verdict, trace.verdict.unit
    if verdict.worst_time is None:
        told, mark = ("—", "—", "—"), "never fully on"
    else:
        told = (amount(verdict.max, unit), f"{verdict.worst_time:g}", amount(verdict.rms, unit))
        mark = (
            '<span class="mark is-met">✓ met</span>'
            if verdict.met
            else '<span class="mark is-missed">✗ missed</span>'
        )
    numbers = (*told, amount(trace.tolerance, unit))
    return (
        f"<tr><td>{escape(trace.name)}</td><td>{escape(kind_of(verdict.type))}</td>"
        + "".join(f'<td class="number">{number}</td>' for number in numbers)
        + f"<td>{mark}</td></tr>"
    )


def _figure(picture: Picture) -> str:
    return f"<figure>{picture.svg()}<figcaption>{escape(picture.caption)}</figcaption></figure>"


def _pixels(picture: Picture) -> str:
    """Return the figure of a picture of many bodies, which is smaller as pixels."""
    told = escape(picture.caption)
    data = b64encode(picture.png()).decode()
    return (
        f'<figure><img alt="{told}" src="data:image/png;base64,{data}">'
        f"<figcaption>{told}</figcaption></figure>"
    )


def _origin(edit: EditFindings) -> Iterable[str]:
    """Tell where a result comes from."""
    record = edit.record
    state = "differs: the shot has changed since" if record.stale else "the same"
    told = {
        "Edit": record.edit,
        "Skeleton": edit.edit.skeleton,
        "Solver": record.solver,
        "Made by": f"usdmotion {record.version}",
        "Hash of what was read": record.input_hash,
        "The same hash now": state,
        "Masses": edit.character.masses_from,
    }
    yield "<h3>Where it comes from</h3><dl>"
    yield from (f"<dt>{name}</dt><dd>{escape(held)}</dd>" for name, held in told.items())
    options = ", ".join(
        f"{name} = {_shown(record.options[name])}" for name in sorted(record.options)
    )
    yield f"<dt>Options</dt><dd>{escape(options) or '—'}</dd></dl>"


def _shown(value: object) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)
