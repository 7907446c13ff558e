"""Maps have the colours, contours and hatchings of their numbers."""
from types import SimpleNamespace

import numpy as np
import pytest
from common import refused
from drawn import legend_of, of

import condyle.plot as figures
from condyle.plot.map_contours import quantity_of, values_of


def plane(rows=4, columns=5, **changes):
    """Upper ends 10 degrees a column and 20 a row, from 30 on; the start at 5."""
    upper = 35.0 + 10 * np.arange(columns)[None, :] + 20 * np.arange(rows)[:, None]
    none = np.zeros((rows, columns), dtype=bool)
    grid = figures.MotionGrid(("flexion", "extension"), ("adduction", "abduction"), ("internal_rotation", "external_rotation"),
                              10.0 * np.arange(columns), 5.0 * np.arange(rows) - 10, 5.0, upper - 70, upper, none, none.copy(), ~none,
                              np.ones((rows, columns), dtype=np.int64))
    return grid._replace(**changes)


def put(values, value, *places):
    """A copy with a value in some cells."""
    changed = values.copy()
    for place in places:
        changed[place] = value
    return changed


def hatched(ax):
    """Gids of hatchings, with the boxes of their cells in data."""
    return {c.get_gid(): [p.get_extents().bounds for p in c.get_paths()] for c in ax.collections if c.get_hatch()}


def test_views_count_from_the_start():
    grid = plane()
    assert values_of(grid, "positive")[0, 0] == 30
    assert values_of(grid, "negative")[0, 0] == 5 - (35 - 70)
    assert (values_of(grid, "free_range") == 70).all()
    assert [quantity_of(grid, view) for view in ("positive", "negative", "free_range")] == [
        "limit of internal rotation", "limit of external rotation", "free range of internal and external rotation"]
    refused(lambda: values_of(grid, "up"), "view 'up'", ValueError)


def test_contours_are_labelled_with_their_levels_and_lie_on_the_plane():
    ax = figures.motion_map(plane())
    levels = set(range(30, 131, 10))  # values run from 30 to 130
    lines = [c for c in ax.collections if len(c.get_edgecolor()) and not c.get_hatch() and not len(c.get_facecolor())]
    drawn = set()
    for at in (path.vertices for c in lines for path in c.get_paths() if len(path.vertices)):
        # The upper end less the start on the plane: linear, so that interpolation is exact to rounding.
        values = 30 + at[:, 0] + 4 * (at[:, 1] + 10)
        assert np.ptp(values) < 1e-9
        drawn.add(round(float(values[0]), 9))
    assert levels - {30, 130} <= drawn <= levels  # a corner of the map is no line
    labels = {int(text.get_text()) for text in ax.texts}
    assert labels and labels <= levels


def test_the_scale_holds_all_values_and_can_be_given():
    bar = figures.motion_map(plane()).figure.axes[-1]
    assert tuple(bar.get_ylim()) == (30, 130)
    assert bar.get_ylabel() == "limit of internal rotation (°)"
    given = figures.motion_map(plane(), levels=[0, 100, 200])
    bar = given.figure.axes[-1]
    assert tuple(bar.get_ylim()) == (0, 200)


def test_cells_that_are_not_free_are_marked_by_what_they_are():
    grid = plane()
    is_open = put(grid.upper_open, True, (2, slice(1, 3)))
    ax = figures.motion_map(grid._replace(
        intervals=put(put(grid.intervals, 0, (0, 0)), 2, (3, 4)), upper_deg=put(grid.upper_deg, np.nan, (0, 0)),
        free_at_start=put(grid.free_at_start, False, (1, 2), (0, 0)), upper_open=is_open))
    cells = hatched(ax)
    assert cells == {
        "nowhere": [(0, -10, 5, 2.5)],  # half a cell each way at the corner
        "not_at_start": [(15, -7.5, 10, 5)],
        "islands": [(35, 2.5, 5, 2.5)],
        "open": [(5, -2.5, 20, 5)],  # neighbours in a row at once
    }
    words = {text.get_text() for text in ax.get_legend().get_texts()}
    assert words == {"free nowhere", "not free at the start", "free again beyond contact", "no contact in the range"}
    # The negative side ends in contact everywhere.
    assert "open" not in hatched(figures.motion_map(grid._replace(upper_open=is_open), "negative"))


