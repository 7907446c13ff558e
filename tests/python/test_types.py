"""mypy finds nothing in the module's types."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import condyle


@pytest.mark.parametrize("what", ["python/condyle"])
def test_types_are_complete(source: Path, what: str, tmp_path: Path):
    mypy = subprocess.run([sys.executable, "-m", "mypy", "--config-file", source / "pyproject.toml",
                           "--cache-dir", tmp_path, source / what],
                          capture_output=True, text=True, cwd=source / "python")
    assert mypy.returncode == 0, mypy.stdout + mypy.stderr


def test_the_stub_names_all_of_the_compiled_part_and_nothing_else(source: Path, tmp_path: Path):
    checked = subprocess.run([sys.executable, "-m", "mypy.stubtest", "condyle._native", "--ignore-missing-stub",
                              "--mypy-config-file", source / "pyproject.toml"],
                             capture_output=True, text=True, cwd=tmp_path,
                             env={**os.environ, "MYPYPATH": str(source / "python")})
    # Signatures of compiled functions cannot be looked at, names can.
    assert "is not present at runtime" not in checked.stdout and "not checking" not in checked.stdout, checked.stdout
    stub = (source / "python/condyle/_native.pyi").read_text()
    missing = [name for name in dir(condyle._native) if not name.startswith("__") and f" {name}" not in stub
               and not stub.startswith(f"{name}:") and f"\n{name}:" not in stub]
    assert not missing
