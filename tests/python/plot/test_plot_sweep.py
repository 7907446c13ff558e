"""Zones of sweeps stand where their designs are, from a result or from its files."""
import matplotlib.pyplot as plt
import numpy as np
import pytest

import condyle
import condyle.plot as figures
from condyle.plot.__main__ import main
from condyle.plot.folder import drawings

pytestmark = pytest.mark.filterwarnings("ignore::condyle.JointRemark")
TARGETS = [("sitting", "flexion", 110), ("pivoting", "external_rotation", 40)]


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def implant():
    return condyle.sample_replacement(bones="none", facets=120).joint


@pytest.fixture(scope="module")
def zone(implant):
    return implant.sweep({"cup.inclination": (30, 50, 5), "cup.anteversion": (-20, 45, 5)}, TARGETS, band_samples=20)


def by_gid(ax):
    return {artist.get_gid(): artist for artist in (*ax.lines, *ax.collections, *ax.patches) if artist.get_gid()}


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
    with pytest.raises(condyle.UsageError, match="margins_along"):
        figures.safe_zone(line)


def test_three_parameters_are_small_multiples(implant):
    cube = implant.sweep({"stem.version": (0, 30, 15), "cup.inclination": (30, 50, 10), "cup.anteversion": (-20, 45, 5)}, TARGETS)
    figure = figures.safe_zones(cube)
    shown = [ax for ax in figure.axes if ax.get_visible()]
    assert [ax.get_title() for ax in shown] == ["stem version 0", "stem version 15", "stem version 30"]
    assert "here" in by_gid(shown[1]) and "here" not in by_gid(shown[0])
    with pytest.raises(condyle.UsageError, match="safe_zones"):
        figures.safe_zone(cube)


def test_what_cannot_be_drawn_is_said(zone, implant, tmp_path):
    with pytest.raises(condyle.UsageError, match="margin and probability"):
        figures.safe_zone(zone, quantity="depth")
    bare = implant.sweep({"cup.inclination": (40, 50, 10), "cup.anteversion": (10, 20, 10)}, TARGETS)
    with pytest.raises(condyle.UsageError, match="without a band"):
        figures.safe_zone(bare, quantity="probability")
    zone.write(tmp_path)
    rows = (tmp_path / "designs.csv").read_text().splitlines()
    (tmp_path / "designs.csv").write_text("\n".join(rows[:-1]) + "\n")
    with pytest.raises(figures.ReadError, match="designs.csv: 69 designs, not 70"):
        drawings(tmp_path)
    (tmp_path / "sweep.json").write_text('{"condyle": 1}')
    with pytest.raises(figures.ReadError, match="not what condyle sweep writes"):
        drawings(tmp_path)