def test_a_map_without_marks_has_no_legend():
    ax = figures.motion_map(plane())
    assert hatched(ax) == {} and ax.get_legend() is None


def test_points_that_are_free_nowhere_have_no_colour():
    grid = plane()
    ax = figures.motion_map(grid._replace(upper_deg=put(grid.upper_deg, np.nan, (0, 0)), intervals=put(grid.intervals, 0, (0, 0))))
    fills = [p for c in ax.collections if len(c.get_facecolor()) and not c.get_hatch() for p in c.get_paths()]
    assert not any(p.contains_point((0.5, -9.9)) for p in fills)  # beyond the diagonal of the corner's cell
    assert any(p.contains_point((9.0, -5.5)) for p in fills)


def test_axes_name_the_opposite_movement_only_where_they_have_it():
    ax = figures.motion_map(plane())
    assert ax.get_xlabel() == "flexion (°)"
    assert ax.get_ylabel() == "adduction (+) / abduction (−) (°)"
    assert (ax.get_xlim(), ax.get_ylim()) == ((0, 40), (-10, 5))


def test_one_row_is_a_curve_with_its_points():
    grid = plane(rows=1)
    ax = figures.motion_map(grid._replace(upper_open=put(grid.upper_open, True, (0, 4))))
    assert [line.get_ydata().tolist() for line in of(ax, "limit")] == [[30, 40, 50, 60, 70]]
    assert [line.get_xdata().tolist() for line in of(ax, "open")] == [[40]]
    assert ax.get_xlabel() == "flexion (°)"
    across = figures.motion_map(plane(columns=1))
    assert across.lines[0].get_xdata().tolist() == [-10, -5, 0, 5]


def test_a_map_that_is_free_nowhere_is_refused():
    grid = plane()
    refused(lambda: figures.motion_map(grid._replace(upper_deg=np.full((4, 5), np.nan))), "no point of the map is free", ValueError)
    refused(lambda: figures.motion_map({"motions": []}), "no map", ValueError)


def test_live_maps_are_drawn_as_files_are():
    """With the names of condyle.MotionMap."""
    grid = plane(rows=2, columns=3)
    live = SimpleNamespace(
        column="flexion", row="adduction", vary="internal_rotation", column_deg=grid.columns_deg, row_deg=grid.rows_deg,
        start_deg=5.0, lower_deg=grid.lower_deg, upper_deg=grid.upper_deg,
        free_at_start=np.array([[True, True, False], [True, True, True]]), offset=np.array([0, 1, 2, 3, 5, 6, 7]),
        ligaments=("front", "back"), negative=SimpleNamespace(reason=np.zeros((2, 3), np.int8), ligament=np.full((2, 3), -1)),
        positive=SimpleNamespace(reason=np.array([[0, 1, 2], [3, 0, 3]], np.int8), ligament=np.array([[-1, -1, -1], [1, -1, 0]])))
    ax = figures.motion_map(live)
    said = ax.get_ylabel()
    assert said == "adduction (+) / abduction (−) (°)" or said.startswith("adduction (°, negative")
    assert {name: len(cells) for name, cells in hatched(ax).items()} == {"not_at_start": 1, "islands": 1, "open": 1}
    of_ends = {name: len(cells) for name, cells in coloured(figures.map_ends(live)).items()}
    assert of_ends == {"ligament front": 1, "ligament back": 1, "contact": 3, "end_of_range": 1}
    # What ends the motion there may be a ligament.
    assert "free again beyond that end" in {text.get_text() for text in ax.get_legend().get_texts()}


def coloured(ax):
    """Gids of what ends the motion, with the boxes of their cells in data."""
    kinds = ("ligament ", "contact", "end_of_range")
    return {c.get_gid(): [p.get_extents().bounds for p in c.get_paths()] for c in ax.collections if (c.get_gid() or "").startswith(kinds)}


