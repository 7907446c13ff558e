"""python3 -m condyle.plot draws a study's folder: limits, measures, outliers and contact sheets."""
import csv
import hashlib
import json
import re
from pathlib import Path

import numpy as np
import pytest
from test_plot_folders import is_refused, run
from test_plot_outliers import among, study_of
from common import refused, run_command

import condyle
import condyle.plot as figures
from condyle import Study
from condyle.plot import __main__ as module
from condyle.plot.outliers import outliers_csv
from condyle.plot.study_folder import figures_of, read


def write(folder: Path, study: Study, **texts: str) -> Path:
    """As the command does, but for study.h5; tables by name as other texts."""
    folder.mkdir(parents=True, exist_ok=True)
    dictionary, record = [["table", "column", "unit", "kind", "meaning"]], {}
    for name in ("limits", "hips", "failures"):
        table = getattr(study, name)
        kinds = {column: "text" if values.dtype.kind == "O" else "number" for column, values in table.items()}
        dictionary += [[name, column, table.units[column], kinds[column], table.meanings[column]] for column in table]
        rows = [["" if each != each else each for each in row] for row in zip(*(values.tolist() for values in table.values()))]
        write_csv(folder / f"{name}.csv", [list(table), *rows])
    write_csv(folder / "columns.csv", dictionary)
    for name, text in texts.items():
        (folder / f"{name}.csv").write_bytes(text.encode())
    for path in folder.glob("*.csv"):
        record[path.name] = {"sha256": hashlib.sha256(path.read_bytes()).hexdigest()}
    (folder / "study.json").write_text(json.dumps({"condyle": "0.1.0", "options": {}, "files": record}))
    return folder


