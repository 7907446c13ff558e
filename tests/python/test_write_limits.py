"""Limits written for other programs: what must not be written, and what is written again."""

import csv
import os
import re
import subprocess
from pathlib import Path

import pytest

import condyle

DATA = Path(os.environ["CONDYLE_DATA"])
MODEL = DATA / "osim_gait2354" / "gait2354_simbody.osim"


@pytest.fixture(scope="module")
def joint(command, tmp_path_factory):
    if not MODEL.exists():
        pytest.skip("no gait2354 in CONDYLE_DATA")
    path = tmp_path_factory.mktemp("limits") / "hip.toml"
    subprocess.run([command, "init", MODEL, "--joint", "hip_r", "-o", path], check=True, capture_output=True)
    return path


def written(command, joint, *words):
    return subprocess.run([command, "rom", joint, "--motion", "flexion", "--write-limits", *map(str, words)], capture_output=True, text=True)


def test_written_again_with_the_other_stop_the_old_force_is_gone(command, joint, tmp_path):
    first, second = tmp_path / "a.osim", tmp_path / "b.osim"
    assert written(command, joint, first, "--model", MODEL).returncode == 0
    assert written(command, joint, second, "--model", first, "--stop", "linear").returncode == 0
    text = second.read_text()
    assert "condyle_limit_" not in re.sub("<!--.*?-->", "", text, flags=re.S) and text.count('name="condyle_stop_') == 3
    subprocess.run([command, "inspect", second], check=True, capture_output=True)


def changed_model(tmp_path, pattern, by):
    text, count = re.subn(pattern, by, MODEL.read_text(), count=1, flags=re.S)
    assert count == 1
    path = tmp_path / "changed.osim"
    path.write_text(text)
    return path


def test_a_default_outside_of_the_limits_is_refused(command, joint, tmp_path):
    model = changed_model(tmp_path, r'(<Coordinate name="hip_flexion_r">.*?<default_value>)[^<]*', r"\g<1>-1.5")
    done = written(command, joint, tmp_path / "out.osim", "--model", model)
    assert done.returncode == 3 and "the default_value -1.5 of 'hip_flexion_r' is outside" in done.stderr
    assert not (tmp_path / "out.osim").exists()


def test_a_model_whose_coordinate_has_another_sense_is_refused(command, joint, tmp_path):
    # The axis of hip_flexion_r the other way round.
    text = MODEL.read_text()
    start = text.index('name="hip_r"')
    begin = text.index("<coordinates>hip_flexion_r</coordinates>", start)
    axis = re.compile(r"<axis>\s*([-\d.]+) ([-\d.]+) ([-\d.]+)\s*</axis>").search(text, begin)
    x, y, z = (float(value) for value in axis.groups())
    model = tmp_path / "changed.osim"
    model.write_text(text[:axis.start()] + f"<axis>{-x} {-y} {-z}</axis>" + text[axis.end():])
    done = written(command, joint, tmp_path / "out.osim", "--model", model)
    assert done.returncode == 3 and "coordinate 'hip_flexion_r' turns the joint otherwise" in done.stderr


def test_a_file_in_the_folder_of_out_is_refused(command, joint, tmp_path):
    done = written(command, joint, tmp_path / "limits.csv", "--out", tmp_path)
    assert done.returncode == 2 and "would lie in the folder of --out" in done.stderr


def test_half_a_grid_is_refused(hip_file, tmp_path):
    rom = condyle.read_joint(hip_file).range_of_motion([])
    grid = {"column": {"flexion": (0, 90, 45)}, "row": {"adduction": (-10, 10, 10)}}
    for half in ({"column": grid["column"]}, {"row": grid["row"]}, {"vary": "internal_rotation"}):
        with pytest.raises(condyle.UsageError, match="column and row are given together"):
            rom.write_limits(tmp_path / "hip.xml", **half)
    assert not (tmp_path / "hip.xml").exists()
    assert rom.write_limits(tmp_path / "hip.xml", **grid, vary="internal_rotation")["error"]["points"] == 9


def test_names_of_coordinates_are_fields_of_a_table(hip_file, command, tmp_path):
    names = {"flexion": 'bend, "forwards"', "adduction": "tilt,", "internal_rotation": "turn"}
    path = tmp_path / "hip.toml"
    folder = str(hip_file).rsplit("/", 1)[0]
    path.write_text(hip_file.read_text().replace('mesh = "', f'mesh = "{folder}/') + "\n[recorded_motion]\n" +
                    "".join(f"{angle} = '{name}'\n" for angle, name in names.items()))
    done = written(command, path, tmp_path / "coupled.csv", "--map", "flexion=0:90:45", "adduction=-10:10:10")
    assert done.returncode == 0, done.stderr
    first, *rows = csv.reader(line for line in open(tmp_path / "coupled.csv") if not line.startswith("#"))
    assert first == [f"{names['flexion']}_deg", f"{names['adduction']}_deg",
                     *(f"{names['internal_rotation']}_{end}" for end in ("lower_deg", "upper_deg", "lower_reason", "upper_reason"))]
    assert len(rows) == 9 and all(len(row) == len(first) for row in rows)
