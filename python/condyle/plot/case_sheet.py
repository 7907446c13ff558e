"""A case on one sheet of paper: limits now and planned, what is removed, where contacts are, and what was noted."""
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
from .limit_bars import ENDS, footnotes, marked_name, turned_text
from .paper import HEIGHT_MM, WIDTH_MM, Block, Cell, Column, Paper, nothing, stacked, width_mm
from .rim_clock import clock_text
from .sheet_pictures import TITLE_MM, Picture, pictures_of
from .sheet_text import Note, Row
from .words import number, spaced

EDGE_MM, GAP_MM = 12.0, 2.2
INNER_MM = WIDTH_MM - 2 * EDGE_MM
PICTURE_MM = INNER_MM / 2 - 2
SIZES = (1.0, 0.95, 0.9, 0.85, 0.8, 0.75, 0.7)
"""Sizes of type that are tried, over those of a sheet with room."""
DPI = 180
"""Of pictures: at this one no picture, whatever it shows, makes the file larger than 1 MB."""


def sheet(inputs: Sequence[PathLike], *, case: str = "", date: str = "", note: str = "", picture: Optional[PathLike] = None) -> Figure:
    """Draws an A4 page of one case from what `condyle rom`, `resect`, `measure` and `sweep` wrote.

    Type gets smaller until all stands on the page; where it would get too small, a line says how many notes are left out
    and which file has them. Write it by `save(figure, "case.pdf", dpi=180)`.

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
        There are too many motions, or too long texts, for one page.
    """
    found = read_case(inputs)
    with style.print_style(), matplotlib.rc_context({"text.parse_math": False}):
        paper = Paper()
        try:
            pictures = pictures_of(paper, found, None if picture is None else Path(picture), PICTURE_MM)
            _fill(paper, found, case, date, note, pictures)
        except BaseException:
            plt.close(paper.figure)
            raise
    return paper.figure


def _fill(paper: Paper, case: Case, name: str, date: str, note: str, pictures: List[Picture]) -> None:
    """Draws with the largest type with which all fits; with the smallest, the notes that fit."""
    pairs = [pictures[i:i + 2] for i in range(0, len(pictures), 2)]
    least = sum(max(each.least for each in pair) + GAP_MM for pair in pairs)
    upper, lower, room = _fitting(paper, case, (name, date, note), least)
    upper.draw(EDGE_MM)
    top = EDGE_MM + upper.height
    for pair in pairs:
        height = min(max(each.best for each in pair), max(each.least for each in pair) + (room - least) / len(pairs))
        for i, each in enumerate(pair):
            left = EDGE_MM + i * (INNER_MM - PICTURE_MM)
            paper.line(left, top, each.title, min(7.5, PICTURE_MM / width_mm(each.title, 1, True)), bold=True)
            each.draw(left, top + TITLE_MM, PICTURE_MM, height - TITLE_MM)
        top += height + GAP_MM
    lower.draw(top)


def _fitting(paper: Paper, case: Case, heading: Tuple[str, str, str], least: float) -> Tuple[Block, Block, float]:
    """What stands above and below the pictures, and the height in mm that is left for these, at least `least`."""
    rows, notes = sheet_text.rows_of(case), sheet_text.notes(case)
    for size in SIZES:
        upper = _above(paper, case, rows, heading, size)
        for count in range(len(notes), -1 if size == SIZES[-1] else len(notes) - 1, -1):
            lower = _below(paper, case, notes[:count], notes[count:], size)
            room = HEIGHT_MM - 2 * EDGE_MM - upper.height - lower.height
            if room >= least:
                return upper, lower, room
    raise UsageError(f"{len(rows)} motions, the names and the note do not fit on one page: condyle rom --motion chooses motions")


