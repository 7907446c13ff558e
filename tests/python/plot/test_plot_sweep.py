"""Zones of sweeps stand where their designs are, from a result or from its files."""
import numpy as np
import pytest
from common import refused
from drawn import are_apart, by_gid

import condyle
import condyle.plot as figures
from condyle.plot.__main__ import main
from condyle.plot.folder import drawings

pytestmark = pytest.mark.filterwarnings("ignore::condyle.JointRemark")
TARGETS = [("sitting", "flexion", 110), ("pivoting", "external_rotation", 40)]


@pytest.fixture(scope="module")
def implant():
    return condyle.sample_replacement(bones="none", facets=120).joint


@pytest.fixture(scope="module")
def zone(implant):
    return implant.sweep({"cup.inclination": (30, 50, 5), "cup.anteversion": (-20, 45, 5)}, TARGETS, band_samples=20)


def test_the_border_is_that_of_the_safe_intervals_by_the_target_that_ends_it(zone):
    ax = figures.safe_zone(zone)
    drawn = by_gid(ax)
    lower = np.concatenate(drawn["ended by sitting"].get_segments())
    upper = np.concatenate(drawn["ended by pivoting"].get_segments())
    for interval in zone.safe_intervals:
        at = interval.values["cup.inclination"]
        assert interval.low_target == "sitting" and interval.high_target == "pivoting"
        assert interval.low in lower[lower[:, 0] == at, 1] and interval.high in upper[upper[:, 0] == at, 1]
    assert drawn["here"].get_xydata().tolist() == [[40, 15]]
    assert drawn["best"].get_xydata().tolist() == [list(zone.best.values.values())]
    assert ax.get_xlabel() == "Cup inclination (°)" and ax.get_ylabel() == "Cup anteversion (°)"


def test_the_border_ends_where_the_zone_leaves_what_was_swept(zone):
    """Half way to a line whose safe values go on beyond the window it lay off the zone."""
    cut = figures.safe_zone.__globals__["zone_of"](zone)
    window = slice(5, None)
    first = cut.axes[1][5]
    cut = cut._replace(axes=(cut.axes[0], cut.axes[1][window]), margin_deg=cut.margin_deg[:, window], probability=None, intervals=[
        (values, max(low, first), high, low_target if low > first else None, high_target)
        for values, low, high, low_target, high_target in cut.intervals])
    assert len({low_target for _, _, _, low_target, _ in cut.intervals}) == 2, "otherwise nothing would be tested"
    segments = np.concatenate(by_gid(figures.safe_zone(cut))["ended by sitting"].get_segments())
    at_edge = segments[segments[:, 1] == first]
    assert len(at_edge) == 1
    assert np.interp(at_edge[0, 0], cut.axes[0], cut.margin_deg[:, 0]) == pytest.approx(0, abs=1e-9)


def test_labels_of_contours_stand_whole_in_the_frame_and_beside_the_marks(zone):
    ax = figures.safe_zone(zone, quantity="probability")
    frame, marks = ax.get_window_extent(), ax.transData.transform([zone.best.values["cup.inclination"], zone.best.values["cup.anteversion"]])
    extents = [text.get_window_extent() for text in ax.texts if text.get_visible()]
    assert extents and all(frame.x0 < each.x0 and each.x1 < frame.x1 and frame.y0 < each.y0 and each.y1 < frame.y1 for each in extents)
    assert not any(each.contains(*marks) for each in extents)
    assert are_apart(extents)


def test_a_folder_is_drawn_as_its_result(zone, tmp_path):
    zone.write(tmp_path)
    assert [name for name, _ in drawings(tmp_path)] == ["safe_zone", "safe_probability"]
    read = figures.safe_zone(figures.files.read_sweep(tmp_path))
    for name, artist in by_gid(figures.safe_zone(zone)).items():
        if name.startswith("ended by"):
            assert np.array_equal(np.array(artist.get_segments()), np.array(by_gid(read)[name].get_segments()))
    assert main([str(tmp_path), "--format", "png", "--out", str(tmp_path / "figures")]) == 0
    assert (tmp_path / "figures/safe_zone.png").stat().st_size > 10_000


def test_one_parameter_is_curves_of_what_is_left(implant):
    line = implant.sweep({"cup.anteversion": (-20, 45, 5)}, TARGETS)
    drawn = by_gid(figures.margins_along(line))
    for t, (name, _, reach) in enumerate(TARGETS):
        assert np.array_equal(drawn[name].get_ydata(), line.limits_deg[:, t] - reach, equal_nan=True)
    (interval,) = line.safe_intervals
    shaded = drawn["safe"].get_extents().transformed(drawn["safe"].axes.transData.inverted())
    assert (shaded.x0, shaded.x1) == pytest.approx((interval.low, interval.high))
    refused(lambda: figures.safe_zone(line), "margins_along")


def test_three_parameters_are_small_multiples(implant):
    cube = implant.sweep({"stem.version": (0, 30, 15), "cup.inclination": (30, 50, 10), "cup.anteversion": (-20, 45, 5)}, TARGETS)
    figure = figures.safe_zones(cube)
    shown = [ax for ax in figure.axes if ax.get_visible()]
    assert [ax.get_title() for ax in shown] == ["stem version 0", "stem version 15", "stem version 30"]
    assert "here" in by_gid(shown[1]) and "here" not in by_gid(shown[0])
    refused(lambda: figures.safe_zone(cube), "safe_zones")


def test_what_cannot_be_drawn_is_said(zone, implant, tmp_path):
    refused(lambda: figures.safe_zone(zone, quantity="depth"), "margin and probability")
    bare = implant.sweep({"cup.inclination": (40, 50, 10), "cup.anteversion": (10, 20, 10)}, TARGETS)
    refused(lambda: figures.safe_zone(bare, quantity="probability"), "without a band")
    zone.write(tmp_path)
    rows = (tmp_path / "designs.csv").read_text().splitlines()
    (tmp_path / "designs.csv").write_text("\n".join(rows[:-1]) + "\n")
    refused(lambda: drawings(tmp_path), "designs.csv: 69 designs, not 70", figures.ReadError)
    (tmp_path / "sweep.json").write_text('{"condyle": 1}')
    refused(lambda: drawings(tmp_path), "not what condyle sweep writes", figures.ReadError)
