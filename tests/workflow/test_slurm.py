"""Shards that Snakemake hands to Slurm, a node of it on this machine, give the tables of one run: one shard is killed on its way, the node
is lost once, and one joint is bad."""

import shutil
import subprocess
from pathlib import Path

import pytest

from conftest import OPTIONS, SHARDS, assert_same_tables
from one_node_slurm import OneNodeSlurm, missing_programs, wait_for

missing = missing_programs()
pytestmark = pytest.mark.skipif(bool(missing), reason=f"no {', '.join(missing)}: shards under Slurm not tried")


@pytest.fixture()
def slurm(tmp_path_factory):
    with OneNodeSlurm(tmp_path_factory.mktemp("slurm")) as running:
        yield running


def shards_done(out: Path) -> int:
    return len(list(out.glob("shards/*/study.json")))


@pytest.mark.skipif(shutil.which("snakemake") is None, reason="no snakemake: Slurm under it not tried")
def test_snakemake_hands_shards_to_slurm_which_loses_its_node(slurm, workflow, cohort, whole, killed_once, tmp_path):
    out, said = tmp_path / "study", tmp_path / "snakemake.log"
    slow = tmp_path / "slow"  # so that the node is lost in the middle of a shard
    slow.write_text(f"#!/bin/sh\nsleep 1\nexec '{killed_once}' \"$@\"\n", encoding="utf-8")
    slow.chmod(0o755)
    with said.open("w", encoding="utf-8") as log, subprocess.Popen(
            ["snakemake", "--snakefile", workflow / "Snakefile", "--profile", workflow / "profiles/slurm", "--latency-wait", "10", "--config",
             f"table={cohort}", f"out={out}", f"shards={SHARDS}", f"options={OPTIONS}", f"condyle={slow}", "threads=1", "mem_mb=0"],
            cwd=tmp_path, env=slurm.environment, stdout=log, stderr=log) as running:
        try:
            wait_for("the first shard", lambda: shards_done(out) > 0, 180)
            slurm.lose_node()
            assert shards_done(out) < SHARDS
            wait_for("the loss to be noticed", lambda: "down" in slurm.run("sinfo", "--noheader", "--format=%t"), 120)
            slurm.start_node()
            assert running.wait(500) == 0, said.read_text() + "".join(job.read_text() for job in tmp_path.glob("condyle_*.log"))
        finally:
            running.kill()
    assert (tmp_path / "was_killed").is_dir()
    assert_same_tables(out, whole)


def test_a_job_array_needs_no_script(slurm, cohort, whole, command, tmp_path):
    out = tmp_path / "study"
    slurm.run("sbatch", f"--array=1-{SHARDS}", "--wait", f"--output={tmp_path}/log_%a", "--wrap",
              f"'{command}' study '{cohort}' --out '{out}' --shard $SLURM_ARRAY_TASK_ID/{SHARDS} {OPTIONS}")
    subprocess.run([command, "merge", out], check=True, capture_output=True)
    assert_same_tables(out, whole)
