"""Alpha and centre-edge angles stand at their hours, from a result or from its file."""
import json

import numpy as np
import pytest
from common import refused, run_command
from drawn import of, texts

import condyle
import condyle.plot as figures
from condyle.plot.folder import drawings


@pytest.fixture(scope="module")
def shape(hip: condyle.Joint) -> condyle.HipMeasures:
    return hip.measures(pelvic_tilt_deg=5)


def at(line, x):
    (index,) = np.flatnonzero(np.isclose(line.get_xdata(), x))
    return line.get_ydata()[index]


def test_alpha_stands_at_its_hour_with_12_in_the_middle(shape):
    ax = figures.alpha_by_clock(shape)
    (line,), (at_1mm,) = of(ax, "alpha"), of(ax, "alpha_at_1mm")
    for hour, x in ((0, 0), (1.5, 1.5), (3, 3), (9, -3), (11.5, -0.5), (6, -6), (6, 6)):
        (k,) = np.flatnonzero(np.isclose(shape.neck_hour, hour))
        assert at(line, x) == shape.alpha_deg[k] and at(at_1mm, x) == shape.alpha_at_1mm_deg[k]
    assert (np.diff(line.get_xdata()) > 0).all()
    assert [(dot.get_xdata()[0], dot.get_ydata()[0]) for dot in of(ax, "named")] == [
        (0, shape["alpha_12_deg"].value), (1.5, shape["alpha_1_30_deg"].value), (3, shape["alpha_3_deg"].value)]
    (largest,) = of(ax, "largest")
    assert largest.get_xdata()[0] % 12 == pytest.approx(shape["alpha_largest_hour"].value, abs=1e-12)
    assert largest.get_ydata()[0] == shape["alpha_largest_deg"].value
    (normal,) = of(ax, "normal_range")
    assert (normal.get_y(), normal.get_y() + normal.get_height()) == (30, 66)
    assert "alpha angle (°)" == ax.get_ylabel()
    assert len(ax.texts) == 3 and all(text.get_path_effects() for text in ax.texts), "curves run behind the numbers"


def test_the_rim_stands_at_its_hour_with_its_sections_and_its_frame(shape):
    ax = figures.centre_edge_by_clock(shape)
    (line,) = of(ax, "centre_edge")
    for hour, x in ((0, 0), (3, 3), (9, -3)):
        (k,) = np.flatnonzero(np.isclose(shape.rim_hour, hour))
        assert at(line, x) == shape.centre_edge_deg[k]
    assert [section.get_ydata()[0] for section in of(ax, "section")] == [
        shape[f"centre_edge_{name}_section_deg"].value for name in ("lateral", "anterior", "posterior")]
    for section, hours in zip(of(ax, "section"), ((-1.5, 1.5), (0, 6), (-6, 0))):
        (x,), (y,) = section.get_data()
        assert hours[0] <= x <= hours[1] and abs(at(line, x) - y) < 5, "a step is ten minutes"
    assert texts(ax, "frame") == ["as scanned, tilt 5 deg given"]


def test_where_the_tolerances_differ_is_shaded():
    hours = np.arange(0, 12, 1.0)
    measure = {"value": None, "normal": None}
    keys = ("alpha_12_deg", "alpha_1_30_deg", "alpha_3_deg", "alpha_largest_deg", "alpha_largest_hour")
    doubtful = {"neck_hour": hours, "alpha_deg": np.where(hours == 3, np.nan, 50.0),
                "alpha_at_1mm_deg": np.where((hours >= 4) & (hours <= 5), 40.0, 48.0),
                "measures": dict.fromkeys(keys, measure)}

    def shaded(table):
        return of(figures.alpha_by_clock(table), "doubtful")

    assert [(bar.get_x() + bar.get_width() / 2, bar.get_y(), bar.get_height()) for bar in shaded(doubtful)] == [(4, 40, 10), (5, 40, 10)]
    assert not shaded({**doubtful, "alpha_at_1mm_deg": doubtful["alpha_deg"] - 5})


def test_a_file_draws_what_its_result_draws(shape, hip_file, tmp_path):
    run_command("measure", hip_file, "--tilt", "5", "--out", tmp_path)
    read = figures.files.read_measures(tmp_path)
    for draw, gids in ((figures.alpha_by_clock, ("alpha", "named", "largest")), (figures.centre_edge_by_clock, ("centre_edge", "section"))):
        for gid in gids:
            ours, theirs = (of(draw(each), gid) for each in (shape, read))
            assert len(ours) == len(theirs)
            for a, b in zip(ours, theirs):
                np.testing.assert_array_equal(a.get_ydata(), b.get_ydata())
    ((name, draw),) = drawings(tmp_path)
    assert name == "hip_shape" and len(draw().axes) == 2
    assert figures.hip_shape(read).get_size_inches()[0] == pytest.approx(figures.DOUBLE_COLUMN_MM / 25.4)


def test_what_was_not_found_is_not_drawn(hip_file, tmp_path):
    run_command("measure", hip_file, "--out", tmp_path)
    answer = json.loads((tmp_path / "measures.json").read_text())
    answer["around_neck"] = []
    (tmp_path / "measures.json").write_text(json.dumps(answer))
    read = figures.files.read_measures(tmp_path)
    refused(lambda: figures.alpha_by_clock(read), "no neck")
    assert len(figures.hip_shape(read).axes) == 1
    for wrong in ({"measures": 3}, {"rim": [{"hour": "x"}]}, {"around_neck": None}, {"measures": [{"key": "alpha_3_deg", "value": "x"}]}):
        (tmp_path / "measures.json").write_text(json.dumps({**answer, **wrong}))
        refused(lambda: figures.files.read_measures(tmp_path), "measures.json", figures.ReadError)
