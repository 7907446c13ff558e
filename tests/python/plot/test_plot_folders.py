"""python3 -m condyle.plot draws what the command wrote, and says in one line what it cannot read."""
import contextlib
import io
import json
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from common import refused, run_command

import condyle.plot as figures
from condyle.plot.__main__ import main
from condyle.plot.folder import drawings

MAP = {"vary": "internal_rotation", "vary_opposite": "external_rotation", "start_deg": 0,
       "columns": {"angle": "flexion", "opposite": "extension", "first_deg": 0, "last_deg": 20, "step_deg": 10, "count": 3},
       "rows": {"angle": "adduction", "opposite": "abduction", "first_deg": -5, "last_deg": 5, "step_deg": 10, "count": 2}}
INTERVALS = """\
# a comment
flexion_deg,adduction_deg,internal_rotation_low_deg,internal_rotation_high_deg,holds_start,low_reason,high_reason
0,-5,-30,40,1,contact,contact
10,-5,-90,90,1,end_of_range,end_of_range
20,-5,-30,-10,0,contact,contact
20,-5,3,8,0,contact,contact
0,5,-30,20,1,contact,contact
0,5,50,60,0,contact,contact
10,5,-30,20,1,contact,contact
"""


def rom_folder(folder: Path, **changes: object) -> Path:
    folder.mkdir(exist_ok=True)
    motion = {"name": "flexion", "limit_deg": 100.0, "reason": "contact", "contact_kind": "impingement", "clock_hour": 2.0}
    (folder / "rom.json").write_text(json.dumps({"condyle": 1, "motions": [motion], **changes}))
    return folder


def map_folder(folder: Path) -> Path:
    rom_folder(folder, map=MAP)
    (folder / "map_intervals.csv").write_text(INTERVALS)
    return folder


def motion_folder(folder: Path) -> Path:
    folder.mkdir(exist_ok=True)
    (folder / "curves.csv").write_text("time_s,area_mm2,max_depth_mm,mean_depth_mm\n0,1,2,1\n1,,,\n2,3,4,2\n")
    return folder


def run(*arguments: object) -> SimpleNamespace:
    out, error = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(error):
        try:
            code = main(list(map(str, arguments)))
        except SystemExit as exit:
            code = int(exit.code or 0)
    return SimpleNamespace(returncode=code, stdout=out.getvalue(), stderr=error.getvalue())


def is_refused(ran: SimpleNamespace, code: int, words: str, of: object = "") -> bool:
    """In one line that begins with the file, and nothing is said beside it."""
    assert (ran.returncode, ran.stdout, ran.stderr.count("\n")) == (code, "", 1), ran.stderr
    return ran.stderr.startswith(f"condyle: {of}") and words in ran.stderr


