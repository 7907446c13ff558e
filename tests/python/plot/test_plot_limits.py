"""Bars, whiskers, marks and places on the clock stand where the numbers are."""
import math
from types import SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np
import pytest
from common import refused
from drawn import are_apart, are_on, legend_of, of, texts

import condyle.plot as figures
from condyle.plot.rim_clock import clock_text, names_fit, spread_apart


def motion(name, limit, reason="contact", kind="impingement", **more):
    return {"name": name, "limit_deg": limit, "reason": reason, "contact_kind": kind, "bearing_contact_deg": None,
            "band": None, "normal_range_deg": None, "clock_hour": None, **more}


BAND = {"p5_deg": 120.5, "median_deg": 126.0, "p95_deg": 131.5}
RESULT = {
    "normal_range_source": "AAOS 1965",
    "motions": [
        motion("flexion", 127.25, band=BAND, normal_range_deg=120, clock_hour=1.5),
        motion("internal_rotation_at_90_flexion", 30.5, bearing_contact_deg=12.0, clock_hour=3.0),
        motion("faber", 90.0, "end_of_range", None),
        motion("adduction", 0.0, "contact_at_start", "unknown"),
        motion("extension", 20.0, kind="bearing", clock_hour=7.5),
    ],
}


def test_bars_are_as_long_as_the_limits_from_the_top():
    ax = figures.limits(RESULT)
    drawn = of(ax, "limit")
    assert [bar.get_width() for bar in drawn] == [127.25, 30.5, 90.0, 0.0, 20.0]
    assert [bar.get_x() for bar in drawn] == [0] * 5
    heights = [ax.transData.transform((0, bar.get_y()))[1] for bar in drawn]
    assert heights == sorted(heights, reverse=True)
    assert [label.get_text() for label in ax.get_yticklabels()][:2] == ["Flexion", "Internal rotation\nat 90° flexion"]
    assert "(°)" in ax.get_xlabel()


def test_clinical_ranges_stand_behind_where_a_source_has_one():
    ax = figures.limits(RESULT)
    (normal,) = of(ax, "normal_range")
    assert normal.get_width() == 120
    assert normal.get_zorder() < of(ax, "limit")[0].get_zorder()
    assert "AAOS 1965" in "".join(text.get_text() for text in ax.get_legend().get_texts())
    assert not of(figures.limits(RESULT, normal_ranges=False), "normal_range")


def test_fadir_and_faber_are_said_to_be_as_defined_here():
    def said(*names):
        ax = figures.limits({"motions": [motion(name, 20.0) for name in names]})
        return legend_of(ax)

    assert "FADIR, FABER: as defined here" in said("flexion", "faber")
    assert "FADIR, FABER: as defined here" not in said("flexion")


def test_a_dagger_marks_what_soft_tissue_usually_ends_and_the_scope_stands_below():
    caveats = [{"code": "soft_tissue_ends", "text": "It does.", "source": "someone"}]
    ax = figures.limits({"motions": [motion("extension", 72.8, caveats=caveats), motion("flexion", 120.0)],
                         "scope": "osseous contact of the meshes given; soft tissue is not modelled"})
    assert [label.get_text() for label in ax.get_yticklabels()] == ["Extension †", "Flexion"]
    assert "† soft tissue usually ends it first" in legend_of(ax)
    assert ax.get_xlabel().splitlines()[1] == "osseous contact of the meshes given"
    without = figures.limits({"motions": [motion("flexion", 120.0)]})
    assert "†" not in "".join(text.get_text() for text in without.get_legend().get_texts())
    assert len(without.get_xlabel().splitlines()) == 1


def test_whiskers_reach_from_5_to_95_percent_with_the_median_between():
    ax = figures.limits(RESULT)
    (whisker,) = [c for c in ax.containers if hasattr(c, "has_xerr")]
    (segment,) = whisker.lines[2][0].get_segments()
    assert segment[:, 0] == pytest.approx([120.5, 131.5], abs=1e-12)
    assert whisker.lines[0].get_xdata() == [126.0]
    assert texts(ax, "value")[0] == "127.2° (120–132)"
    assert figures.limits({"motions": [motion("flexion", 119.0, band=BAND)]}).get_xlim() == (0, 150), "the axis reaches beyond the band, too"
    without = figures.limits(RESULT, bands=False)
    assert not [c for c in without.containers if hasattr(c, "has_xerr")]
    assert texts(without, "value")[0] == "127.2°"


