"""Sample joints that tests share."""

import os
import subprocess
from pathlib import Path

import pytest

import condyle


@pytest.fixture(scope="session")
def command() -> str:
    """The command line, which has the same answers."""
    return os.environ.get("CONDYLE_COMMAND", "condyle")


@pytest.fixture(scope="session")
def source() -> Path:
    return Path(os.environ.get("CONDYLE_SOURCE", Path(__file__).parents[2]))


@pytest.fixture(scope="session")
def hip_file(command: str, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("hip")
    subprocess.run([command, "sample", "hip", "--scenario", "2", "--out", folder], check=True, capture_output=True)
    return folder / "hip.toml"


@pytest.fixture(scope="session")
def hip(hip_file: Path) -> condyle.Joint:
    return condyle.read_joint(hip_file)
