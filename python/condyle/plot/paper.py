"""A4 pages measured in mm from their upper left corners: blocks of text and tables whose heights are known before they are drawn."""
from __future__ import annotations

import functools
from typing import Callable, List, NamedTuple, Sequence

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.patches import Rectangle
from matplotlib.textpath import text_to_path

from . import style

WIDTH_MM, HEIGHT_MM = 210.0, 297.0
MM_PER_POINT = style.MM_PER_INCH / 72
LINE = 1.25
"""Distance of lines over the size of their type."""


class Block(NamedTuple):
    """Something of this height in mm; `draw` takes where its upper edge lies."""

    height: float
    draw: Callable[[float], None]


def nothing(height: float) -> Block:
    """Space between blocks."""
    return Block(height, lambda top: None)


def stacked(blocks: Sequence[Block]) -> Block:
    """Blocks one below the other."""

    def draw(top: float) -> None:
        for block in blocks:
            block.draw(top)
            top += block.height

    return Block(sum(block.height for block in blocks), draw)


@functools.lru_cache(maxsize=20_000)
def _width_of(text: str, bold: bool) -> float:
    """Of type of 1 point, mm."""
    font = FontProperties(family=style.PRINT["font.sans-serif"], weight="bold" if bold else "normal", size=100)
    width, _, _ = text_to_path.get_text_width_height_descent(text, font, ismath=False)
    return float(width) * MM_PER_POINT / 100


def width_mm(text: str, points: float, bold: bool = False) -> float:
    """Of a line of text."""
    return points * _width_of(text, bold)


def _pieces(word: str, width: float, bold: bool) -> List[str]:
    """A word that is wider than a line, broken where it has to be."""
    pieces = [""]
    for letter in word:
        if pieces[-1] and _width_of(pieces[-1] + letter, bold) > width:
            pieces.append("")
        pieces[-1] += letter
    return pieces


def wrapped(text: str, longest_mm: float, points: float, bold: bool = False) -> List[str]:
    """Lines that are no wider than this, as drawn; whatever does not print is a blank."""
    width = longest_mm / points
    printed = "".join(letter if letter.isprintable() else " " for letter in text)
    lines: List[str] = []
    used = 0.0
    for word in printed.split():
        for i, piece in enumerate(_pieces(word, width, bold) if _width_of(word, bold) > width else [word]):
            wide = _width_of(piece, bold)
            if lines and not i and used + _width_of(" ", bold) + wide <= width:
                lines[-1] += " " + piece
                used += _width_of(" ", bold) + wide
            else:
                lines.append(piece)
                used = wide
    return lines


class Column(NamedTuple):
    """A column of a table. Numbers are centred, in a column as wide as they need; texts begin at the left and share what is left by these parts:
    of the spare width if all have room in one line; else the rest, by what they would need."""

    heading: str
    part: int = 0


class Cell(NamedTuple):
    """A field of a table."""

    text: str
    bold: bool = False
    colour: str = style.BLACK


