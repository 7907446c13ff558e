"""Each motion has a bar of each side, below each other, and how much further the left side turns in figures."""
import matplotlib.pyplot as plt
import pytest
from common import refused
from drawn import are_tidy, of, texts
from test_plot_limits import BAND, motion

import condyle.plot as figures
from condyle.plot.both_sides import difference_text
from condyle.plot.motion_ends import motion_ends

LEFT = {"scope": "osseous contact of the meshes given; no soft tissue", "normal_range_source": "AAOS 1965", "motions": [
    motion("flexion", 127.25, band=BAND, normal_range_deg=120), motion("fadir", 30.5, bearing_contact_deg=12.0),
    motion("faber", 90.0, "end_of_range", None), motion("only_left", 20.0, kind="cut")]}
RIGHT = {**LEFT, "motions": [
    motion("only_right", 15.0, kind="bearing"), motion("faber", 80.0, caveats=[{"code": "soft_tissue_ends"}]),
    motion("fadir", 35.9), motion("flexion", 102.0, normal_range_deg=120)]}


def middle(bar):
    return bar.get_y() + bar.get_height() / 2


def test_motions_are_matched_by_name_and_the_left_bar_stands_above_the_right_one():
    ax = figures.both_sides(LEFT, RIGHT)
    drawn = sorted(of(ax, "limit"), key=middle)
    assert [bar.get_width() for bar in drawn] == [127.25, 102.0, 30.5, 35.9, 90.0, 80.0, 20.0, 15.0]
    assert [label.get_text() for label in ax.get_yticklabels(minor=True)] == ["left", "right"] * 4
    assert list(ax.get_yticks(minor=True)) == pytest.approx([middle(bar) for bar in drawn])
    assert [label.get_text() for label in ax.get_yticklabels()] == ["Flexion", "FADIR", "FABER †", "Only left", "Only right"]
    pairs = list(zip(drawn[:6:2], drawn[1:6:2]))
    assert list(ax.get_yticks())[:3] == pytest.approx([(middle(left) + middle(right)) / 2 for left, right in pairs])
    top, bottom = (ax.transData.transform((0, middle(bar)))[1] for bar in drawn[:2])
    assert top > bottom


def test_a_motion_that_one_side_lacks_has_one_bar_where_that_side_has_its_bars():
    """The right bar of a motion is as far below its middle wherever there is a left one."""
    ax = figures.both_sides(LEFT, RIGHT)
    drawn = {bar.get_width(): middle(bar) for bar in of(ax, "limit")}
    flexion, _, _, only_left, only_right = ax.get_yticks()
    assert only_left - drawn[20.0] == pytest.approx(flexion - drawn[127.25]) and only_right - drawn[15.0] == pytest.approx(flexion - drawn[102.0])


def test_sides_stay_apart_without_colour():
    ax = figures.both_sides(LEFT, RIGHT)
    white = {bar.get_width(): bar.get_facecolor() == (1, 1, 1, 1) and bar.get_linewidth() > 0 for bar in of(ax, "limit")}
    assert white == {127.25: False, 30.5: False, 90.0: False, 20.0: False, 102.0: True, 35.9: True, 80.0: True, 15.0: True}
    assert {bar.get_edgecolor()[:3] for bar in of(ax, "limit")} >= {bar.get_facecolor()[:3] for bar in of(figures.limits(LEFT), "limit")}


def test_marks_bands_and_values_are_those_of_limits():
    ax = figures.both_sides(LEFT, RIGHT)
    assert {line.get_xdata()[0]: line.get_marker() for line in of(ax, "end")} == {
        127.25: "o", 30.5: "o", 90.0: ">", 20.0: "s", 102.0: "o", 35.9: "o", 80.0: "o", 15.0: "D"}
    assert [line.get_xdata()[0] for line in of(ax, "bearing_contact")] == [12.0]
    (whisker,) = [c for c in ax.containers if hasattr(c, "has_xerr")]
    assert whisker.lines[2][0].get_segments()[0][:, 0] == pytest.approx([120.5, 131.5])
    assert texts(ax, "value") == ["127.2° (120–132)", "102.0°", "30.5°", "35.9°", ">90°", "80.0°", "20.0°", "15.0°"]


