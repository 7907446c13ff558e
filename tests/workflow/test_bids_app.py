"""Participants that are answered one by one, and then put together, give the tables of one run."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from conftest import OPTIONS, assert_same_tables


@pytest.fixture()
def dataset(cohort: Path, tmp_path: Path) -> Path:
    """Three participants with joints at two depths of folders; the second has two joints."""
    folder = tmp_path / "bids"
    for name, k in (("sub-01/anat/hip_right", 1), ("sub-02/ses-1/hip_left", 2), ("sub-02/ses-2/hip_left", 3), ("sub-x 3/hip", 4)):
        joint = folder / f"{name}.toml"
        joint.parent.mkdir(parents=True, exist_ok=True)
        joint.write_text((cohort.parent / f"hip{k}.toml").read_text(encoding="utf-8"), encoding="utf-8")
        for mesh in ("arm.obj", f"post{k}.obj"):
            shutil.copy(cohort.parent / mesh, joint.parent)
    (folder / "derivatives/sub-01").mkdir(parents=True)
    (folder / "derivatives/sub-01/hip.toml").write_text("of another program", encoding="utf-8")
    return folder


def app(workflow: Path, command: str, *words: object) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([workflow / "bids_app.py", *words], env={**os.environ, "CONDYLE": command}, capture_output=True, text=True)


def test_participants_merge_to_one_run(workflow, dataset, command, tmp_path):
    out, options = tmp_path / "out", f"--options={OPTIONS} --motion flexion"
    for labels in (["01"], ["sub-02", "x 3"], ["01"]):
        ran = app(workflow, command, dataset, out, "participant", "--participant_label", *labels, options)
        assert ran.returncode == 0, ran.stderr
    ran = app(workflow, command, dataset, out, "group")
    assert (ran.returncode, ran.stdout) == (0, "4 answered, 0 failed\n"), ran.stderr
    subprocess.run([command, "study", out / "joints.csv", "--out", tmp_path / "whole", OPTIONS, "--motion", "flexion"], check=True,
                   capture_output=True)
    assert_same_tables(out, tmp_path / "whole")
    hips = (out / "hips.csv").read_text(encoding="utf-8")
    for name in ("sub-01_anat_hip_right", "sub-02_ses-1_hip_left", "sub-02_ses-2_hip_left", "sub-x 3_hip"):
        assert name in hips
    assert "derivatives" not in hips


def test_all_participants_are_answered_unless_some_are_named(workflow, dataset, command, tmp_path):
    assert app(workflow, command, dataset, tmp_path / "out", "participant", "--options=--motion flexion").returncode == 0
    assert app(workflow, command, dataset, tmp_path / "out", "group").stdout == "4 answered, 0 failed\n"


def test_who_is_missing_is_named(workflow, dataset, command, tmp_path):
    out = tmp_path / "out"
    ran = app(workflow, command, dataset, out, "participant", "--participant_label", "01", "09")
    assert ran.returncode == 2 and "sub-09" in ran.stderr and "sub-01," not in ran.stderr
    assert app(workflow, command, dataset, out, "participant", "--participant_label", "01").returncode == 0
    ran = app(workflow, command, dataset, out, "group")
    assert ran.returncode == 3 and "3 of 4 shards are missing or not whole: 2, 3, 4" in ran.stderr
    ran = app(workflow, command, tmp_path / "out", tmp_path / "other", "participant")
    assert ran.returncode == 2 and "no joint file of sub-*" in ran.stderr
