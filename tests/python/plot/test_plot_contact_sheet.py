"""A contact sheet has all joints of a study, their limits where the numbers are, and marks outliers."""
import re
import sys

import matplotlib.pyplot as plt
import numpy as np
import pytest
from common import refused
from drawn import of
from matplotlib.figure import Figure
from test_plot_outliers import among, study_of

import condyle.plot as figures
from condyle.plot.limit_bars import ENDS

module = sys.modules["condyle.plot.contact_sheet"]  # its function has the same name


def texts_of(page):
    return [text.get_text() for text in page.texts]


@pytest.fixture(scope="module")
def twelve():
    """Flexion and age have an outlier, of the last joint and of the first; every other FABER ends without contact."""
    reasons = {"faber": ["end_of_range", "contact"] * 6}
    return study_of({"flexion": among(11, 100), "faber": [60.0 + i for i in range(12)]}, reasons, measured_alpha_3_deg=[-50.0, *among(10, 11)])


@pytest.fixture(scope="module")
def page(twelve):
    (page,) = figures.contact_sheet(twelve, name="Study 7")
    return page


def test_bars_are_the_limits_with_the_marks_of_their_ends_and_the_median_of_all(page, twelve):
    assert [ax.get_gid() for ax in page.axes] == twelve.hips["id"].tolist()
    for i, ax in enumerate(page.axes):
        assert [bar.get_width() for bar in of(ax, "limit")] == twelve.limits["limit_deg"][2 * i:2 * i + 2].tolist()
        marks = {mark.get_marker(): mark.get_xydata().tolist() for mark in of(ax, "end")}
        end = "impingement" if i % 2 else "end_of_range"
        assert marks[ENDS[end].marker][-1] == [60.0 + i, 1]
        (median,) = of(ax, "median")
        assert [segment[0][0] for segment in median.get_segments()] == [6.5, 65.5]
        assert ax.get_xlim() == page.axes[0].get_xlim(), "bars compare"
    assert [label.get_text() for label in page.axes[0].get_yticklabels()] == ["Flexion", "FABER"] and not page.axes[1].get_yticklabels()


def test_outliers_have_an_asterisk_at_their_bar_or_below_their_name(page):
    marked = [(ax.get_gid(), mark.get_text(), mark.get_position()[1]) for ax in page.axes for mark in of(ax, "outlier")]
    assert marked == [("a11", "* +21", 0)]  # (100 - 6.5) / (3 * 1.4826)
    said = texts_of(page)
    assert [text for text in said if text.endswith(" *")] == ["a0 *", "a11 *"]
    assert "alpha 3 −12" in said  # (-50 - 5.5) / (3 * 1.4826)
    assert "Study 7 · 12 joints, 0 without an answer, 2 with outliers · page 1 of 1" in said


def test_a_bearing_contact_has_its_diamond_and_a_motion_that_a_joint_lacks_no_bar():
    study = study_of({"flexion": [50.0, 60.0], "fadir": [30.0, 40.0]})
    kept = np.array([True, True, True, False])  # a1 has no FADIR
    limits = {name: values[kept] for name, values in study.limits.items()}
    limits["bearing_contact_deg"] = np.array([45.0, np.nan, np.nan])
    limits["caveats"] = np.array(["soft_tissue_ends", "", ""], object)
    object.__setattr__(study.limits, "columns", limits)
    (page,) = figures.contact_sheet(study)
    assert [[mark.get_xydata().tolist() for mark in of(ax, "bearing_contact")] for ax in page.axes[:1]] == [[[[45.0, 0.0]]]]
    assert [len(of(ax, "limit")) for ax in page.axes] == [2, 1]
    legend = [text.get_text() for text in page.legends[0].get_texts()]
    assert "bearing contact" in legend and "median of all joints" in legend
    assert page.axes[0].get_yticklabels()[0].get_text() == "Flexion †" and any("soft tissue" in text for text in legend)
    assert page.axes[0].get_ylim() == page.axes[1].get_ylim(), "rows stay in line"


def test_columns_that_were_not_searched_are_named():
    (page,) = figures.contact_sheet(study_of({"flexion": among(11, 12), "faber": [120.0] * 12}))
    assert "Not searched for outliers, see outliers.csv: FABER." in texts_of(page)


def test_joints_go_on_on_the_next_page_and_texts_stay_on_it(monkeypatch):
    monkeypatch.setattr(module, "ACROSS", 2)
    monkeypatch.setattr(module, "DOWN", 2)
    ids = [f"a long name of a hip, with $ and \x1b in it, {i:03}" for i in range(10)]
    study = study_of({"flexion": among(9, 100)}, id=ids, **{f"column_{i}": among(9, 100 + i) for i in range(9)})
    pages = figures.contact_sheet(study)
    assert [len(page.axes) for page in pages] == [4, 4, 2] and not plt.get_fignums()
    assert [ax.get_gid() for page in pages for ax in page.axes] == ids
    assert (module.EDGE_MM + module.NAMES_MM + 4 * module.WIDE_MM, module.TOP_MM + 6 * module.HIGH_MM + module.BOTTOM_MM) == (200, 297)
    pages[-1].draw_without_rendering()
    for page in pages[-1:]:
        for text in page.texts:
            extent = text.get_window_extent()
            assert extent.x0 >= 0 and extent.x1 <= page.bbox.x1, text.get_text()
    (last,) = [text for text in texts_of(pages[-1]) if text.endswith("more")]
    assert re.fullmatch(r"column \d \+\d\d, .* \d more", last)


def test_more_joints_than_anybody_looks_through_are_refused(monkeypatch):
    monkeypatch.setattr(module, "MOST_JOINTS", 3)
    refused(lambda: figures.contact_sheet(study_of({"flexion": [1.0] * 4})), "4 joints: at most 3 stand on contact sheets", ValueError)


def test_pages_are_one_pdf_and_the_same_bytes_again(tmp_path):
    page = Figure(figsize=(2, 2))
    page.text(0.5, 0.5, "page")
    for name in ("a.pdf", "b.pdf"):
        figures.save([page, page], tmp_path / name)
    content = (tmp_path / "a.pdf").read_bytes()
    assert content == (tmp_path / "b.pdf").read_bytes() and len(re.findall(rb"/Type /Page\b", content)) == 2
    figures.save([page, page], tmp_path / "c.png")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.pdf", "b.pdf", "c-2.png", "c.png"]
    assert all((tmp_path / name).read_bytes().startswith(b"\x89PNG") for name in ("c.png", "c-2.png"))
    refused(lambda: figures.save([page], tmp_path / "c.gif"), "c.gif: figures are written as .pdf, .svg or .png", ValueError)
