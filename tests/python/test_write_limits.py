"""Limits written for other programs: what must not be written, and what is written again."""

import csv
import os
import random
import re
from pathlib import Path

import numpy as np
import pytest
from common import changed, refused, run_command

import condyle

DATA = Path(os.environ["CONDYLE_DATA"])
MODEL = DATA / "osim_gait2354" / "gait2354_simbody.osim"


@pytest.fixture(scope="module")
def joint(tmp_path_factory):
    if not MODEL.exists():
        pytest.skip("no gait2354 in CONDYLE_DATA")
    path = tmp_path_factory.mktemp("limits") / "hip.toml"
    run_command("init", MODEL, "--joint", "hip_r", "-o", path)
    return path


def written(joint, *words):
    return run_command("rom", joint, "--motion", "flexion", "--write-limits", *words, check=False)


def test_written_again_with_the_other_stop_the_old_force_is_gone(joint, tmp_path):
    first, second = tmp_path / "a.osim", tmp_path / "b.osim"
    assert written(joint, first, "--model", MODEL).returncode == 0
    assert written(joint, second, "--model", first, "--stop", "linear").returncode == 0
    text = second.read_text()
    assert "condyle_limit_" not in re.sub("<!--.*?-->", "", text, flags=re.S) and text.count('name="condyle_stop_') == 3
    run_command("inspect", second)
    again = written(joint, tmp_path / "c.osim", "--model", second, "--stop", "linear")
    assert again.returncode == 0 and "stop of the model's own" not in again.stdout, "the forces are ours"


def changed_model(tmp_path, pattern, by):
    text, count = re.subn(pattern, by, MODEL.read_text(), count=1, flags=re.S)
    assert count == 1
    path = tmp_path / "changed.osim"
    path.write_text(text)
    return path


def test_a_default_outside_of_the_limits_is_refused(joint, tmp_path):
    model = changed_model(tmp_path, r'(<Coordinate name="hip_flexion_r">.*?<default_value>)[^<]*', r"\g<1>-1.5")
    done = written(joint, tmp_path / "out.osim", "--model", model)
    assert done.returncode == 3 and "the default_value -1.5 of 'hip_flexion_r' is outside" in done.stderr
    assert not (tmp_path / "out.osim").exists()


def test_a_file_in_the_folder_of_out_is_refused(joint, tmp_path):
    done = written(joint, tmp_path / "limits.csv", "--out", tmp_path)
    assert done.returncode == 2 and "would lie in the folder of --out" in done.stderr


def test_half_a_grid_is_refused(hip_file, tmp_path):
    rom = condyle.read_joint(hip_file).range_of_motion([])
    grid = {"column": {"flexion": (0, 90, 45)}, "row": {"adduction": (-10, 10, 10)}}
    for half in ({"column": grid["column"]}, {"row": grid["row"]}, {"vary": "internal_rotation"}):
        refused(lambda: rom.write_limits(tmp_path / "hip.xml", **half), "column and row are given together")
    assert not (tmp_path / "hip.xml").exists()
    assert rom.write_limits(tmp_path / "hip.xml", **grid, vary="internal_rotation")["error"]["points"] == 9


def test_names_of_coordinates_are_fields_of_a_table(hip_file, tmp_path):
    names = {"flexion": 'bend, "forwards"', "adduction": "tilt,", "internal_rotation": "turn"}
    path = changed(hip_file, tmp_path, more="\n[recorded_motion]\n" + "".join(f"{angle} = '{name}'\n" for angle, name in names.items()))
    done = written(path, tmp_path / "coupled.csv", "--map", "flexion=0:90:45", "adduction=-10:10:10")
    assert done.returncode == 0, done.stderr
    first, *rows = csv.reader(line for line in open(tmp_path / "coupled.csv") if not line.startswith("#"))
    assert first == [f"{names['flexion']}_deg", f"{names['adduction']}_deg",
                     *(f"{names['internal_rotation']}_{end}" for end in ("lower_deg", "upper_deg", "lower_reason", "upper_reason"))]
    assert len(rows) == 9 and all(len(row) == len(first) for row in rows)


JOINTS = [("osim_gait2354/gait2354_simbody.osim", "hip_r"), ("osim_gait2354/gait2354_simbody.osim", "ankle_r"),
          ("osim_gait2354/subject01_simbody_adjusted.osim", "hip_r"), ("public_cases/turn5/models/stopped_before_bone.osim", "knee_r")]