def write_csv(path: Path, rows: "list[list[object]]") -> None:
    with open(path, "w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)


def some(n: int = 3, **hips: "list[object]") -> Study:
    return study_of({"flexion": [50.0 + i for i in range(n)], "fadir": [20.0 + i for i in range(n)]}, **hips)


def test_figures_are_by_texts_and_against_numbers_of_the_table_and_of_measures():
    study = some(9, age_years=[float(i) for i in range(9)], clinic=["a", "b", "$a"] * 3, surgeon=[f"s{i}" for i in range(9)], sex=[1.0] * 9,
                 measured_alpha_3_deg=[50.0] * 9, measured_frame=["joint", "pelvis", "x"] * 3, measured_none_deg=[np.nan] * 9,
                 alpha=[1.0, *[np.nan] * 8], **{"A/b": [1.0, 2.0, *[np.nan] * 7], "a:b": [1.0, 2.0, *[np.nan] * 7]})
    names = [name for name, _ in figures_of(study)]
    assert names == ["limit_distributions", "limits_by_side", "limits_against_age_years", "limits_by_clinic", "limits_against_A_b",
                     "limits_against_a_b_5", "measure_distributions"]
    drawn = {name: draw for name, draw in figures_of(study)}
    panels = drawn["limits_against_age_years"]().axes
    assert [ax.get_ylabel() for ax in panels] == ["Flexion (°)", "FADIR (°)"]
    assert [line.get_xydata().tolist() for line in panels[0].lines] == [[[i, 50.0 + i] for i in range(9)]]
    assert [text.get_text() for text in drawn["limits_by_clinic"]().axes[0].get_legend().get_texts()] == ["clinic $a", "clinic a", "clinic b"]
    assert len(drawn["limits_against_A_b"]().axes[0].lines[0].get_xdata()) == 2


def test_measures_have_a_panel_each_with_their_spread_and_outliers():
    study = some(12, measured_alpha_3_deg=among(11, 100), measured_rim_radius_mm=[*among(10, 11), np.nan])
    (draw,) = [draw for name, draw in figures_of(study) if name == "measure_distributions"]
    panels = draw().axes
    assert [ax.get_xlabel() for ax in panels] == ["alpha 3 (°)", "rim radius (mm)"]
    marks = [{line.get_gid(): line.get_xdata().tolist() for line in ax.lines} for ax in panels]
    assert (marks[0]["median"], marks[0]["outlier"], marks[1]["median"], marks[1]["outlier"]) == ([6.5], [100], [6], [])
    assert [name for name, _ in figures_of(some())] == ["limit_distributions", "limits_by_side"], "a study without measures has no figure of them"


def test_a_folder_has_its_figures_outliers_and_contact_sheet(tmp_path):
    study = some(12, age=among(11, 100))
    folder, out = write(tmp_path / "hips of 2026", study), tmp_path / "out"
    ran = run(folder, "--out", out, "--format", "svg")
    assert (ran.returncode, ran.stderr) == (0, "")
    names = [Path(line).relative_to(out).as_posix() for line in ran.stdout.splitlines()]
    assert names == ["limit_distributions.svg", "limits_by_side.svg", "limits_against_age.svg", "outliers.csv", "contact_sheet.pdf"]
    assert sorted(path.name for path in out.iterdir()) == sorted(names)
    assert (out / "outliers.csv").read_text() == outliers_csv(study) and outliers_csv(study).splitlines()[-1].startswith("a11,age,100.0,6.5,")
    assert len(re.findall(rb"/Type /Page\b", (out / "contact_sheet.pdf").read_bytes())) == 1
    assert sorted(path.suffix for path in folder.iterdir()) == [".csv"] * 4 + [".json"]


def test_a_study_too_large_for_a_contact_sheet_has_the_rest(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "MOST_JOINTS", 2)
    ran = run(write(tmp_path, some()))
    assert (ran.returncode, ran.stderr) == (0, "condyle: note: no contact_sheet.pdf: 3 joints, at most 2 stand on one\n")
    assert "outliers.csv" in ran.stdout and not list(tmp_path.glob("contact_sheet*"))


LIMITS = "id,motion,limit_deg,reason,contact_kind,bearing_contact_deg,caveats\n"
ROW = "a0,flexion,50,contact,impingement,,\n"
BAD = {
    "no_number": ("limits", LIMITS + ROW.replace("50", "x"), "limits.csv: column 'limit_deg': a field is not a number"),
    "no_limit": ("limits", LIMITS + ROW.replace("50", ""), "limits.csv: joint 'a0', motion 'flexion': column 'limit_deg': no number"),
    "a_reason": ("limits", LIMITS + ROW.replace("contact,i", "tired,i"), "motion 'flexion': column 'reason': 'tired' is none of contact, "),
    "another_joint": ("limits", LIMITS + ROW.replace("a0", "b0"), "limits.csv: joint 'b0', motion 'flexion': column 'id': not in hips.csv"),
    "twice": ("limits", LIMITS + ROW + ROW, "limits.csv: joint 'a0', motion 'flexion': column 'motion': twice"),
    "no_rows": ("limits", LIMITS, "limits.csv: no rows"),
    "short_row": ("limits", LIMITS + "a0,flexion\n", "limits.csv: has other columns than columns.csv says"),
    "empty": ("limits", "", "limits.csv: has other columns than columns.csv says"),
    "joint_twice": ("hips", "id,table_row,side\na0,1,left\na0,2,left\n", "hips.csv: column 'id': a joint stands there twice"),
    "dictionary": ("columns", "table,column,unit,kind,meaning\nlimits,id\n", "columns.csv: a column of limits.csv has not 5 fields"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_bad_file_is_one_line_and_3_with_its_column_and_nothing_is_written(tmp_path, name):
    table, text, words = BAD[name]
    ran = run(write(tmp_path / "in", some(), **{table: text}), "--out", tmp_path / "out")
    assert is_refused(ran, 3, words, tmp_path / "in") and not (tmp_path / "out").exists()


def test_columns_that_are_missing_or_of_another_kind_are_named(tmp_path):
    for column, change, words in (("caveats", None, "limits.csv: no column 'caveats'"),
                                  ("motion", np.zeros(6), "limits.csv: column 'motion' is not of texts"),
                                  ("limit_deg", np.array(["1"] * 6, object), "limits.csv: column 'limit_deg' is not of numbers")):
        study = some()
        columns = {name: values for name, values in study.limits.items() if name != column or change is not None}
        object.__setattr__(study.limits, "columns", columns if change is None else {**columns, column: change})
        refused(lambda: read(write(tmp_path, study)), re.escape(words), figures.ReadError)


def test_what_is_no_whole_study_is_refused(tmp_path):
    folder = write(tmp_path / "in", some())
    assert is_refused(run(folder, "--case", "17"), 2, "stand on sheets") and is_refused(run(folder, "--frames", 0), 3, "no frames to draw")
    (folder / "hips.csv").write_text("changed")
    assert run(folder).stderr == f"condyle: {folder / 'hips.csv'}: is not the one that study.json was written with\n"
    (tmp_path / "parted" / "shards").mkdir(parents=True)
    assert run(tmp_path / "parted").stderr == f"condyle: {tmp_path / 'parted'}: has shards only: condyle merge puts them together\n"
    assert not list(tmp_path.rglob("*.pdf"))


def test_what_the_command_writes_is_drawn(tmp_path, coarse_hip_file):
    """The writer is C++: a column that it renames is detected here."""
    rows = "".join(f"{name},{coarse_hip_file},{age},{sex}\n" for name, age, sex in (("b", 30, "f"), ("a", 40, "m")))
    (tmp_path / "hips.csv").write_text(f"id,joint,age,sex\n{rows}c,nothere.toml,50,f\n")
    asked = ["--motion", "flexion,fadir", "--measures", "--band=20"]
    run_command("study", tmp_path / "hips.csv", *asked, "--out", tmp_path / "out")
    study = read(tmp_path / "out")
    assert isinstance(study, condyle.Study)
    assert [name for name, _ in figures_of(study)] == ["limit_distributions", "limits_against_age", "limits_by_sex", "measure_distributions"]
    (measures,) = [draw for name, draw in figures_of(study) if name.startswith("measure")]
    labels = [ax.get_xlabel() for ax in measures().axes]
    assert "alpha 3 (°)" in labels and not any("p5" in label or "hour" in label for label in labels)
    (page,) = figures.contact_sheet(study)
    drawn = [bar.get_width() for ax in page.axes for bar in ax.patches if bar.get_gid() == "limit"]
    assert [ax.get_gid() for ax in page.axes] == ["b", "a"] and drawn == study.limits["limit_deg"].tolist()
    assert any("2 joints, 1 without an answer, 0 with outliers" in text.get_text() for text in page.texts)
