"""How the figures look: widths of journal columns, 8 pt type, colours that stay apart for all eyes."""
from __future__ import annotations

import contextlib
import io
import os
from pathlib import Path
from typing import Any, Dict, Iterator, List, Optional, Sequence, Tuple, Union

import matplotlib
import matplotlib.pyplot as plt
from matplotlib import patheffects as effects
from matplotlib.axes import Axes
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.colors import to_hex, to_rgb
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from .._errors import UsageError

SINGLE_COLUMN_MM = 85.0
"""Width of one column of most journals, mm."""
DOUBLE_COLUMN_MM = 174.0
"""Width of a page of two columns, mm."""
MM_PER_INCH = 25.4

# Okabe and Ito, Color Universal Design, 2008: apart for all common kinds of colour blindness.
BLACK, ORANGE, SKY_BLUE, GREEN = "#000000", "#e69f00", "#56b4e9", "#009e73"
YELLOW, BLUE, VERMILION, PURPLE = "#f0e442", "#0072b2", "#d55e00", "#cc79a7"
GREY, LIGHT_GREY = "#8c8c8c", "#e4e4e4"
CYCLE = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY_BLUE, BLACK)
"""Colours of lines, in this order; yellow is left out: on paper it is not seen."""
SEQUENTIAL = "viridis"
"""Colour map of quantities: even in lightness, so that it also reads in grey."""

PRINT: Dict[str, Any] = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],  # comes with matplotlib: the same figure on every machine
    "font.size": 8,
    "axes.labelsize": 8,
    "axes.titlesize": 8,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "legend.fontsize": 7,
    "legend.frameon": False,
    "legend.handlelength": 1.8,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.prop_cycle": matplotlib.cycler(color=CYCLE),
    "axes.axisbelow": True,
    "grid.color": LIGHT_GREY,
    "grid.linewidth": 0.5,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.major.size": 2.5,
    "ytick.major.size": 2.5,
    "xtick.minor.size": 1.5,
    "ytick.minor.size": 1.5,
    "lines.linewidth": 1.2,
    "lines.markersize": 4.5,
    "hatch.linewidth": 0.5,
    "image.cmap": SEQUENTIAL,
    "pdf.fonttype": 42,  # text stays text, and editors of journals accept it
    "ps.fonttype": 42,
    "svg.fonttype": "path",  # no font is needed to see it as it was drawn
    "svg.hashsalt": "condyle",  # the same bytes for the same figure
}
"""Settings of `print_style`."""

FORMATS = ("pdf", "svg", "png")


@contextlib.contextmanager
def print_style() -> Iterator[None]:
    """Sets the type, lines and colours of these figures for a `with` block.

    Functions that draw use it by themselves where they make the axes. Around your own figure:

        with condyle.plot.print_style():
            figure, (left, right) = plt.subplots(1, 2, figsize=condyle.plot.size_mm(174, 70))
    """
    with matplotlib.rc_context(PRINT):
        yield


def size_mm(width: float, height: float) -> "tuple[float, float]":
    """Width and height in mm as matplotlib's `figsize` in inches."""
    return width / MM_PER_INCH, height / MM_PER_INCH


@contextlib.contextmanager
def drawing(ax: Optional[Axes], width_mm: float, height_mm: float) -> Iterator[Axes]:
    """The axes given, under the settings of their owner; without any, new ones of this size under `print_style`."""
    if ax is not None:
        yield ax
        return
    with print_style():
        figure, made = plt.subplots(figsize=size_mm(width_mm, height_mm), layout="constrained")
        try:
            yield made
        except BaseException:
            plt.close(figure)
            raise


LEGEND_ROW_MM = 3.9
"""Height of a row of a legend below a plot."""


def rows_below(entries: int, columns: int = 2) -> float:
    """Height in mm of a legend with so many entries below a plot."""
    return 1.5 + LEGEND_ROW_MM * -(-entries // columns) if entries else 0.0


def legend_below(ax: Axes, is_ours: bool, handles: Sequence[Any], columns: int = 2) -> None:
    """Says below the plot what marks mean: over the whole width where the figure is ours, else under the axes."""
    if not handles:
        return
    look: Dict[str, Any] = dict(handles=list(handles), ncol=columns, columnspacing=1.4, handletextpad=0.6,
                                borderaxespad=0, fontsize=smaller(1.5))
    if not is_ours:
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), **look)
        return
    figure = ax.figure
    height = figure.get_size_inches()[1] * MM_PER_INCH
    strip = rows_below(len(handles), columns) / height
    figure.get_layout_engine().set(rect=(0, strip, 1, 1 - strip))
    legend = ax.legend(loc="lower center", bbox_to_anchor=(0.5, 0.5 / height), bbox_transform=figure.transFigure,
                       **look)
    legend.set_in_layout(False)