def test_a_band_that_the_range_cuts_off_is_open_and_quoted_as_the_command_does():
    def ended(p95, share, reason="end_of_range", **more):
        band = {"p5_deg": 88.0, "median_deg": 110.0, "p95_deg": p95, "share_without_contact": share}
        return motion("faber", 120.0 if reason == "end_of_range" else 110.0, reason, band=band, range_deg=120.0, **more)

    def drawn(*motions):
        ax = figures.limits({"motions": motions})
        said = legend_of(ax)
        opened = [line.get_xdata()[0] for line in of(ax, "open_band")]
        assert ("band beyond the range" in said) == bool(opened)
        return texts(ax, "value"), opened

    assert drawn(ended(119.99, 0.88)) == ([">120° (88–120)"], [119.99])
    assert drawn(ended(119.99, 0.06, "contact")) == (["110.0° (88–120)"], [119.99])
    assert drawn(ended(119.0, 0.05), ended(120.0, 0.05), ended(118.0, 0.5)) == ([">120° (88–119)", ">120° (88–120)", ">120° (88–118)"], [])
    said = ended(120.0, 0.88)
    said["band"]["text"] = "88–>120"
    assert drawn(said) == ([">120° (88–>120)"], [120.0])
    beyond = {**BAND, "p5_deg": 119.9, "median_deg": 120.0, "p95_deg": 120.0, "share_without_contact": 1.0}
    ax = figures.limits({"motions": [motion("faber", 120.0, "end_of_range", band=beyond, range_deg=120.0)]})
    assert texts(ax, "value") == [">120°"] and not ax.containers[1:], "as a whole beyond: no whisker"
    followed = motion("flexion", 8.0, "end_of_range", translation_ends=True)
    ax = figures.limits({"motions": [followed]})
    assert texts(ax, "value") == ["8.0°"] and "no contact, translation ends" in legend_of(ax)


def test_what_ended_a_motion_has_a_shape_of_its_own():
    ax = figures.limits(RESULT)
    ends = of(ax, "end")
    assert [line.get_xdata()[0] for line in ends] == [127.25, 30.5, 90.0, 0.0, 20.0]
    assert [line.get_marker() for line in ends] == ["o", "o", ">", "X", "D"]
    (bearing,) = of(ax, "bearing_contact")
    assert (bearing.get_xdata()[0], bearing.get_marker()) == (12.0, "D")
    assert texts(ax, "value")[2:4] == [">90°", "0.0°"]


def test_attributes_do_as_well_as_keys():
    def as_object(value):
        if isinstance(value, dict):
            return SimpleNamespace(**{key: as_object(inner) for key, inner in value.items()})
        return [as_object(inner) for inner in value] if isinstance(value, list) else value

    by_keys, by_attributes = figures.limits(RESULT), figures.limits(as_object(RESULT))
    assert [b.get_width() for b in by_keys.patches] == [b.get_width() for b in by_attributes.patches]


def test_given_axes_are_drawn_on_and_returned():
    figure, (left, right) = plt.subplots(1, 2)
    size = figure.get_size_inches().copy()
    assert figures.limits(RESULT, ax=right) is right
    assert not left.patches and right.patches
    assert (figure.get_size_inches() == size).all()
    assert len(plt.get_fignums()) == 1


def test_own_figures_are_as_wide_as_a_column_in_8_point_without_a_heading():
    ax = figures.limits(RESULT)
    assert ax.figure.get_size_inches()[0] * 25.4 == pytest.approx(85)
    assert ax.xaxis.label.get_size() == 8
    assert ax.get_title() == "" and ax.figure._suptitle is None


def test_nothing_to_draw_is_said_and_leaves_no_figure():
    refused(lambda: figures.limits({"motions": []}), "no motions", ValueError)
    assert not plt.get_fignums()


def test_all_words_are_on_the_paper():
    scoped = {**RESULT, "scope": "contact of the bones, cartilages and labrum given; other tissue is not modelled"}
    scoped["motions"] = [{**each, "caveats": [{"code": "soft_tissue_ends"}]} for each in RESULT["motions"]]
    for ax in (draw(result) for result in (RESULT, scoped) for draw in (figures.limits, figures.clock_face)):
        ax.figure.canvas.draw()
        of_axes = [*ax.get_yticklabels(), ax.xaxis.label] if ax.axison else []
        assert are_on(ax.figure.bbox, [*ax.texts, *of_axes, *(ax.get_legend().get_texts() if ax.get_legend() else [])])


def test_labels_of_many_contacts_get_smaller_and_do_not_overlap():
    many = {"motions": [motion(f"motion_{i}", 30.0, clock_hour=i / 4) for i in range(24)]}
    for names in ({}, {"motion_0": "A"}):
        ax = figures.clock_face(many, names=names)
        labels = sorted((text for text in ax.texts if text.get_gid() == "place"), key=lambda text: text.get_position()[1])
        assert len(labels) == 24 and labels[0].get_fontsize() == pytest.approx(6.5 * 16 / 24)
        boxes = [text.get_window_extent() for text in labels]
        assert all(lower.y1 <= upper.y0 + 0.5 for lower, upper in zip(boxes, boxes[1:]))
        assert labels[-1].get_text() == ("12:00 A" if names else "12:00 Motion 0")
    assert not names_fit(many) and names_fit(RESULT)


