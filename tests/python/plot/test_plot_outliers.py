"""Outliers of a study are those that the median and the median absolute deviation say."""
import csv

import numpy as np
import pytest

import condyle.plot as figures
from condyle import Study
from condyle._csv_text import csv_field, plain_field
from condyle._study import StudyTable
from condyle.plot.outliers import FEW, SAME, not_searched, outliers_csv


def table_of(columns: "dict[str, object]", units: "dict[str, str]", meanings: "dict[str, str]") -> StudyTable:
    arrays = {name: np.array(values, object if any(isinstance(each, str) for each in values) else float) for name, values in columns.items()}
    return StudyTable(arrays, {name: units.get(name, "") for name in columns}, {name: meanings.get(name, "") for name in columns})


def study_of(limits: "dict[str, list[float]]", reasons: "dict[str, list[str]] | None" = None, **hips: "list[object]") -> Study:
    """Limits by motions and columns of hips, each a value per joint; joints are called a0, a1 and so on unless hips have an id."""
    n = len(next(iter(limits.values())))
    sides = ["left", "right"] * (n // 2) + ["left"] * (n % 2)
    columns = {"id": [f"a{i}" for i in range(n)], "table_row": list(range(1, n + 1)), "side": sides, **hips}
    ended = {name: (reasons or {}).get(name, ["contact"] * n) for name in limits}
    by_joint = [(joint, name, limits[name][i], ended[name][i]) for i, joint in enumerate(columns["id"]) for name in limits]
    keys = ("id", "motion", "limit_deg", "reason")
    rows = {key: [row[k] for row in by_joint] for k, key in enumerate(keys)}
    rows.update(contact_kind=["impingement" if reason == "contact" else "" for reason in rows["reason"]],
                bearing_contact_deg=[np.nan] * len(by_joint), caveats=[""] * len(by_joint))
    units = {name: unit for name in hips for unit, end in (("deg", "_deg"), ("mm", "_mm"), ("h", "_hour")) if name.endswith(end)}
    meanings = {name: "from the table" for name in hips if not name.startswith("measured_")}
    return Study(table_of(rows, {"limit_deg": "deg"}, {}), table_of(columns, units, meanings), table_of({"id": []}, {}, {}), {})


def among(n: int, value: float) -> "list[float]":
    """1 to n and a value at the end: without it the median is (n + 1) / 2."""
    return [float(i) for i in range(1, n + 1)] + [value]


def test_a_value_is_an_outlier_just_beyond_three_and_a_half_robust_deviations():
    """Of 0 to 10 and a far value the median is 5.5; deviations are 0.5 twice, ..., 5.5 and that of the value: their median is 3."""
    edge = 5.5 + 3.5 * 1.4826 * 3
    values = [[float(i) for i in range(11)] + [value] for value in (edge - 1e-6, edge + 1e-6)]
    assert figures.outliers(study_of({"flexion": values[0]})) == []
    (found,) = figures.outliers(study_of({"flexion": values[1]}))
    assert found[:2] == ("a11", "flexion_limit_deg") and (found.value, found.median) == (values[1][-1], 5.5)
    assert found.deviations == pytest.approx(3.5, abs=1e-6) and found.deviations > 3.5


def test_values_below_the_median_are_outliers_too_and_have_negative_deviations():
    (found,) = figures.outliers(study_of({"fadir": [50.0] * 12}, age=[-each for each in among(11, 100)]))
    assert (found.joint, found.column, found.value, found.median) == ("a11", "age", -100, -6.5)
    assert found.deviations == pytest.approx((-100 + 6.5) / (1.4826 * 3))


def test_a_column_whose_deviation_is_0_or_rounding_has_no_outliers_and_is_named():
    more_than_half = [5.0] * 7 + [1.0, 2.0, 3.0, 8.0, 1000.0]
    noise = [1e-13 * i for i in range(11)] + [1e-7]
    study = study_of({"faber": more_than_half, "flexion": among(11, 500)}, measured_head_rms_mm=noise, sex=[0.0] * 11 + [1.0])
    assert not_searched(study) == {name: SAME for name in ("measured_head_rms_mm", "sex", "faber_limit_deg")}
    assert [each.column for each in figures.outliers(study)] == ["flexion_limit_deg"]
    half = study_of({"faber": [5.0] * 6 + [1.0, 2.0, 3.0, 7.0, 8.0, 1000.0]})  # deviations are 0 six times, then 2: their median is 1
    assert [each.deviations for each in figures.outliers(half)] == [pytest.approx(995 / 1.4826)]


def test_fewer_than_ten_joints_have_no_outliers_nor_has_a_column_with_fewer_values():
    assert figures.outliers(study_of({"flexion": among(8, 1000)})) == []
    assert [each.joint for each in figures.outliers(study_of({"flexion": among(9, 1000)}))] == ["a9"]
    study = study_of({"flexion": among(11, 12)}, age=[*among(8, 1000), np.nan, np.nan, np.nan])
    assert figures.outliers(study) == [] and not_searched(study) == {"age": FEW}
    study = study_of({"flexion": among(11, 12)}, age=[*among(9, 1000), np.nan, np.nan])
    assert [each.joint for each in figures.outliers(study)] == ["a9"], "empty fields are no values"


def test_row_numbers_hours_texts_and_ends_of_bands_are_not_searched():
    far, n = among(11, 1000), 12
    study = study_of({"flexion": [1.0 * i for i in range(n)]}, measured_alpha_3_deg=far, measured_alpha_3_deg_p5=far, measured_alpha_3_deg_p95=far,
                     measured_largest_hour=far, weight_p5=far, group=["x"] * n, table_row=far)
    assert [each.column for each in figures.outliers(study)] == ["measured_alpha_3_deg", "weight_p5"]


def test_a_limit_whose_name_the_table_has_is_another_column():
    study = study_of({"flexion": among(11, 1000)}, flexion_limit_deg=among(11, 12))
    assert [each.column for each in figures.outliers(study)] == ["study_flexion_limit_deg"]


def test_the_table_has_joints_in_their_order_numbers_to_the_last_bit_and_no_formulas():
    names = ["=1+1", 'a,"b"', *(f"j{i}" for i in range(8)), "-5", "#x"]
    study = study_of({"flexion": [0.1, 1000 / 3, *among(9, 1000)], "faber": [7.0] * 12}, id=names, age=among(11, 1000))
    lines = outliers_csv(study).split("\n")
    assert lines[0] == f"# not searched, {SAME}: faber_limit_deg" and lines[-1] == "" and lines[2].startswith("\"a,")
    assert lines[1] == "joint,column,value,median,deviations"
    rows = [[plain_field(field) for field in row] for row in csv.reader(lines[2:-1])]
    assert [tuple(row[:2]) for row in rows] == [('a,"b"', "flexion_limit_deg"), ("#x", "age"), ("#x", "flexion_limit_deg")]
    assert [tuple(map(float, row[2:])) for row in rows] == [tuple(each[2:]) for each in figures.outliers(study)]
    study = study_of({"flexion": [1000.0, *among(10, 5)]}, id=["=1+1", *names[2:], "x"])
    assert outliers_csv(study).splitlines()[-1].startswith('"\'=1+1",flexion')


@pytest.mark.parametrize("text", ["plain", "=1+1", "'=1", "-5", "-5e3", "-x", "+", "@a", "a\x1b[2J", "\\u001b", "\\", 'a"b', "a,b", "#a", "\u2028",
                                  ""])
def test_a_field_is_read_as_it_was_written(text):
    field = csv_field(text)
    assert plain_field(next(csv.reader([f"{field},"]))[0]) == text
    assert field.isprintable() and field[:1] not in "=@" or not field
    assert (field == text) == (text in ("plain", "-5", "-5e3", "+", "\\", "")), "quoted only where it must be"