def white_border() -> List[effects.AbstractPathEffect]:
    """Of text that lines run behind."""
    return [effects.withStroke(linewidth=1.8, foreground="white")]


def tidy(ax: Axes, labels: Sequence[Text], marks: Sequence[Sequence[float]] = ()) -> None:
    """Labels of contours upright, with a white border; without those that stand on another one, on marks at these points or across the frame."""
    kept = [Bbox([each, each]).padded(6) for each in ax.transData.transform(marks)] if len(marks) else []
    frame = ax.get_window_extent()
    for label in labels:
        label.set_rotation(0)
        label.set_path_effects(white_border())
        extent = label.get_window_extent(ax.figure.canvas.get_renderer())
        is_inside = frame.x0 < extent.x0 and extent.x1 < frame.x1 and frame.y0 < extent.y0 and extent.y1 < frame.y1
        if is_inside and not any(extent.overlaps(other) for other in kept):
            kept.append(extent)
        else:
            label.set_visible(False)


def tinted(colour: str) -> str:
    """A colour as a ground, on which black lines are seen: half of it is white."""
    return str(to_hex([(1 + part) / 2 for part in to_rgb(colour)]))


def smaller(points: float = 1) -> float:
    """The size of type in points, less some: of what stands inside a plot."""
    return float(matplotlib.rcParams["font.size"]) - points


def rendered(figure: Figure, format: str, dpi: float = 300) -> bytes:
    """The file of a figure: "pdf", "svg" (both vectors) or "png", without a date, so that equal figures are equal.

    `dpi`, dots per inch, is of a png, and of meshes in the others.
    """
    date = {"pdf": "CreationDate", "svg": "Date"}.get(format)
    stream = io.BytesIO()
    with print_style():
        figure.savefig(stream, format=format, dpi=dpi, metadata={date: None} if date else None)
    return stream.getvalue()


def rendered_pages(figures: Sequence[Figure], dpi: float = 300) -> bytes:
    """A PDF with a page of each figure, without a date."""
    stream = io.BytesIO()
    with print_style(), PdfPages(stream, metadata={"CreationDate": None}) as pages:
        for figure in figures:
            pages.savefig(figure, dpi=dpi)
    return stream.getvalue()


def save(drawn: Union[Axes, Figure, Sequence[Figure]], path: Union[str, Path], dpi: float = 300) -> None:
    """Writes the figure of these axes; the ending of the name is the format: .pdf, .svg or .png (`dpi` dots per inch). Several figures are pages
    of one .pdf, or pictures with their numbers from the second on: case.png, case-2.png.

    Raises UsageError for another ending. The file appears whole or not at all.
    """
    path = Path(path)
    format = path.suffix[1:].lower()
    if format not in FORMATS:
        raise UsageError(f"{path}: figures are written as .pdf, .svg or .png")
    if isinstance(drawn, Sequence):
        for name, content in rendered_files(drawn, path, dpi):
            write_whole(name, content)
        return
    figure = drawn if isinstance(drawn, Figure) else drawn.figure
    write_whole(path, rendered(figure, format, dpi))


def rendered_files(pages: Sequence[Figure], path: Path, dpi: float = 300) -> List[Tuple[Path, bytes]]:
    """Files of several figures: a PDF with a page of each, or pictures, from the second on with its number behind the name."""
    if path.suffix.lower() == ".pdf":
        return [(path, rendered_pages(pages, dpi))]
    return [(path.with_stem(f"{path.stem}-{i}") if i > 1 else path, rendered(page, path.suffix[1:].lower(), dpi)) for i, page in enumerate(pages, 1)]


def write_whole(path: Path, content: bytes) -> None:
    """Writes beside the file first, then puts it in its place; a FIFO or a device is written into."""
    path = path.resolve()
    if path.exists() and not path.is_file() and not path.is_dir():
        path.write_bytes(content)
        return
    beside = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        beside.write_bytes(content)
        beside.replace(path)
    finally:
        beside.unlink(missing_ok=True)
