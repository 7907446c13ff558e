"""Shards under Snakemake on this machine give the tables of one run, though a shard is killed on its way."""

import shutil
import subprocess
from pathlib import Path

import pytest

from conftest import OPTIONS, SHARDS, assert_same_tables

pytestmark = pytest.mark.skipif(shutil.which("snakemake") is None, reason="no snakemake: shards under it not tried")


def snakemake(workflow: Path, cohort: Path, out: Path, condyle: object, *more: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(
        ["snakemake", "--snakefile", workflow / "Snakefile", "--profile", workflow / "profiles/local", "-j2", *more,
         "--config", f"table={cohort}", f"out={out}", f"shards={SHARDS}", f"options={OPTIONS}", f"condyle={condyle}",
         "threads=1"],
        cwd=out.parent, capture_output=True, text=True)


def test_shards_merge_to_one_run(workflow, cohort, whole, killed_once, tmp_path):
    out = tmp_path / "study"
    ran = snakemake(workflow, cohort, out, killed_once)
    assert ran.returncode == 0, ran.stderr
    assert (tmp_path / "was_killed").is_dir()
    assert_same_tables(out, whole)
    again = snakemake(workflow, cohort, out, killed_once)
    assert again.returncode == 0 and "Nothing to be done" in again.stderr, again.stderr


def test_a_lost_shard_is_done_again_and_no_other(workflow, cohort, whole, command, tmp_path):
    out = tmp_path / "study"
    assert snakemake(workflow, cohort, out, command).returncode == 0
    times = {path: path.stat().st_mtime_ns for path in out.glob("shards/*/study.json")}
    lost = out / f"shards/2_of_{SHARDS}"
    shutil.rmtree(lost)
    (out / "study.json").unlink()
    ran = snakemake(workflow, cohort, out, command)
    assert ran.returncode == 0, ran.stderr
    assert_same_tables(out, whole)
    for path, time in times.items():
        assert (path.stat().st_mtime_ns == time) == (path.parent != lost), path