class Paper:
    """Pages as figures; what is drawn stands on the last one."""

    def __init__(self) -> None:
        self.pages: List[Figure] = []
        self.turn()

    def turn(self) -> None:
        """Begins a page."""
        self.figure = plt.figure(figsize=style.size_mm(WIDTH_MM, HEIGHT_MM))
        self.pages.append(self.figure)

    def flow(self, blocks: Sequence[Block], top: float, first: float, last: float) -> float:
        """Draws blocks below each other from `top` on; one that would pass `last` begins a page, at `first`. Returns where they end."""
        for block in blocks:
            if top + block.height > last and top > first:
                self.turn()
                top = first
            block.draw(top)
            top += block.height
        return top

    def line(self, x: float, top: float, text: str, points: float, *, bold: bool = False, colour: str = style.BLACK, centred: bool = False) -> None:
        """One line of text below `top`, to the right of `x` or about it."""
        base = top + points * MM_PER_POINT * (0.5 * LINE + 0.36)  # capitals in the middle of the line
        self.figure.text(x / WIDTH_MM, 1 - base / HEIGHT_MM, text, fontsize=points, fontweight="bold" if bold else "normal", color=colour,
                         ha="center" if centred else "left", va="baseline")

    def first_line(self, x: float, top: float, text: str, width: float, points: float) -> None:
        """A title of this width, with an ellipsis for what has no room."""
        first, *rest = wrapped(text, width - 2 * points * MM_PER_POINT, points, True)
        self.line(x, top, first + "…" * bool(rest), points, bold=True)

    def box(self, x: float, top: float, width: float, height: float, colour: str) -> None:
        """A rectangle without an edge."""
        self.figure.add_artist(Rectangle((x / WIDTH_MM, 1 - (top + height) / HEIGHT_MM), width / WIDTH_MM, height / HEIGHT_MM,
                                         transform=self.figure.transFigure, facecolor=colour, linewidth=0, zorder=-1))

    def axes(self, x: float, top: float, width: float, height: float) -> Axes:
        """Axes of this size."""
        return self.figure.add_axes((x / WIDTH_MM, 1 - (top + height) / HEIGHT_MM, width / WIDTH_MM, height / HEIGHT_MM))

    def _lines(self, lines: Sequence[str], x: float, points: float, bold: bool, colour: str) -> Block:
        each = points * MM_PER_POINT * LINE

        def draw(top: float) -> None:
            for i, line in enumerate(lines):
                self.line(x, top + i * each, line, points, bold=bold, colour=colour)

        return Block(len(lines) * each, draw)

    def paragraph(self, text: str, x: float, width: float, points: float, *, bold: bool = False, colour: str = style.BLACK) -> Block:
        """Text in lines of this width."""
        return self._lines(wrapped(text, width, points, bold), x, points, bold, colour)

    def lines(self, text: str, x: float, width: float, points: float, *, bold: bool = False, colour: str = style.BLACK) -> List[Block]:
        """The same, each line a block: a page may end between them."""
        return [self._lines([line], x, points, bold, colour) for line in wrapped(text, width, points, bold)]

    def ribbon(self, text: str, x: float, width: float, points: float, colour: str) -> Block:
        """White text on a colour."""
        inner = self.paragraph(text, x + 2, width - 4, points, bold=True, colour="white")

        def draw(top: float) -> None:
            self.box(x, top, width, inner.height + 2, colour)
            inner.draw(top + 1)

        return Block(inner.height + 2, draw)

    def table(self, columns: Sequence[Column], rows: Sequence[Sequence[Cell]], x: float, width: float, points: float) -> List[Block]:
        """The headings and each row as blocks, every second row shaded; a row is as high as the longest of its cells asks for."""
        border, each = 1.0, points * MM_PER_POINT * LINE
        all_rows = [[Cell(column.heading, bold=True) for column in columns], *rows]
        # Over numbers the words of a heading may stand below each other.
        words = [[column.heading] if column.part else column.heading.split() or [""] for column in columns]
        needed = [max([width_mm(row[i].text, points, row[i].bold) for row in rows] + [width_mm(word, points, True) for word in words[i]]) + 2 * border + 1e-6
                  for i in range(len(columns))]
        spare = width - sum(needed)
        parts = [float(column.part) for column in columns]
        if spare < 0:
            parts = [min(need, width / 3) if column.part else 0.0 for need, column in zip(needed, columns)]
            needed = [0.0 if column.part else need for need, column in zip(needed, columns)]
            spare = width - sum(needed)
        widths = [need + spare * part / sum(parts) for need, part in zip(needed, parts)]
        lines = [[wrapped(cell.text, wide - 2 * border, points, cell.bold) for cell, wide in zip(row, widths)] for row in all_rows]
        heights = [max(map(len, of_row)) * each + border for of_row in lines]

        def draw(i: int, top: float) -> None:
            if i % 2 == 0:
                self.box(x, top, width, heights[i], "#f4f4f4" if i else style.LIGHT_GREY)
            left = x
            for column, wide, cell, of_cell in zip(columns, widths, all_rows[i], lines[i]):
                for k, line in enumerate(of_cell):
                    self.line(left + border if column.part else left + wide / 2, top + border / 2 + k * each, line, points, bold=cell.bold,
                              colour=cell.colour, centred=not column.part)
                left += wide

        return [Block(height, functools.partial(draw, i)) for i, height in enumerate(heights)]
