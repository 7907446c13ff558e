"""A case on paper: a page with a verdict, its figure, the limits and what may change a decision; then pages with all else."""
from __future__ import annotations

from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence, Tuple

import matplotlib
import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from .._errors import UsageError
from . import sheet_text, style
from .case_files import Case, read_case
from .files import PathLike
from .limit_bars import ENDS, footnotes, marked_name, value_text
from .paper import HEIGHT_MM, Block, Cell, Column, Paper, nothing, stacked, wrapped
from .rim_clock import clock_text
from .sheet_pictures import EDGE_MM, INNER_MM, PICTURE_MM, TITLE_MM, Picture, bars, pictures_of
from .sheet_text import Note, Row
from .words import number, spaced

GAP_MM, LAST_MM = 2.2, HEIGHT_MM - EDGE_MM - 3
BIG, TEXT, TABLE, SMALL = 12.0, 8.0, 7.5, 7.0
"""Sizes of type in points; there is none smaller."""
MOST_TARGETS = 3
"""Sentences on targets beside that of the verdict; more stand behind the first page, whose table has all."""
DPI = 180
"""Of pictures: at this one no picture, whatever it shows, adds more than 1.4 MB to the file."""


def sheet(inputs: Sequence[PathLike], *, case: str = "", date: str = "", note: str = "", picture: Optional[PathLike] = None) -> List[Figure]:
    """Draws A4 pages of one case from what `condyle rom`, `resect`, `measure` and `sweep` wrote.

    The first has what a decision needs: a verdict, the figure of now and planned, the limits, at most five notes. All else stands on the
    pages after it. Write them by `save(pages, "case.pdf", dpi=180)`.

    Parameters
    ----------
    inputs
        rom.json, resection.json, measures.json, sweep.json, by their names or those of their folders; one of each at most, of one joint.
    case, date, note
        Texts for the heading; nothing is taken from the clock.
    picture
        A PNG file to show as the cut, in place of depth_mobile.png and depth_fixed.png beside resection.json.

    Raises
    ------
    ReadError
        A file is bad, or they are not of one joint.
    UsageError
        The texts leave no room for the limits on the first page.
    """
    found = read_case(inputs)
    with style.print_style(), matplotlib.rc_context({"text.parse_math": False, "font.size": 9.5}):
        paper = Paper()
        try:
            _fill(paper, found, (case, date, note), pictures_of(paper, found, None if picture is None else Path(picture)))
        except BaseException:
            for page in paper.pages:
                plt.close(page)
            raise
    return paper.pages


def _fill(paper: Paper, case: Case, heading: Tuple[str, str, str], pictures: List[Picture]) -> None:
    rows = sheet_text.rows_of(case)
    upper, below, notes = _above(paper, case, rows, heading), _below(paper, case, rows), sheet_text.notes(case)
    table = (_limits(paper, rows) if rows else []) + (_targets(paper, case) if case.sweep else [])
    main = [each for each in pictures[:1] if each.width <= PICTURE_MM]
    wide = INNER_MM - PICTURE_MM - 4 if main else INNER_MM
    shown = main + ([bars(paper, rows, sheet_text.headline(case, rows), wide)] if rows else [])
    least = max((each.least for each in shown), default=0.0)
    for count in range(5, -1, -1):
        first, rest = sheet_text.first_and_rest(notes, count)
        lower = _notes(paper, case, first)
        room = LAST_MM - EDGE_MM - upper.height - below.height - lower.height - GAP_MM
        if room >= least + sum(block.height for block in table[:4]):
            break
    else:
        raise UsageError("the names and the note of the case leave no room for its limits on the first page")
    count = max(i for i in range(len(table) + 1) if sum(block.height for block in table[:i]) <= room - least)
    best = max((each.best for each in shown), default=0.0)
    height = min(best, room - sum(block.height for block in table[:count]))
    top = paper.flow([upper], EDGE_MM, EDGE_MM, LAST_MM)
    for each in shown:
        _draw(paper, each, EDGE_MM if each in main else EDGE_MM + INNER_MM - wide, top, PICTURE_MM if each in main else wide, height)
    paper.flow([*table[:count], below], top + height + GAP_MM, EDGE_MM, HEIGHT_MM)
    paper.flow([lower], LAST_MM - lower.height, EDGE_MM, HEIGHT_MM)
    paper.turn()
    _rest(paper, case, rows, table[count:], pictures[len(main):], rest)
    for i, page in enumerate(paper.pages):
        paper.figure = page
        more = "All other notes, contacts, shape, sources and files follow." if i == 0 else sheet_text.patient_line(case, *heading[:2])
        foot = wrapped(f"Page {i + 1} of {len(paper.pages)}. {more}", INNER_MM, SMALL)[0]
        paper.line(EDGE_MM, HEIGHT_MM - EDGE_MM - 2, foot, SMALL, colour="#555555")