def test_a_clinical_range_stands_once_behind_both_and_behind_one_if_the_other_has_none():
    ax = figures.both_sides(LEFT, RIGHT)
    (normal,) = of(ax, "normal_range")
    drawn = of(ax, "limit")[:2]
    assert normal.get_width() == 120 and normal.get_zorder() < drawn[0].get_zorder()
    assert normal.get_y() < drawn[0].get_y() and normal.get_y() + normal.get_height() > drawn[1].get_y() + drawn[1].get_height()
    without = {"motions": [motion("flexion", 127.25)]}
    ax = figures.both_sides(without, {**RIGHT, "motions": RIGHT["motions"][3:]})
    (normal,) = of(ax, "normal_range")
    left, right = of(ax, "limit")
    assert left.get_y() + left.get_height() < normal.get_y() < right.get_y()
    for sides in ((LEFT, RIGHT), (without, RIGHT), (RIGHT, without)):
        assert [text.get_text() for text in figures.both_sides(*sides).get_legend().get_texts()].count("clinical range (AAOS 1965)") == 1


def test_differences_are_of_the_limits_and_bounds_where_a_side_ends_without_contact():
    ax = figures.both_sides(LEFT, RIGHT)
    assert texts(ax, "difference") == ["+25.2°", "−5.4°", ">+10.0°", "–", "–"] and texts(ax, "heading") == ["left − right"]

    def difference(left, right):
        return difference_text(*(motion_ends({"motions": [motion("flexion", *side)]})[0] for side in (left, right)))

    open_end = ("end_of_range", None)
    assert difference((80.0,), (90.0, *open_end)) == "<−10.0°"
    assert difference((90.0, *open_end), (90.0, *open_end)) == "–"
    assert difference((80.0, "contact", "cut"), (70.0,)) == difference((80.0,), (70.0, "contact", "cut")) == "–"
    assert difference((80.04,), (80.0,)) == difference((80.0,), (80.04,)) == "0.0°"
    assert difference((80.06,), (80.0,)) == "+0.1°"
    ends = motion_ends({"motions": [motion("flexion", 8.0, "end_of_range", translation_ends=True), motion("flexion", 5.0)]})
    assert difference_text(*ends) == ">+3.0°" and difference_text(None, ends[0]) == difference_text(ends[0], None) == "–"


def test_the_scope_stands_once_or_for_each_side_if_they_differ():
    assert figures.both_sides(LEFT, RIGHT).get_xlabel().splitlines()[1:] == ["osseous contact of the meshes given"]
    other = figures.both_sides({**LEFT, "scope": "contact of bones and labrum; more"}, RIGHT)
    assert other.get_xlabel().splitlines()[1:] == ["left: contact of bones and labrum", "right: osseous contact of the meshes given"]


def test_own_figures_are_as_wide_as_a_page_and_given_axes_are_drawn_on():
    assert figures.both_sides(LEFT, RIGHT).figure.get_size_inches()[0] * 25.4 == pytest.approx(174)
    figure, (upper, lower) = plt.subplots(2, 1)
    assert figures.both_sides(LEFT, RIGHT, ax=lower) is lower and lower.patches and not upper.patches


def test_words_are_on_the_paper_and_none_stands_on_another():
    one = {"motions": [motion("internal_rotation_at_90_flexion", 127.25, band=BAND)]}
    wide = {"motions": [motion("W" * 200, 120.0, "end_of_range", None, band=BAND), motion("w w" * 60, 20.0, "contact_at_start")]}
    with figures.print_style():
        given = plt.subplots(figsize=(7, 8), layout="constrained")[1]
    for left, right, ax in ((LEFT, RIGHT, None), (one, one, None), (wide, LEFT, None), (LEFT, RIGHT, given)):
        ax = figures.both_sides(left, right, ax=ax)
        ax.figure.canvas.draw()
        ticks = [tick.label1 for tick in ax.xaxis.get_major_ticks() if 0 <= tick.get_loc() <= ax.get_xlim()[1]]
        labels = [*ax.get_yticklabels(), *ax.get_yticklabels(minor=True), *ticks, ax.xaxis.label]
        shown = [text for text in [*ax.texts, *labels, *ax.get_legend().get_texts()] if text.get_text()]
        boxes = [(text.get_text(), text.get_window_extent()) for text in shown]
        columns = {gid: [text.get_window_extent() for text in ax.texts if text.get_gid() == gid] for gid in ("value", "difference", "heading")}
        assert max(box.x1 for box in columns["value"]) < min(box.x0 for box in columns["difference"] + columns["heading"])
        assert are_tidy(boxes, ax.figure.bbox.padded(0.5))


def test_a_side_without_motions_is_refused_and_leaves_no_figure():
    refused(lambda: figures.both_sides(LEFT, {"motions": []}), "no motions", ValueError)
    assert not plt.get_fignums()