def another(text, draw):
    """A joint file with another zero, other axes, another side, sign or unit: one of them, or two."""
    angle = re.search(r"^(\w+) = \{ column", text, re.M).group(1)
    for change in draw.sample(("zero", "anatomy", "axes", "centre", "side", "sign", "unit"), draw.choice((1, 1, 2))):
        if change in ("zero", "anatomy") and "[reference_pose]" not in text:
            text += "\n[reference_pose]\n" + (f"{angle} = {draw.uniform(-30, 30)}\n" if change == "zero" else 'from = "anatomy"\n')
        elif change == "axes":
            x, y, _ = np.linalg.qr(np.eye(3) + 0.2 * np.array([[draw.gauss(0, 1) for _ in range(3)] for _ in range(3)]))[0].T
            frame = f"anterior = {list(map(float, x))}\nsuperior = {list(map(float, y))}\n"
            text = re.sub(r"anterior = .*\nsuperior = .*\n", frame, text, count=1)
        elif change == "centre":
            text = re.sub(r"centre = \[([^,]*)", lambda m: f"centre = [{float(m[1]) + draw.uniform(-.005, .005)}", text, count=1)
        elif change == "side":
            text = re.sub(r'^side = "right"', 'side = "left"', text, count=1, flags=re.M)
        elif change == "sign":
            text = re.sub(r"(\{ column = [^,]*)(, sign = -1)?,", lambda m: m[1] + ("," if m[2] else ", sign = -1,"), text, count=1)
        elif change == "unit":
            text = text.replace('units = "m"', 'units = "cm"')
    return text


@pytest.mark.parametrize("model, name", JOINTS)
def test_limits_and_poses_stay_the_models_or_are_refused(model, name, tmp_path):
    if not (DATA / model).exists():
        pytest.skip("no model in CONDYLE_DATA")
    path, draw, refused = tmp_path / "joint.toml", random.Random(name), 0
    run_command("init", DATA / model, "--joint", name, "-o", path)
    text = path.read_text()
    columns = re.findall(r"column = '[^']*/(\w+)'", text)
    (tmp_path / "m.mot").write_text("inDegrees=yes\nendheader\ntime " + " ".join(columns) + "\n0 0 0 0\n1 25 -8 12\n".replace(
        "0 0 0 0", " ".join("0" * (1 + len(columns)))).replace("-8 12", "-8 12" if len(columns) > 1 else ""))

    def answers(joint):
        rom = joint.range_of_motion([], bearing="leave_out" if name == "hip_r" else "count", accept_reference_contact=True)
        grid = {} if len(columns) == 1 else {"column": {"flexion": (0, 10, 10)}, "row": {"adduction": (0, 10, 10)}}
        said = rom.write_limits(tmp_path / "out.osim", model=DATA / model, **grid)
        return [side[end]["limit_deg"] for side in said["coordinates"] for end in ("lower", "upper")]

    def apart(joint):
        """Distances between points of both bodies, whatever their frames are."""
        fixed, mobile = (np.asarray(mesh.vertices)[np.array([0, 5, 9, 20]) % len(mesh.vertices)]  # a box has 8
                         for mesh in (joint._fixed, joint._mobile))
        return np.array([np.linalg.norm(fixed[:, None] - (mobile @ X[:3, :3].T + X[:3, 3])[None], axis=2)
                         for X in joint.motion(tmp_path / "m.mot").X_FM])

    base = condyle.read_joint(path)
    limits, distances = answers(base), apart(base)
    for _ in range(250 if os.environ.get("CONDYLE_LONG_TESTS") else 6):
        path.write_text(another(text, draw))
        try:
            joint = condyle.read_joint(path)
            if path.read_text().count("sign = -1") == text.count("sign = -1") and 'units = "m"' in path.read_text():
                try:
                    assert np.allclose(apart(joint), distances, atol=1e-6)
                except condyle.FileError as error:
                    assert "does not translate" in str(error)
            assert np.allclose(answers(joint), limits, atol=1e-6), path.read_text()
        except (condyle.UsageError, condyle.FileError, condyle.MeshError):
            refused += 1
    assert refused < 150 or not os.environ.get("CONDYLE_LONG_TESTS")