def _draw(paper: Paper, picture: Picture, left: float, top: float, width: float, height: float) -> None:
    paper.first_line(left, top, picture.title, width, 9)
    picture.draw(left, top + TITLE_MM, width, height - TITLE_MM)


def _above(paper: Paper, case: Case, rows: List[Row], heading: Tuple[str, str, str]) -> Block:
    """From the name of the case, its date and its note to what the plan gives."""
    name, date, note = heading
    text, colour = sheet_text.heading(case)
    blocks = [paper.paragraph(sheet_text.patient_line(case, name, date), EDGE_MM, INNER_MM, 10, bold=True)]
    blocks += [paper.paragraph(note, EDGE_MM, INNER_MM, TEXT)] * bool(note)
    blocks += [nothing(1), paper.ribbon(text, EDGE_MM, INNER_MM, BIG, colour), nothing(1)]
    if rows:
        blocks += [paper.paragraph(" ".join(sheet_text.verdict(case, rows)), EDGE_MM, INNER_MM, BIG, bold=True), nothing(0.8)]
    said = _other_targets(case, rows)[:MOST_TARGETS] + ([sheet_text.how_planned(case.plan)] if case.plan and case.plan["cuts"] else []) + ([sheet_text.sweep_line(case.sweep)] if case.sweep else [])
    return stacked([*blocks, *(paper.paragraph(each, EDGE_MM, INNER_MM, 9) for each in said), nothing(GAP_MM)])


def _other_targets(case: Case, rows: List[Row]) -> List[str]:
    return sheet_text.other_targets(case, sheet_text.headline(case, rows).now.name if rows else "")


def _notes(paper: Paper, case: Case, first: List[Note]) -> Block:
    blocks = [paper.paragraph(f"• {note.text}", EDGE_MM, INNER_MM, TEXT) for note in first]
    return stacked([nothing(1.2), *blocks, nothing(0.8), paper.paragraph(sheet_text.scope(case), EDGE_MM, INNER_MM, TEXT, bold=True)])


def _rest(paper: Paper, case: Case, rows: List[Row], table: List[Block], pictures: List[Picture], notes: List[Note]) -> None:
    """All that is not on the first page."""
    top = paper.flow(table, EDGE_MM, EDGE_MM, LAST_MM)
    for picture in pictures:
        if top + picture.best > LAST_MM:
            paper.turn()
            top = EDGE_MM
        _draw(paper, picture, EDGE_MM, top, picture.width, picture.best)
        top += picture.best + GAP_MM
    said = _other_targets(case, rows)[MOST_TARGETS:] + [each for each in (sheet_text.shape(case), sheet_text.how_sure(case, rows)) if each]
    blocks = [block for each in said for block in (*paper.lines(each, EDGE_MM, INNER_MM, TEXT), nothing(1.5))]
    blocks += [paper.paragraph("Notes", EDGE_MM, INNER_MM, 9, bold=True)] * bool(notes)
    blocks += [line for note in notes for line in paper.lines(f"• {note.text}", EDGE_MM, INNER_MM, TEXT)]
    paper.flow([*blocks, nothing(1.5), *paper.lines(sheet_text.made_from(case), EDGE_MM, INNER_MM, SMALL, colour="#555555")], top, EDGE_MM, LAST_MM)


