"""Shards under Snakemake on this machine give the tables of one run, though a shard is killed on its way."""

import shutil
import subprocess
from pathlib import Path

import pytest

from conftest import OPTIONS, SHARDS, assert_same_tables, snakemake

pytestmark = pytest.mark.skipif(shutil.which("snakemake") is None, reason="no snakemake: shards under it not tried")


def run(workflow: Path, cohort: Path, out: Path, condyle: object) -> "subprocess.CompletedProcess[str]":
    return snakemake(workflow / "Snakefile", out.parent, table=cohort, out=out, shards=SHARDS, options=OPTIONS, condyle=condyle)


def test_shards_merge_to_one_run(workflow, cohort, whole, killed_once, tmp_path):
    out = tmp_path / "study"
    ran = run(workflow, cohort, out, killed_once)
    assert ran.returncode == 0, ran.stderr
    assert (tmp_path / "was_killed").is_dir()
    assert_same_tables(out, whole)
    again = run(workflow, cohort, out, killed_once)
    assert again.returncode == 0 and "Nothing to be done" in again.stderr, again.stderr


def test_a_lost_shard_is_done_again_and_no_other(workflow, cohort, whole, command, tmp_path):
    out = tmp_path / "study"
    assert run(workflow, cohort, out, command).returncode == 0
    times = {path: path.stat().st_mtime_ns for path in out.glob("shards/*/study.json")}
    lost = out / f"shards/2_of_{SHARDS}"
    shutil.rmtree(lost)
    (out / "study.json").unlink()
    ran = run(workflow, cohort, out, command)
    assert ran.returncode == 0, ran.stderr
    assert_same_tables(out, whole)
    for path, time in times.items():
        assert (path.stat().st_mtime_ns == time) == (path.parent != lost), path
