"""Curves, flattened surfaces and agreement show the numbers that they are given."""
from types import SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np
import pytest
from common import refused
from drawn import are_apart, by_gid

import condyle.plot as figures
from condyle.plot.folder import _side_by_side

TABLE = {
    "time_s": [0.0, 1.0, 2.0],
    "flexion_deg": [0.0, 20.0, 40.0],
    "area_mm2": [10.0, np.nan, 30.0],
    "max_depth_mm": [0.5, 0.6, 0.7],
    "mean_depth_mm": [0.1, 0.2, 0.3],
    "force_in_fixed_x_n": [3.0, 0.0, 0.0],
    "force_in_fixed_y_n": [4.0, 0.0, 2.0],
    "force_in_fixed_z_n": [0.0, 7.0, 0.0],
}


def test_a_curve_has_the_columns_and_breaks_at_gaps():
    line = by_gid(figures.curve(TABLE, "area"))["curve:area_mm2"]
    assert line.get_xdata().tolist() == [0, 1, 2]
    assert np.array_equal(line.get_ydata(), [10, np.nan, 30], equal_nan=True)
    depth = by_gid(figures.curve(TABLE, "depth"))
    assert depth["curve:max_depth_mm"].get_ydata().tolist() == [0.5, 0.6, 0.7]
    assert depth["curve:mean_depth_mm"].get_linestyle() != depth["curve:max_depth_mm"].get_linestyle()


def test_force_is_the_length_of_the_vector():
    assert by_gid(figures.curve(TABLE, "force"))["curve:force_n"].get_ydata().tolist() == [5, 7, 2]


def test_axes_have_words_and_units():
    ax = figures.curve(TABLE, "area", along="flexion_deg")
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("flexion (°)", "contact area (mm²)")
    assert figures.curve(TABLE, "force").get_xlabel() == "time (s)"
    assert ax.get_ylim()[0] == 0


def test_a_reference_is_drawn_over_ours_from_its_own_numbers():
    reference = {"time_s": [0.0, 2.0], "area_mm2": [11.0, 31.0]}
    lines = by_gid(figures.curve(TABLE, "area", reference=reference))
    assert lines["reference:area_mm2"].get_xdata().tolist() == [0, 2]
    assert lines["reference:area_mm2"].get_ydata().tolist() == [11, 31]
    assert lines["reference:area_mm2"].get_zorder() > lines["curve:area_mm2"].get_zorder()


def test_quantities_that_are_not_there_are_named():
    refused(lambda: figures.curve(TABLE, "pressure"), "no pressure in this table", ValueError)
    refused(lambda: figures.curve(TABLE, "heat"), "quantity 'heat'", ValueError)


def test_cycles_have_their_mean_and_a_standard_deviation_to_either_side():
    tables = [{"cycle_percent": [0.0, 50.0, 100.0], "area_mm2": values} for values in ([1.0, 2.0, np.nan], [3.0, 2.0, 7.0], [5.0, 2.0, 9.0])]
    ax = figures.cycles(tables, "area")
    assert by_gid(ax)["mean"].get_ydata().tolist() == [3, 2, 8]
    (band,) = [c for c in ax.collections if c.get_gid() == "deviation"]
    at_start = [y for x, y in band.get_paths()[0].vertices if x == 0]
    assert (min(at_start), max(at_start)) == (1, 5)  # 3 -+ 2: the deviation of 1, 3, 5 with n - 1
    refused(lambda: figures.cycles(tables[:1], "area"), "two or more", ValueError)
    refused(lambda: figures.cycles([tables[0], {**tables[1], "cycle_percent": [0.0, 40.0, 100.0]}], "area"), "same cycle_percent", ValueError)


def test_panels_draw_what_there_is():
    figure = figures.panels(TABLE)
    assert [ax.get_ylabel() for ax in figure.axes if ax.axison] == ["contact area (mm²)", "depth (mm)", "contact force (N)"]
    assert figure.get_size_inches()[0] * 25.4 == pytest.approx(174)
    refused(lambda: figures.panels({"time_s": [0.0]}), "no contact", ValueError)