def ended_by(names):
    """A map whose upper ends are made by these; "" by contact."""
    return plane()._replace(upper_ligament=np.array(names), lower_ligament=np.full((4, 5), ""))


NAMES = [["back"] * 5, ["back", "front", "front", "", ""], [""] * 5, ["", "", "", "", "front"]]


def test_what_ends_a_motion_has_a_colour_each_and_a_name():
    grid = ended_by(NAMES)
    ax = figures.map_ends(grid)
    cells = coloured(ax)
    assert list(cells) == ["ligament back", "ligament front", "contact"]
    # Cells reach half way to the neighbours, and neighbours in a row are one.
    assert cells["ligament back"] == [(0, -10, 40, 2.5), (0, -7.5, 5, 5)]
    assert cells["ligament front"] == [(5, -7.5, 20, 5), (35, 2.5, 5, 2.5)]
    area = sum(width * height for boxes in cells.values() for *_, width, height in boxes)
    assert area == pytest.approx(40 * 15)
    assert legend_of(ax) == ["back", "front", "contact"]
    faces = [tuple(patch.get_facecolor()) for patch in ax.get_legend().get_patches()]
    assert len(set(faces)) == 3
    by_gid = {c.get_gid(): tuple(c.get_facecolor()[0]) for c in ax.collections if c.get_gid() in cells}
    assert faces == [by_gid[gid] for gid in cells]
    assert "what ends internal rotation" in " ".join(text.get_text() for text in ax.texts).replace("\n", " ")
    assert list(coloured(figures.map_ends(grid, "negative"))) == ["contact"]


def test_a_ligament_has_one_colour_on_both_sides():
    grid = ended_by(NAMES)._replace(lower_ligament=np.array([["front"] * 5] * 3 + [["back", "", "", "", ""]]))
    looks = [{patch.get_label(): patch.get_facecolor() for patch in figures.map_ends(grid, side).get_legend().get_patches()}
             for side in ("positive", "negative")]
    assert looks[0]["front"] == looks[1]["front"] != looks[0]["back"] == looks[1]["back"]


def test_many_ligaments_stay_apart_by_hatches():
    names = np.array([f"band {i:02}" for i in range(20)]).reshape(4, 5)
    legend = figures.map_ends(ended_by(names)).get_legend()
    looks = {(tuple(patch.get_facecolor()), patch.get_hatch()) for patch in legend.get_patches()}
    assert len(looks) == 20 and [text.get_text() for text in legend.get_texts()] == sorted(names.ravel())


def test_ends_are_of_points_that_are_free():
    grid = ended_by([["", "back", "back", "back", "back"]] + NAMES[1:])
    ax = figures.map_ends(grid._replace(upper_deg=put(grid.upper_deg, np.nan, (0, 0)), intervals=put(grid.intervals, 0, (0, 0))))
    assert set(hatched(ax)) == {"nowhere"}
    assert sum(width * height for boxes in coloured(ax).values() for *_, width, height in boxes) == pytest.approx(40 * 15 - 5 * 2.5)


def test_what_has_no_ends_to_draw_is_refused():
    grid = ended_by(NAMES)
    refused(lambda: figures.map_ends(grid, "up"), "'up'", ValueError)
    refused(lambda: figures.map_ends(grid._replace(upper_deg=np.full((4, 5), np.nan))), "no point of the map is free", ValueError)
    refused(lambda: figures.map_ends(plane(rows=1)), "no area", ValueError)


def test_translations_are_in_millimetres():
    """As condyle.MotionMap and rom.json have them."""
    grid = plane()._replace(row=("x", "negative_x"), varied=("y", "negative_y"), units=("deg", "mm", "mm"), upper_deg=plane().upper_deg / 100)
    ax = figures.motion_map(grid)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("flexion (°)", "x (mm)")
    bar = ax.figure.axes[-1]
    assert bar.get_ylabel() == "limit of y (mm)"
    assert len(bar.get_yticks()) > 3, "steps below a millimetre"
    assert figures.motion_map(grid._replace(), "negative").figure.axes[-1].get_ylabel() == "limit of negative y (mm)"
