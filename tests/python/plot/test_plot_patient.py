"""python3 -m condyle.plot draws a patient's folder: the figures of each side, a sheet of each and one figure of both."""
import json
from pathlib import Path

import pytest
from common import run_command
from test_plot_folders import is_refused, run
from test_plot_sheet import COMMON, motion, plan, rom, said_in, texts_of

from condyle.plot.patient import figures_of, sheets_of

LIMITS = ("flexion", 110.0, 110.0), ("fadir", 20.0, 36.0)
HOURS = {"condyle": 1, **COMMON, "measures": [], "around_neck": [], "rim": []}


def write(path: Path, answer: "dict[str, object]") -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(answer))


def patient(at: Path, *sides: str, planned: bool = True) -> Path:
    for side in sides:
        motions = motion("flexion", 110, normal_range_deg=120), motion("fadir", 20, clock_hour=1.5)
        write(at / side / "limits" / "rom.json", rom(*motions, side=side))
        if planned:
            write(at / side / "plan" / "resection.json", plan(*LIMITS, targets={"fadir": 36}, side=side))
    return at


def written(ran, at: Path) -> "list[str]":
    assert (ran.returncode, ran.stderr) == (0, "")
    names = [Path(line).relative_to(at).as_posix() for line in ran.stdout.splitlines()]
    assert all((at / name).is_file() for name in names)
    return names


def test_both_sides_have_figures_a_sheet_and_a_figure_together(tmp_path):
    at = patient(tmp_path / "patient", "left", "right")
    ran = run(at, "--case", "Case 17", "--date", "2026-11-27", "--note", "cam on CT")
    assert written(ran, at) == [f"{side}/limits/{name}.pdf" for side in ("left", "right") for name in ("limits", "clock_face")] + [
        "both.pdf", "left/sheet.pdf", "right/sheet.pdf"]
    for side in ("left", "right"):
        said = said_in((at / side / "sheet.pdf").read_bytes())
        for words in (f"Case 17 · {side} hip", "2026-11-27", "cam on CT", "NOT DECIDED: 164 mm³ of femur", "After the cut it ends at 36.0°"):
            assert words in said, words


def test_sheets_are_pdf_whatever_the_format_and_go_where_figures_go(tmp_path):
    at, out = patient(tmp_path / "patient", "left", "right"), tmp_path / "drawn"
    names = written(run(at, "--format", "svg", "--out", out), out)
    assert [name for name in names if name.endswith(".svg")][-1] == "both.svg" and names[-2:] == ["left/sheet.pdf", "right/sheet.pdf"]
    assert not list(at.rglob("*.pdf")) + list(at.rglob("*.svg"))
    assert sorted(path.relative_to(out).as_posix() for path in out.rglob("*.*")) == sorted(names)


def test_one_side_has_no_figure_of_both_and_an_unfinished_one_is_left_out(tmp_path):
    at = patient(tmp_path, "right", planned=False)
    for unfinished in ("left/limits", "left/plan", "right/plan", "right/measures"):
        (at / unfinished).mkdir(parents=True)
    assert written(run(at), at) == ["right/limits/limits.pdf", "right/limits/clock_face.pdf", "right/sheet.pdf"]
    assert "NOW: limits of the joint as it is" in said_in((at / "right" / "sheet.pdf").read_bytes())


def test_shapes_are_drawn_where_there_are_some_and_stand_on_the_sheet(tmp_path):
    at = patient(tmp_path, "left")
    file = at / "left" / "measures" / "measures.json"
    write(file, HOURS)
    assert [name for name, _ in figures_of(at)] == ["left/limits/limits", "left/limits/clock_face"]
    (sheet,) = [draw for _, draw in sheets_of(at, {})]
    neck = [{"hour": hour, "alpha_deg": 50.0, "alpha_at_1mm_deg": 45.0, "offset_mm": 8.0} for hour in range(12)]
    write(file, {**HOURS, "around_neck": neck, "notes": [{"code": "n", "text": "only of the shape"}]})
    assert [name for name, _ in figures_of(at)] == ["left/limits/limits", "left/limits/clock_face", "left/measures/hip_shape"]
    assert "Only of the shape" in texts_of(sheet())


@pytest.mark.parametrize("heading", ["--case", "--date", "--note"])
def test_texts_of_sheets_are_refused_for_another_folder(tmp_path, heading):
    write(tmp_path / "rom.json", rom(motion("flexion", 110)))
    ran = run(tmp_path, heading, "17", "--out", tmp_path / "out")
    assert is_refused(ran, 2, "", f"{tmp_path}: --case, --date and --note stand on sheets") and not (tmp_path / "out").exists()
    assert "not a folder" in run(tmp_path / "none", heading, "17").stderr


def test_nothing_is_written_if_anything_is_bad(tmp_path):
    at = patient(tmp_path / "patient", "left", "right")
    good = (at / "right/plan/resection.json").read_text()
    left = (at / "left/limits/rom.json").read_text()
    for name, text, words in (("right/limits/rom.json", "{", "not JSON"), ("right/plan/resection.json", good.replace("110", "95"), "options differ"),
                              ("right/limits/rom.json", left, "of the left side, in the folder of the right one")):
        before = (at / name).read_text()
        (at / name).write_text(text)
        assert is_refused(run(at, "--out", tmp_path / "out"), 3, words, f"{at / name}: ") and not (tmp_path / "out").exists()
        (at / name).write_text(before)
    assert is_refused(run(at, "--frames", 0), 3, "limits: no curves.csv in it") and not list(at.rglob("*.pdf"))


def test_what_the_command_writes_is_drawn(tmp_path, coarse_hip_file):
    """The writers are C++: a key that one of them renames is detected here."""
    text = coarse_hip_file.read_text()
    hip = coarse_hip_file.with_name("left.toml")
    hip.write_text(text.replace('side = "right"', 'side = "left"').replace("sample right", "sample left"))
    for side, joint in (("left", hip), ("right", coarse_hip_file)):
        for name, part, *options in (("rom", "limits", "--band=20"), ("measure", "measures"), ("resect", "plan", "--reach=fadir=48", "--curve=0")):
            run_command(name, joint, *options, "--out", tmp_path / side / part)
    found = figures_of(tmp_path)
    assert [name for name, _ in found] == [f"{side}/{name}" for side in ("left", "right")
                                           for name in ("limits/limit_bands", "limits/clock_face", "measures/hip_shape")] + ["both"]
    (ax,) = found[-1][1]().axes
    answers = [json.loads(path.read_text()) for path in tmp_path.glob("*/limits/rom.json")]
    turned = sorted(each["limit_deg"] for answer in answers for each in answer["motions"])
    assert len(answers) == 2 and sorted(bar.get_width() for bar in ax.patches if bar.get_gid() == "limit") == turned
    for name, draw in sheets_of(tmp_path, {"case": "Case 17"}):
        said = texts_of(draw())
        assert f"Case 17 · {name.split('/')[0]} hip" in said and any(words in said for words in ("After the cut it ", "As it is it ")) and "alpha at 1:30 " in said