def run_alone(*arguments: object) -> "subprocess.CompletedProcess[str]":
    """In a process of its own, with its output shown."""
    package = Path(figures.__file__).parents[2]
    return subprocess.run([sys.executable, "-m", "condyle.plot", *map(str, arguments)], capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": str(package)})


def test_the_grid_is_the_interval_about_the_start_or_the_nearest_one(tmp_path):
    grid = figures.files.read_rom(map_folder(tmp_path))["grid"]
    assert grid.columns_deg.tolist() == [0, 10, 20] and grid.rows_deg.tolist() == [-5, 5]
    assert np.array_equal(grid.upper_deg, [[40, 90, 8], [20, 20, np.nan]], equal_nan=True)
    assert np.array_equal(grid.lower_deg, [[-30, -90, 3], [-30, -30, np.nan]], equal_nan=True)
    assert grid.intervals.tolist() == [[1, 1, 2], [2, 1, 0]]
    assert grid.free_at_start.tolist() == [[True, True, False], [True, True, False]]
    assert grid.upper_open.tolist() == [[False, True, False], [False, False, False]]


def test_gaps_of_curves_are_nan(tmp_path):
    table = figures.files.read_curves(motion_folder(tmp_path) / "curves.csv")
    assert np.array_equal(table["area_mm2"], [1, np.nan, 3], equal_nan=True)
    assert list(table) == ["time_s", "area_mm2", "max_depth_mm", "mean_depth_mm"]


def test_opensim_tables_are_read(tmp_path):
    path = tmp_path / "a.sto"
    path.write_text("words\nversion=1\nendheader\ntime\tarea\n0\t1.5\n1\tnan\n")
    table = figures.files.read_sto(path)
    assert np.array_equal(table["area"], [1.5, np.nan], equal_nan=True)


def test_a_folder_has_the_figures_of_its_data(tmp_path):
    assert [name for name, _ in drawings(rom_folder(tmp_path / "rom"))] == ["limits", "clock_face"]
    assert [name for name, _ in drawings(map_folder(tmp_path / "map"))] == [
        "limits", "clock_face", "map_internal_rotation", "map_external_rotation", "map_free_range"]
    assert [name for name, _ in drawings(motion_folder(tmp_path / "motion"))] == ["curves"]


BAND = {"p5_deg": 95.0, "median_deg": 100.0, "p95_deg": 105.0}


def test_a_map_that_ligaments_end_has_a_figure_of_what_ends_it(tmp_path):
    folder = map_folder(tmp_path / "map")
    lines = INTERVALS.splitlines()
    header = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    lines[header] += ",low_ligament,high_ligament"
    for i in range(header + 1, len(lines)):
        lines[i] += ',,"band, front"' if i == header + 1 else ",,"
    (folder / "map_intervals.csv").write_text("\n".join(lines) + "\n")
    names = [name for name, _ in drawings(folder)]
    assert names == ["limits", "clock_face", "map_internal_rotation", "map_internal_rotation_ends", "map_external_rotation", "map_free_range"]
    grid = figures.files.read_rom(folder)["grid"]
    assert sorted(set(grid.upper_ligament.ravel())) == ["", "band, front"] and set(grid.lower_ligament.ravel()) == {""}


def test_limits_of_a_map_do_not_replace_those_with_bands(tmp_path):
    banded = {"name": "flexion", "limit_deg": 100.0, "reason": "contact", "band": BAND}
    for folder in (rom_folder(tmp_path / "range", motions=[banded]), map_folder(tmp_path / "map")):
        assert run(folder, "--format", "png", "--out", tmp_path / "figures").returncode == 0
    assert {path.stem for path in (tmp_path / "figures").iterdir()} >= {"limit_bands", "limits"}


def test_the_command_removes_figures_of_what_it_replaces(tmp_path, coarse_hip_file):
    def answered(*arguments: object) -> None:
        run_command(*map(str, arguments), "--out", tmp_path / "out")

    pytest.importorskip("vtkmodules")
    (tmp_path / "swing.csv").write_text("time,flexion_deg\n0,0\n1,140\n")
    rom = ["rom", coarse_hip_file, "--motion", "flexion"]
    swing = ["motion", coarse_hip_file, "--motion", tmp_path / "swing.csv"]
    for first, second, drawn in (([*rom, "--band=20"], rom, "limit_bands"), ([*swing, "--maps"], swing, "depth_map")):
        answered(*first)
        assert run(tmp_path / "out").returncode == 0
        assert (tmp_path / "out" / f"{drawn}.pdf").exists()
        answered(*second)
        assert not (tmp_path / "out" / f"{drawn}.pdf").exists()


@pytest.mark.parametrize("format, begins", [("pdf", b"%PDF"), ("svg", b"<?xml"), ("png", b"\x89PNG")])
def test_the_module_names_what_it_wrote(tmp_path, format, begins):
    ran = run_alone(rom_folder(tmp_path / "rom"), "--format", format, "--out", tmp_path / "new" / "figures")
    assert (ran.returncode, ran.stderr) == (0, "")
    written = [Path(line) for line in ran.stdout.splitlines()]
    assert [path.name for path in written] == [f"limits.{format}", f"clock_face.{format}"]
    assert all(path.read_bytes().startswith(begins) for path in written)
    there = sorted(path.name for path in (tmp_path / "new" / "figures").iterdir())
    assert there == sorted(path.name for path in written)


def test_the_same_figure_is_the_same_file(tmp_path):
    folder = rom_folder(tmp_path)
    for format in ("pdf", "svg", "png"):
        assert run(folder, "--format", format).returncode == 0
        first = (folder / f"limits.{format}").read_bytes()
        assert run_alone(folder, "--format", format).returncode == 0
        assert (folder / f"limits.{format}").read_bytes() == first


@pytest.mark.parametrize("arguments", [[], ["a", "b"], ["a", "--format", "jpg"], ["a", "--frames", "x"], ["a", "--colour", "red"]])
def test_wrong_usage_is_one_line_and_2(arguments):
    assert is_refused(run(*arguments), 2, "")


def test_help_has_examples():
    ran = run("--help")
    assert ran.returncode == 0 and ran.stdout.count("python3 -m condyle.plot") >= 3


def damaged(folder: Path, name: str, text: str) -> Path:
    map_folder(folder)
    (folder / name).write_text(text)
    return folder


def rom_text(map: object = None, **changes: object) -> str:
    motion = {"name": "flexion", "limit_deg": 1, "reason": "contact", **changes}
    return json.dumps({"condyle": 1, "motions": [motion], **({} if map is None else {"map": map})})


NO_REASON = json.dumps({"condyle": 1, "motions": [{"name": "flexion", "limit_deg": 1}]})
BAD = {
    "not_json": ("rom.json", "{", "rom.json: line 1: not JSON"),
    "another_json": ("rom.json", "[1]", "rom.json: not a result of condyle"),
    "no_motions": ("rom.json", '{"condyle": 1}', "rom.json: no motions"),
    "no_reason": ("rom.json", NO_REASON, "rom.json: motion 0 has no 'reason'"),
    "no_grid": ("rom.json", rom_text(map={}), "rom.json: map: no 'columns'"),
    "columns_of_text": ("rom.json", rom_text(map={"columns": {"count": "3"}, "rows": {}}), "rom.json: map: columns: 'count' is not a number"),
    "a_limit_of_text": ("rom.json", rom_text(limit_deg="far"), "rom.json: motion 0: 'limit_deg' is not a number"),
    "a_limit_of_nothing": ("rom.json", rom_text(limit_deg=None), "rom.json: motion 0: 'limit_deg' is not a number"),
    "a_reason_of_no_kind": ("rom.json", rom_text(reason="tired"), "rom.json: motion 0: 'reason' is none of"),
    "an_hour_of_text": ("rom.json", rom_text(clock_hour="two"), "rom.json: motion 0: 'clock_hour' is not a number"),
    "a_band_of_text": ("rom.json", rom_text(band={"p5_deg": "1"}), "rom.json: motion 0: band: 'p5_deg' is not"),
    "short_row": ("map_intervals.csv", INTERVALS + "1,2\n", "map_intervals.csv: line 10: 2 fields, not 7"),
    "no_number": ("map_intervals.csv", INTERVALS.replace("-30,40", "-30,x"), "line 3: column 'internal_rotation_high_deg': 'x'"),
    "off_the_grid": ("map_intervals.csv", INTERVALS.replace("0,-5,-30", "1,-5,-30", 1), "line 3: column 'flexion_deg': 1 is not"),
    "no_header": ("map_intervals.csv", "# nothing\n", "map_intervals.csv: no rows"),
    "no_column": ("map_intervals.csv", "a,b,c,d\n1,2,3,4\n", "map_intervals.csv: no column 'low_reason'"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_bad_file_is_one_line_and_3_and_nothing_is_written(tmp_path, name):
    file, text, words = BAD[name]
    folder = damaged(tmp_path / "in", file, text)
    assert is_refused(run(folder, "--out", tmp_path / "out"), 3, words) and not (tmp_path / "out").exists()


def test_limits_beside_a_map_that_is_free_nowhere_are_drawn(tmp_path):
    header = next(line for line in INTERVALS.splitlines() if not line.startswith("#"))
    ran = run(damaged(tmp_path / "in", "map_intervals.csv", header + "\n"), "--out", tmp_path / "out")
    assert ran.returncode == 0, ran.stderr
    assert any(path.name.startswith("limits") for path in (tmp_path / "out").iterdir())


def test_folders_without_results_are_refused(tmp_path):
    for folder, words in ((tmp_path, "neither rom.json nor curves.csv nor sweep.json nor measures.json"), (tmp_path / "none", "not a folder")):
        assert is_refused(run(folder), 3, words)
    missing = map_folder(tmp_path / "map")
    (missing / "map_intervals.csv").unlink()
    assert is_refused(run(missing), 3, "map_intervals.csv: No such file")


def test_frames_without_maps_are_refused(tmp_path):
    assert is_refused(run(motion_folder(tmp_path), "--frames", 0), 3, "--maps")


def test_a_damaged_surface_is_refused(tmp_path):
    pytest.importorskip("vtkmodules")
    folder = motion_folder(tmp_path)
    (folder / "map_fixed.vtp").write_text("")
    (folder / "map_mobile_00000.vtp").write_text("<VTKFile")
    assert is_refused(run_alone(folder), 3, "map_mobile_00000.vtp: not a VTP file")  # VTK has ways of its own to print


def test_figures_can_be_saved_by_the_ending_of_the_name(tmp_path):
    ax = figures.limits(figures.files.read_rom(rom_folder(tmp_path)))
    figures.save(ax, tmp_path / "a.PDF")
    assert (tmp_path / "a.PDF").read_bytes().startswith(b"%PDF")
    refused(lambda: figures.save(ax, tmp_path / "a.gif"), "a.gif: figures are written as", ValueError)


def test_what_the_command_writes_is_read(tmp_path, hip_file):
    """The writer is C++, the reader Python: a key that one of them renames is detected here."""
    arguments = [hip_file, "--motion", "flexion", "--map", "flexion=90:110:10", "adduction=0:20:10", "--band=20", "--out", tmp_path]
    run_command("rom", *arguments)
    result = figures.files.read_rom(tmp_path)
    limit = result["motions"][0]
    assert (limit["normal_range_deg"], result["normal_range_source"]) == (120, "AAOS 1965")
    (bar,) = [patch for patch in figures.limits(result).patches if patch.get_gid() == "limit"]
    assert bar.get_width() == limit["limit_deg"] > 90
    grid = result["grid"]
    assert grid.varied == ("internal_rotation", "external_rotation") and grid.column == ("flexion", "extension")
    maps = ["map_internal_rotation", "map_external_rotation", "map_free_range"]
    assert [name for name, _ in drawings(tmp_path)][-3:] == maps
    with open(tmp_path / "map.csv", encoding="utf-8") as file:
        rows = [line.split(",") for line in file if line[0].isdigit()]
    held = grid.free_at_start.ravel()
    assert held.any()
    assert np.array_equal(grid.upper_deg.ravel()[held], np.array([float(row[3]) for row in rows])[held])


def test_what_the_module_answers_is_drawn(hip):
    rom = hip.range_of_motion(["flexion", "extension"])
    ax = figures.limits(rom, bands=rom.bands(samples=20))
    drawn = [bar.get_width() for bar in ax.patches if bar.get_gid() == "limit"]
    assert drawn == [limit.limit_deg for limit in rom.limits]
    found = rom.map({"flexion": (120, 140, 10)}, {"adduction": (0, 40, 20)})
    ax = figures.motion_map(found)
    marked = {c.get_gid() for c in ax.collections if c.get_hatch()}
    assert ("nowhere" in marked) == bool(np.isnan(found.upper_deg).any())
    assert ("not_at_start" in marked) == bool((~found.free_at_start & ~np.isnan(found.upper_deg)).any())
    assert marked, "a map without any mark would test nothing"