def _above(paper: Paper, case: Case, rows: List[Row], heading: Tuple[str, str, str], size: float) -> Block:
    """From the name of the case, its date and its note to the table."""
    name, date, note = heading
    colour = style.VERMILION if case.plan else "#555555"
    blocks = [paper.paragraph(sheet_text.patient_line(case, name, date), EDGE_MM, INNER_MM, 11 * size, bold=True)]
    if note:
        blocks.append(paper.paragraph(note, EDGE_MM, INNER_MM, 8.5 * size))
    blocks += [nothing(1.2), paper.ribbon(sheet_text.heading(case), EDGE_MM, INNER_MM, 11 * size, colour), nothing(1.2)]
    said = [sheet_text.limited_most(rows)] if rows else []
    said += sheet_text.reached(case.plan) if case.plan else []
    said += [sheet_text.sweep_line(case.sweep)] if case.sweep else []
    blocks += [paper.paragraph(each, EDGE_MM, INNER_MM, 8.5 * size) for each in said]
    if rows:
        blocks += [nothing(1.2), _table(paper, rows, 8 * size)]
        source = case.rom and any(row.now.normal_deg is not None for row in rows) and case.rom.get("normal_range_source")
        below = [f"Clinical range: {source}."] * bool(source) + [sheet_text.how_sure(case)]
        below += [f"{each}." for each in footnotes([row.now for row in rows])]
        blocks.append(paper.paragraph(" ".join(below), EDGE_MM, INNER_MM, 6.5 * size))
    if case.sweep:
        blocks += [nothing(1.2), _targets(paper, case, 8 * size)]
    return stacked([*blocks, nothing(GAP_MM)])


def _below(paper: Paper, case: Case, notes: List[Note], left_out: List[Note], size: float) -> Block:
    """From the shape to the end of the page."""
    blocks: List[Block] = []
    shape = sheet_text.shape(case)
    if shape:
        blocks += [paper.paragraph(shape, EDGE_MM, INNER_MM, 7 * size), nothing(1)]
    if notes or left_out:
        blocks.append(paper.paragraph("Notes", EDGE_MM, INNER_MM, 7.5 * size, bold=True))
        blocks.append(paper.in_two_columns([f"• {note.text}" for note in notes], EDGE_MM, INNER_MM, 7 * size))
    if left_out:
        where = ", ".join(dict.fromkeys(note.file for note in left_out))
        blocks.append(paper.paragraph(f"{len(left_out)} more in {where}.", EDGE_MM, INNER_MM, 7 * size, bold=True))
    blocks += [nothing(1), paper.paragraph(sheet_text.not_modelled(case), EDGE_MM, INNER_MM, 7.5 * size, bold=True),
               paper.paragraph(sheet_text.made_from(case), EDGE_MM, INNER_MM, 6 * size, colour="#555555")]
    return stacked(blocks)


def _table(paper: Paper, rows: Sequence[Row], points: float) -> Block:
    """The limits; columns in which no motion has anything are left out, and motions have their room."""
    fields: Dict[Column, List[str]] = {
        Column("now"): [turned_text(row.now) for row in rows],
        Column("target"): [sheet_text.degrees_text(row.target["reach_deg"]) if row.target else "" for row in rows],
        Column("planned"): [_planned(row) for row in rows],
        Column("band now"): [f"{row.now.band.p5_deg:.0f}–{row.now.band.p95_deg:.0f}°" if row.now.band else "" for row in rows],
        Column("normal"): [f"{number(row.now.normal_deg)}°" if row.now.normal_deg is not None else "" for row in rows],
        Column("ended by", 3): [_ended_by(row, any(each.now.hour is not None for each in rows)) for row in rows],
        Column("clock"): [clock_text(row.now.hour) if row.now.hour is not None else "" for row in rows],
    }
    kept = {column: texts for column, texts in fields.items() if any(texts)}
    cells = []
    for i, row in enumerate(rows):
        given = [Cell(texts[i] or "–", bold=column.heading == "planned" and row.is_changed) for column, texts in kept.items()]
        cells.append([Cell(str(i + 1)), Cell(marked_name(row.now), bold=row.target is not None), *given])
    return paper.table([Column(""), Column("motion", 4), *kept], cells, EDGE_MM, INNER_MM, points)


def _planned(row: Row) -> str:
    if row.after is None:
        return ""
    band = row.target and row.target["band"]
    return turned_text(row.after) + (f" ({band['p5_deg']:.0f}–{band['p95_deg']:.0f})" if band else "")


def _ended_by(row: Row, at_rim: bool) -> str:
    """With the meshes that meet, if a body has several; where others end at the rim and have an hour, whether this one does not."""
    words = ENDS[row.now.end].words
    if row.now.end not in sheet_text.CONTACTS:
        return words
    return ", ".join([words] + [row.pair] * row.is_of_parts + ["away from the rim"] * (at_rim and row.now.hour is None))


def _targets(paper: Paper, case: Case, points: float) -> Block:
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
    return paper.table(columns, rows, EDGE_MM, INNER_MM, points)