def test_the_clock_has_twelve_on_top_and_three_at_the_right():
    ax = figures.clock_face(RESULT)
    at = [(line.get_xdata()[0], line.get_ydata()[0]) for line in of(ax, "end")]
    half = math.sqrt(0.5)
    assert np.allclose(at, [(half, half), (1, 0), (-half, -half)], atol=1e-15)
    assert [line.get_marker() for line in of(ax, "end")] == ["o", "o", "D"]
    assert sorted(text.split("\n")[0].split(" ")[0] for text in texts(ax, "place")) == ["1:30", "3:00", "7:30"]
    assert not of(figures.clock_face({"motions": [motion("flexion", 1.0)]}), "end")


def test_labels_of_the_clock_do_not_overlap():
    crowded = {"motions": [motion(f"internal_rotation_{i}", 10.0, clock_hour=1 + 0.01 * i) for i in range(7)]}
    ax = figures.clock_face(crowded)
    ax.figure.canvas.draw()
    extents = [text.get_window_extent() for text in of(ax, "place")]
    assert len(extents) == 7 and are_apart(extents)


def test_the_plane_of_the_rim_has_the_notch_at_six():
    def words(result):
        return {text.get_text() for text in figures.clock_face(result).texts}

    assert {"superior", "inferior"} <= words(RESULT) and "notch" not in words(RESULT)
    in_rim = words({**RESULT, "clock_plane": "rim"})
    assert "notch" in in_rim and not {"superior", "inferior"} & in_rim


def test_names_of_any_length_stay_on_the_paper():
    long = {"motions": [motion("W" * 200, 30.0, clock_hour=2.0), motion("w w" * 60, 20.0, clock_hour=9.0)]}
    for ax in (figures.limits(long), figures.clock_face(long)):
        ax.figure.canvas.draw()
        assert are_on(ax.figure.bbox, [*ax.texts, *(ax.get_yticklabels() if ax.axison else [])])


def test_hours_are_named_as_a_clock_names_them():
    assert [clock_text(hour) for hour in (0, 1.5, 11.999, 9.1)] == ["12:00", "1:30", "12:00", "9:06"]


def test_spread_heights_keep_order_gap_and_bounds_and_none_are_nearer():
    random = np.random.default_rng(4)
    for _ in range(200):
        wanted = np.sort(random.integers(0, 100, random.integers(1, 8))).astype(float)
        gaps = random.integers(5, 14, len(wanted) - 1).astype(float).tolist()
        heights = np.array(spread_apart(wanted.tolist(), gaps, 0, 100))
        rounding = 1e-9

        def allowed(h):
            is_inside = (h >= -rounding).all() and (h <= 100 + rounding).all()
            return is_inside and (np.diff(h) >= np.array(gaps) - rounding).all()

        assert allowed(heights)
        cost = ((heights - wanted) ** 2).sum()
        # The problem is convex: what no shift of a run of neighbours betters is best of all.
        for first in range(len(wanted)):
            for last in range(first, len(wanted)):
                for shift in (-1.0, -0.01, 0.01, 1.0):
                    other = heights.copy()
                    other[first : last + 1] += shift
                    assert not allowed(other) or ((other - wanted) ** 2).sum() >= cost - rounding


def test_gaps_shrink_where_there_is_no_room():
    assert np.allclose(spread_apart([50.0] * 11, [20.0] * 10, 0, 100), np.arange(0, 101, 10))
    assert spread_apart([], [], 0, 1) == []


def test_live_results_are_drawn_as_files_are():
    """With the names of condyle.RangeOfMotion."""

    def limit(name, turned, reason, kind=None):
        return SimpleNamespace(name=name, limit_deg=turned, reason=reason, bearing_contact_deg=None, contact_kind=kind)

    live = SimpleNamespace(limits=(limit("flexion", 100.0, "contact", "impingement"), limit("faber", 90.0, "end_of_range")))
    bands = [SimpleNamespace(p5_deg=95.0, median_deg=100.0, p95_deg=104.0), SimpleNamespace(p5_deg=90.0, median_deg=90.0, p95_deg=90.0)]
    ax = figures.limits(live, bands=bands, normal_ranges={"flexion": 120})
    assert [bar.get_width() for bar in of(ax, "limit")] == [100, 90]
    assert [bar.get_width() for bar in of(ax, "normal_range")] == [120]
    assert texts(ax, "value") == ["100.0° (95–104)", ">90°"]
    refused(lambda: figures.limits(live, bands=bands[:1]), "1 bands for 2 motions", ValueError)
