"""A cohort of joints of a few triangles, and a Slurm of one node."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

JOINTS, SHARDS = 24, 6
OPTIONS = "--band=400"
TABLES = ("limits.csv", "hips.csv", "failures.csv", "columns.csv", "study.h5")


@pytest.fixture(scope="session")
def command() -> str:
    return os.environ["CONDYLE_COMMAND"]


@pytest.fixture(scope="session")
def workflow() -> Path:
    return Path(os.environ["CONDYLE_SOURCE"]) / "workflow"


def write_box(path: Path, low, high) -> None:
    corners = [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
    faces = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
    lines = [*("v %g %g %g" % corner for corner in corners), *("f %d %d %d" % tuple(v + 1 for v in f) for f in faces)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


@pytest.fixture(scope="session")
def cohort(tmp_path_factory) -> Path:
    """A table of arms with posts in front of them, one of which has no file."""
    folder = tmp_path_factory.mktemp("cohort")
    write_box(folder / "arm.obj", (-1, -100, -2), (1, -10, 2))
    rows = ["id,joint"]
    for k in range(1, JOINTS + 1):
        write_box(folder / f"post{k}.obj", (30 + k, -120, -50), (50 + k, -80, 50))
        (folder / f"hip{k}.toml").write_text(
            'condyle = 1\nname = "arm"\nkind = "ball"\nside = "right"\nunits = "mm"\n'
            f'[fixed]\nmesh = "post{k}.obj"\n[mobile]\nmesh = "arm.obj"\n'
            "[frame]\ncentre = [0, 0, 0]\nanterior = [1, 0, 0]\nsuperior = [0, 1, 0]\n", encoding="utf-8")
        rows.append(f"hip{k},hip{k}.toml" if k != 10 else "hip10,nothere.toml")
    (folder / "hips.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    return folder / "hips.csv"


@pytest.fixture(scope="session")
def whole(cohort: Path, command: str, tmp_path_factory) -> Path:
    """The study without shards."""
    folder = tmp_path_factory.mktemp("whole")
    done = subprocess.run([command, "study", cohort, "--out", folder, OPTIONS], check=True, capture_output=True, text=True)
    assert done.stdout == f"{JOINTS - 1} answered, 1 failed\n"
    return folder


@pytest.fixture()
def killed_once(tmp_path: Path, command: str) -> Path:
    """The command, but that shard 3 is killed on its way the first time."""
    script = tmp_path / "condyle_killed_once"
    script.write_text(f"""#!/usr/bin/env bash
case "$*" in
  *"--shard 3/"*)
    if mkdir '{tmp_path}/was_killed' 2>/dev/null; then
      '{command}' "$@" & sleep 0.05; kill -KILL $!; wait $!; exit 137
    fi ;;
esac
exec '{command}' "$@"
""", encoding="utf-8")
    script.chmod(0o755)
    return script


def snakemake(snakefile: Path, folder: Path, **config: object) -> "subprocess.CompletedProcess[str]":
    """Shards on this machine, each in one thread."""
    return subprocess.run(["snakemake", "--snakefile", snakefile, "--profile", snakefile.parent / "profiles/local", "-j2", "--config",
                           *(f"{name}={value}" for name, value in config.items()), "threads=1"], cwd=folder, capture_output=True, text=True)


def assert_same_tables(folder: Path, whole: Path) -> None:
    for name in TABLES:
        assert (folder / name).read_bytes() == (whole / name).read_bytes(), name