def test_one_quantity_is_as_wide_as_a_column_and_bodies_apart_have_a_gap():
    alone = figures.panels({"time_s": [0.0, 1.0], "area_mm2": [1.0, 2.0]})
    apart = {name: np.zeros(3) for name in TABLE} | {"time_s": TABLE["time_s"], "smallest_gap_mm": [1.0, 0.5, np.nan]}
    for figure, label in ((alone, "contact area (mm²)"), (figures.panels(apart), "smallest gap (mm)"),
                          (figures.panels({"time_s": [0.0], "smallest_gap_mm": [0.0]}), "smallest gap (mm)")):
        assert [ax.get_ylabel() for ax in figure.axes] == [label]
        assert figure.get_size_inches()[0] * 25.4 == pytest.approx(85)
    judged = figures.panels({**apart, "clearance_mm": [5.0, 4.0, 3.0], "to_limit_deg": [30.0, 20.0, 10.0]})
    assert [ax.get_ylabel() for ax in judged.axes] == ["to the nearest limit (°)", "clearance (mm)"]
    touching = figures.panels({**TABLE, "smallest_gap_mm": [0.0, 0.0, 0.0]})
    assert "smallest gap (mm)" not in [ax.get_ylabel() for ax in touching.axes]


def test_answers_of_poses_become_curves():
    """With the names of condyle.ElasticContactResults."""
    totals = SimpleNamespace(area_mm2=10.0, mean_depth_mm=0.1, max_depth_mm=0.3, mean_pressure_mpa=1.0,
                             max_pressure_mpa=2.0, force_n=np.array([0.0, -3.0, 4.0]))
    cast = SimpleNamespace(mobile=SimpleNamespace(totals=totals), fixed=None)
    table = figures.table_of([0.0, 0.5], [cast, None])
    assert table["time_s"].tolist() == [0, 0.5]
    assert np.array_equal(table["max_pressure_mpa"], [2, np.nan], equal_nan=True)
    force = by_gid(figures.curve(table, "force"))["curve:force_n"].get_ydata()
    assert np.array_equal(force, [5, np.nan], equal_nan=True)
    refused(lambda: figures.table_of([0.0], [cast, None]), "1 times for 2 answers", ValueError)


def cap(n=24, radius=20.0, inwards=False):
    """A polar cap of 60 degrees about +Z: vertices, triangles, outwards normals."""
    polar, around = np.meshgrid(np.radians(np.linspace(0, 60, n)), np.linspace(0, 2 * np.pi, 4 * n), indexing="ij")
    points = radius * np.stack((np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar)), axis=-1)
    index = np.arange(n * 4 * n).reshape(n, 4 * n)
    a, b, c, d = index[1:-1, :-1], index[2:, :-1], index[2:, 1:], index[1:-1, 1:]
    triangles = np.concatenate((np.stack((a, b, c), -1).reshape(-1, 3), np.stack((a, c, d), -1).reshape(-1, 3)))
    return points.reshape(-1, 3), triangles[:, ::-1] if inwards else triangles


def test_distances_from_the_pole_are_true_on_the_sphere():
    points, triangles = cap()
    flat = figures.about_centre(points, triangles, np.ones(len(triangles)))
    middle = flat.points_mm[0]  # the vertex at the pole
    polar = np.arccos(np.clip(points[:, 2] / 20.0, -1, 1))
    used = np.unique(triangles)
    radius = float(flat.projection.split("radius ")[1].split(" ")[0])
    # Middles of chords of 2.6 degrees lie within 20 (1 - cos 1.9 deg) inside.
    assert radius == pytest.approx(20, abs=0.1)
    stretch = np.linalg.norm(flat.points_mm[used] - middle, axis=1) / polar[used]
    # The mean direction is the pole up to the uneven halves of the strip that closes the cap: one scale all around.
    assert np.ptp(stretch) < 0.01 * stretch.mean()
    assert flat.facing.all()


def test_sockets_are_seen_from_inside_and_heads_from_outside():
    points, triangles = cap()
    head = figures.about_centre(points, triangles, np.ones(len(triangles)))
    socket = figures.about_centre(points, triangles[:, ::-1], np.ones(len(triangles)))
    assert socket.facing.all()
    assert np.allclose(socket.right, -head.right)
    assert np.allclose(socket.up, head.up)
    # Seen from outside, against +Z, superior up: +X is at the right.
    assert np.allclose(head.right, (1, 0, 0), atol=0.01)


def test_a_flat_surface_keeps_its_shape_and_hides_its_back():
    points = np.array([[0, 0, 0], [4, 0, 0], [0, 3, 0], [0, 0, -1], [4, 0, -1], [0, 3, -1]], dtype=float)
    triangles = np.array([[0, 1, 2], [5, 4, 3]])
    flat = figures.on_plane(points, triangles, np.array([1.0, 0.0]))
    sides = np.linalg.norm(flat.points_mm[triangles[0]] - flat.points_mm[triangles[0][[1, 2, 0]]], axis=1)
    assert np.allclose(sides, (4, 5, 3))
    assert flat.facing.tolist() == [True, False]
    refused(lambda: figures.on_plane(points, triangles, np.ones(2)), "no mean direction", ValueError)


