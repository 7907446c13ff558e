"""Shards of a sweep under Snakemake on this machine give the bytes of one run, though a shard is killed on its way."""

import shutil
import subprocess
from pathlib import Path

import pytest

from conftest import snakemake

pytestmark = pytest.mark.skipif(shutil.which("snakemake") is None, reason="no snakemake: shards under it not tried")

SHARDS = 3
VARY = "cup.inclination=30:50:5 cup.anteversion=0:30:5"
FILES = ("sweep.json", "designs.csv", "safe.csv", "zone.vtp")


@pytest.fixture()
def joint(command: str, tmp_path: Path) -> Path:
    subprocess.run([command, "sample", "replacement", "--bones", "none", "--facets", "120", "--out", tmp_path / "thr"], check=True,
                   capture_output=True)
    (tmp_path / "daily.csv").write_text("name,motion,reach_deg\nsitting,flexion,110\npivoting,external_rotation,40\n", encoding="utf-8")
    return tmp_path / "thr/hip.toml"


def test_shards_merge_to_one_run(workflow, joint, command, killed_once, tmp_path):
    targets, out = tmp_path / "daily.csv", tmp_path / "zone"
    subprocess.run([command, "--threads", "1", "sweep", joint, "--vary", VARY, "--targets", targets, "--out", tmp_path / "whole",
                    "--band=20"], check=True, capture_output=True)
    for says in ("", "Nothing to be done"):
        ran = snakemake(workflow / "sweep.smk", tmp_path, joint=joint, vary=VARY, targets=targets, out=out, shards=SHARDS,
                        options="--band=20", condyle=killed_once)
        assert ran.returncode == 0 and says in ran.stderr, ran.stderr
    assert (tmp_path / "was_killed").is_dir()
    for name in FILES:
        assert (out / name).read_bytes() == (tmp_path / "whole" / name).read_bytes(), name
