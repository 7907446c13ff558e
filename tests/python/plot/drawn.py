"""What stands on a figure."""

from __future__ import annotations

import itertools
from typing import Any, Iterable

from matplotlib.axes import Axes
from matplotlib.transforms import Bbox


def of(ax: Axes, gid: str) -> list[Any]:
    return [artist for artist in (*ax.lines, *ax.patches, *ax.texts, *ax.collections) if artist.get_gid() == gid]


def texts(ax: Axes, gid: str) -> list[str]:
    return [text.get_text() for text in of(ax, gid)]


def by_gid(ax: Axes) -> dict[str, Any]:
    return {artist.get_gid(): artist for artist in (*ax.lines, *ax.collections, *ax.patches) if artist.get_gid()}


def legend_of(ax: Axes) -> list[str]:
    return [text.get_text() for text in ax.get_legend().get_texts()]


def are_on(page: Bbox, words: Iterable[Any]) -> bool:
    """Whether all that is seen of these texts lies on the paper."""
    return all(are_tidy([(text.get_text(), text.get_window_extent())], page.padded(0.5)) for text in words if text.get_text() and text.get_visible())


def are_apart(boxes: list[Bbox]) -> bool:
    return not any(one.overlaps(other) for one, other in itertools.combinations(boxes, 2))


def are_tidy(found: list[tuple[str, Bbox]], page: Bbox) -> bool:
    """None runs into another or over the edge. Boxes have the lines' height, of which letters with descenders leave a part free."""
    for text, box in found:
        assert page.x0 <= box.x0 and page.y0 <= box.y0 and box.x1 <= page.x1 and box.y1 <= page.y1, text
    for (text, box), (other, over) in itertools.combinations(found, 2):
        across = min(box.x1, over.x1) - max(box.x0, over.x0)
        down = min(box.y1, over.y1) - max(box.y0, over.y0)
        assert across < 0.5 or down < 0.25 * min(box.height, over.height), f"{text!r} and {other!r}"
    return True
