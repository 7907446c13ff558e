"""Shards under Slurm, a node of it on this machine, give the tables of one run: one shard is killed on its way, the node is
lost once, and one joint is bad."""

import shutil
import subprocess
from pathlib import Path

import pytest

from conftest import JOINTS, OPTIONS, SHARDS, assert_same_tables
from one_node_slurm import OneNodeSlurm, missing_programs, wait_for

missing = missing_programs()
pytestmark = pytest.mark.skipif(bool(missing), reason=f"no {', '.join(missing)}: shards under Slurm not tried")


@pytest.fixture()
def slurm(tmp_path_factory):
    with OneNodeSlurm(tmp_path_factory.mktemp("slurm")) as running:
        yield running


def shards_done(out: Path) -> int:
    return len(list(out.glob("shards/*/study.json")))


def test_a_job_array_survives_a_kill_and_a_lost_node(slurm, workflow, cohort, whole, killed_once, command, tmp_path):
    out = tmp_path / "study"
    slow = tmp_path / "slow"  # so that the node is lost in the middle of a shard
    slow.write_text(f"#!/bin/sh\nsleep 1\nexec '{killed_once}' \"$@\"\n", encoding="utf-8")
    slow.chmod(0o755)
    slurm.environment["CONDYLE"] = str(slow)
    slurm.run("sbatch", f"--array=1-{SHARDS}", "--cpus-per-task=1", f"--output={tmp_path}/log_%a",
              str(workflow / "slurm_array.sh"), str(cohort), str(out), str(SHARDS), OPTIONS)
    wait_for("the first shard", lambda: shards_done(out) > 0, 60)
    slurm.lose_node()
    before = shards_done(out)
    assert before < SHARDS
    wait_for("the loss to be noticed", lambda: "down" in slurm.run("sinfo", "--noheader", "--format=%t"), 60)
    slurm.start_node()
    wait_for("all jobs", lambda: not slurm.has_jobs(), 240)
    assert (tmp_path / "was_killed").is_dir()
    done = subprocess.run([command, "merge", out], capture_output=True, text=True)
    assert done.stdout == f"{JOINTS - 1} answered, 1 failed\n", done.stderr
    assert_same_tables(out, whole)


@pytest.mark.skipif(shutil.which("snakemake") is None, reason="no snakemake: Slurm under it not tried")
def test_snakemake_hands_shards_to_slurm(slurm, workflow, cohort, whole, killed_once, tmp_path):
    out = tmp_path / "study"
    ran = subprocess.run(
        ["snakemake", "--snakefile", workflow / "Snakefile", "--profile", workflow / "profiles/slurm",
         "--latency-wait", "10", "--config", f"table={cohort}", f"out={out}", f"shards={SHARDS}", f"options={OPTIONS}",
         f"condyle={killed_once}", "threads=1", "mem_mb=0"],
        cwd=tmp_path, env=slurm.environment, capture_output=True, text=True, timeout=500)
    assert ran.returncode == 0, ran.stderr + "".join(log.read_text() for log in tmp_path.glob("condyle_*.log"))
    assert (tmp_path / "was_killed").is_dir()
    assert_same_tables(out, whole)
