"""Spreads of limits over a cohort stand where the numbers are."""
import numpy as np
import pytest
from common import refused
from drawn import legend_of, of

import condyle
import condyle.plot as figures
from condyle.plot.cohort import running_band


@pytest.fixture()
def table():
    """Of 101 joints: flexion 100 to 200 degrees, FADIR half of it; every fifth FADIR reaches the end of the range."""
    n = 101
    flexion = np.arange(100.0, 201.0)
    return {
        "motion": np.array(["flexion"] * n + ["fadir"] * n),
        "limit_deg": np.concatenate([flexion, flexion / 2]),
        "reason": np.array(["contact"] * n + ["end_of_range" if i % 5 == 0 else "contact" for i in range(n)]),
        "sex": np.array(["f" if i % 2 else "m" for i in range(n)] * 2),
        "alpha_deg": np.tile(np.linspace(40, 80, n), 2),
    }


def test_bands_are_percentiles_of_each_motion(table):
    ax = figures.limit_distributions(table)
    assert [line.get_xdata().tolist() for line in of(ax, "band")] == [[105, 195], [52.5, 97.5]]
    assert [line.get_xdata().tolist() for line in of(ax, "median")] == [[150], [75]]
    boxes = of(ax, "quartiles")
    assert [(box.get_x(), box.get_width()) for box in boxes] == [(125, 50), (62.5, 25)]
    assert len(of(ax, "without_contact")) == 1
    assert [label.get_text() for label in ax.get_yticklabels()] == ["Flexion", "FADIR"]


def test_groups_stand_below_each_other_in_the_order_of_their_values(table):
    ax = figures.limit_distributions(table, by="sex", motions=["flexion"])
    medians = of(ax, "median")
    assert [line.get_xdata()[0] for line in medians] == [150, 150]
    assert medians[0].get_ydata()[0] < 0 < medians[1].get_ydata()[0]
    assert legend_of(ax) == ["sex f", "sex m"]


def test_an_arrow_for_what_ended_without_contact_stands_beside_the_median_and_is_explained():
    """It lay on the mark of a median at the end of the range, and both were cut off at the end of the axis."""
    table = {"motion": ["faber"] * 2, "limit_deg": [120.0, 120.0], "reason": ["end_of_range", "end_of_range"], "alpha_deg": [50.0, 60.0]}
    ax = figures.limit_distributions(table)
    (arrow,), (median,) = of(ax, "without_contact"), of(ax, "median")
    places = [line.get_transform().transform(line.get_xydata())[0] for line in (arrow, median)]
    assert places[0][0] - places[1][0] == pytest.approx(4.5 * ax.figure.dpi / 72) and not (arrow.get_clip_on() or median.get_clip_on())
    assert legend_of(ax) == ["some: no contact in the range"]
    assert figures.limit_against(table, "alpha_deg", "faber").get_xlabel() == "alpha (°)"


def test_a_point_stands_for_each_joint(table):
    ax = figures.limit_against(table, "alpha_deg", "fadir", label="alpha angle (°)")
    (contact,), (free,) = of(ax, "limits"), of(ax, "without_contact")
    assert len(contact.get_xdata()) == 80 and len(free.get_xdata()) == 21
    assert (free.get_ydata()[0], free.get_xdata()[0]) == (50, 40)
    (median,) = of(ax, "median")
    # The limit goes with the measure in a line, and so does the median of equal parts.
    np.testing.assert_allclose(median.get_ydata(), 50 + (median.get_xdata() - 40) / 40 * 50)
    assert ax.get_xlabel() == "alpha angle (°)" and ax.get_ylabel() == "FADIR (°)"


def test_a_running_band_has_parts_of_equally_many():
    x = np.arange(40.0)
    np.testing.assert_allclose(running_band(x[::-1], x[::-1], 2), [[9.5, 0.95, 9.5, 18.05], [29.5, 20.95, 29.5, 38.05]])


def test_what_is_not_there_is_named(table):
    for column in ("nothere", "sex"):
        refused(lambda: figures.limit_against(table, column, "flexion"), f"'{column}'", ValueError)
    refused(lambda: figures.limit_distributions(table, motions=["faber"]), "no motion 'faber'", ValueError)
    refused(lambda: figures.limit_against(table, "alpha_deg", "faber"), "no motion 'faber'", ValueError)
    refused(lambda: figures.limit_distributions(table, by="alpha_deg"), "101 values: at most 7 groups", ValueError)


def test_a_dataframe_will_do(table):
    pandas = pytest.importorskip("pandas")
    ax = figures.limit_distributions(pandas.DataFrame(table), by="sex")
    assert len(of(ax, "band")) == 4


def test_limits_of_a_study_go_against_what_was_measured(hip_file, tmp_path):
    table = tmp_path / "hips.csv"
    table.write_text(f"id,joint,pelvic_tilt_deg\nb,{hip_file},0\na,{hip_file},10\n", encoding="utf-8")
    study = condyle.run_study(table, tmp_path / "out", motions=["flexion", "extension"], measures=True)
    (points,) = of(figures.limit_against(study, "measured_acetabular_version_deg", "flexion"), "limits")
    assert points.get_xdata().tolist() == study.hips["measured_acetabular_version_deg"].tolist()
    assert points.get_xdata()[0] > points.get_xdata()[1] + 3, "forward tilt retroverts"
    assert points.get_ydata().tolist() == study.limits["limit_deg"][::2].tolist()
    assert of(figures.limit_distributions(study, by="measured_frame"), "median")