def test_pressure_has_its_colours_and_the_rest_is_grey():
    points, triangles = cap()
    values = np.where(points[triangles[:, 0], 0] > 5, 2.5, 0.0)
    ax = figures.pressure_map(points, triangles, values, projection="sphere", side="right")
    drawn = {c.get_gid(): c for c in ax.collections}
    assert len(drawn["in_contact"].get_paths()) == (values > 0).sum()
    assert (drawn["in_contact"].get_array() == 2.5).all()
    assert drawn["in_contact"].get_clim() == (0, 2.5)
    assert len(drawn["surface"].get_paths()) == (values == 0).sum()
    assert "→ (mm)" in ax.get_xlabel()
    fixed = figures.pressure_map(points, triangles, values, projection="sphere", highest=8)
    assert {c.get_gid(): c for c in fixed.collections}["in_contact"].get_clim() == (0, 8)
    assert tuple(fixed.figure.axes[-1].get_ylim()) == (0, 8)


def test_frames_without_contact_have_no_scale():
    points, triangles = cap()
    for depth, scales in ((0.0, 0), (0.5, 1)):
        surface = figures.files.Surface(points, triangles, {"depth_mm": np.full(len(triangles), depth)})
        assert len(_side_by_side([surface] * 2, surface, "depth_mm", None, "plane").axes) == 2 + scales


@pytest.mark.parametrize("side, word", [("right", "lateral"), ("left", "medial")])
def test_the_right_of_the_body_is_lateral_on_the_right(side, word):
    points = np.array([[0, 0, 0], [0, 0, 4], [4, 0, 0]], dtype=float)  # faces up, +Y; +X up on paper, +Z at the right
    ax = figures.pressure_map(points, [[0, 1, 2]], [1.0], side=side)
    assert (ax.get_xlabel(), ax.get_ylabel()) == (f"{word} → (mm)", "anterior → (mm)")


def test_wrong_shapes_of_surfaces_are_refused():
    points, triangles = cap()
    refused(lambda: figures.pressure_map(points, triangles, [1.0]), "numbers for", ValueError)
    refused(lambda: figures.pressure_map(points, triangles, np.ones(len(triangles)), projection="cube"), "projection 'cube'", ValueError)


def test_agreement_has_bias_and_limits():
    ours, theirs = np.array([1.0, 2.0, 3.0, np.nan]), np.array([0.0, 2.0, 1.0, 5.0])
    ax = figures.agreement(ours, theirs, unit="mm")
    lines = by_gid(ax)
    # Differences 1, 0, 2: mean 1, deviation 1.
    assert lines["bias"].get_ydata()[0] == 1
    assert lines["upper"].get_ydata()[0] == pytest.approx(1 + 1.96)
    assert lines["lower"].get_ydata()[0] == pytest.approx(1 - 1.96)
    assert lines["pairs"].get_xdata().tolist() == [0.5, 2, 2]
    refused(lambda: figures.agreement([1.0], [1.0], unit="mm"), "two or more", ValueError)
    refused(lambda: figures.agreement([1.0, 2.0], [1.0], unit="mm"), "2 values of one method and 1", ValueError)


def test_many_methods_are_named_apart_and_zeros_have_a_row_of_their_own():
    series = [figures.Series(f"method {i}", "abc"[i % 3], [1.0, 10.0], [0.01 * (1 + 0.01 * i), 0.1]) for i in range(20)]
    series.append(figures.Series("exact", "d", [1.0, 10.0], [0.0, 0.0]))
    ax = figures.many_methods(series, x_label="ms", y_label="wrong", zero_label="none")
    assert (ax.get_xscale(), ax.get_yscale()) == ("log", "log")
    lines = by_gid(ax)
    assert lines["series:method 3"].get_ydata()[1] == 0.1
    assert (np.array(lines["series:exact"].get_ydata()) < 0.01).all()
    ax.figure.canvas.draw()
    renderer = ax.figure.canvas.get_renderer()
    names = [t for t in ax.texts if t.get_text().startswith(("method", "exact"))]
    extents = [plt.Text.get_window_extent(t, renderer) for t in names]
    assert len(names) == 21
    assert are_apart(extents)
    assert max(extent.x1 for extent in extents) <= ax.figure.bbox.x1 + 0.5