def _below(paper: Paper, case: Case, rows: List[Row]) -> Block:
    """What the columns of the limits are of."""
    below = ["Other hips: of living people, in grey a clinical range."] * any(row.living[0] for row in rows)
    below += ["Simulated: where bone ends it in healthy hips."] * any(row.limit.get("bone_reference") for row in rows)
    below += ["Not compared with other hips, as zero is not known to be neutral."] * (case.rom is not None and (case.rom.get("zero") or {}).get("is_neutral") is False)
    below += ["In brackets: 5 to 95 % of varied joints, this one with its centre, axes and surfaces moved within their uncertainty."] * any(end.band for row in rows for end in row.ends)
    below += [f"{each}." for each in footnotes([row.now for row in rows])]
    return paper.paragraph(" ".join(below), EDGE_MM, INNER_MM, SMALL)


def _limits(paper: Paper, rows: Sequence[Row]) -> List[Block]:
    """Columns in which no motion has anything are left out."""
    others = [(row.target or {}).get("other_centre") for row in rows]
    centre = next((f"{each['centre']}'s centre" for each in others if each), "")
    at_rim = any(row.now.hour is not None for row in rows)
    fields: Dict[Column, List[str]] = {
        Column("now"): [value_text(row.ends[0]) for row in rows],
        Column("target"): [sheet_text.degrees_text(row.target["reach_deg"]) if row.target else "" for row in rows],
        Column("planned"): [value_text(row.ends[1]) if row.after else "" for row in rows],
        Column(centre): [f"{each['before_deg']:.1f} → {each['after_deg']:.1f}°" if each else "" for each in others],
        Column("other hips", 2): [row.living[0] for row in rows],
        Column("ended by (socket's clock)" if at_rim else "ended by", 3): [_ended_by(row, at_rim) for row in rows],
    }
    kept = {column: texts for column, texts in fields.items() if any(texts)}
    cells = []
    for i, row in enumerate(rows):
        grey = {"other hips": row.living[1], "planned": not row.is_changed}
        given = [Cell(texts[i] or "–", bold=column.heading == "planned" and row.is_changed,
                      colour=style.GREY if grey.get(column.heading) else style.BLACK) for column, texts in kept.items()]
        cells.append([Cell(str(i + 1)), Cell(marked_name(row.now), bold=row.target is not None), *given])
    return paper.table([Column(""), Column("motion", 4), *kept], cells, EDGE_MM, INNER_MM, TABLE)


def _ended_by(row: Row, at_rim: bool) -> str:
    """With the meshes that meet, if a body has several; the hour at the rim, or where others have one, that it has none."""
    words = ENDS[row.now.end].words
    if row.now.end not in sheet_text.CONTACTS:
        return words
    hour = [clock_text(row.now.hour)] if row.now.hour is not None else ["away from the rim"] * at_rim
    return ", ".join([words, *[row.pair] * row.is_of_parts, *hour])


def _targets(paper: Paper, case: Case) -> List[Block]:
    """Limits of the sweep's targets, of the joint as it is and of the best design."""
    assert case.sweep is not None
    designs = [{each["target"]: each for each in (design or {"limits": []})["limits"]} for design in (case.sweep["here"], case.sweep["best"])]

    def limit(design: Dict[str, Any], target: str) -> str:
        if target not in design:
            return "–"
        pair = design[target].get("ended_by")
        return f"{design[target]['limit_deg']:.1f}°" + (f", {spaced(pair['mobile'])} on {spaced(pair['fixed'])}" if pair else "")

    columns = [Column("target of the sweep", 4), Column("needs"), Column("as it is", 3), Column("best design", 3)]
    rows = [[Cell(spaced(target["name"])), Cell(f"{number(target['reach_deg'])}°"), *(Cell(limit(design, target["name"])) for design in designs)]
            for target in case.sweep["targets"]]
    return paper.table(columns, rows, EDGE_MM, INNER_MM, TEXT)
