"""Sample joints that tests share."""

import functools
import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from common import run_command

import condyle

# Where real joints lie, by the rule of the C++ tests: what is named, or else the folder beside the repository.
os.environ.setdefault("CONDYLE_DATA", str(Path(__file__).resolve().parents[3] / "shared/data"))


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--cases", choices=("all", "quick", "slow"), default="all", help="those of tests/slow_cases.txt, or the others")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leaves out the slow cases, or all others; refuses a list that names a case there is not."""
    cases = config.getoption("--cases")
    if cases == "all":
        return
    lines = (Path(__file__).parents[1] / "slow_cases.txt").read_text().splitlines()
    listed = {line.removeprefix("+ ").removeprefix("python ") for line in lines if line.removeprefix("+ ").startswith("python ")}
    kept = {line.removeprefix("+ python ") for line in lines if line.startswith("+ ")}
    if missing := sorted(listed - {item.nodeid for item in items}):
        raise pytest.UsageError(f"tests/slow_cases.txt: no case is called {missing[0]}")
    slow = listed - kept
    chosen = [item for item in items if (item.nodeid in slow) == (cases == "slow")]
    config.hook.pytest_deselected(items=[item for item in items if item not in set(chosen)])
    items[:] = chosen


@pytest.fixture(scope="session")
def source() -> Path:
    return Path(os.environ.get("CONDYLE_SOURCE", Path(__file__).parents[2]))


@pytest.fixture(scope="session")
def sampled(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Path]:
    """sampled(folder, words...) has in a folder what `condyle sample WORDS` makes, once for all tests that ask for the same."""

    @functools.cache
    def made(*words: str) -> Path:
        folder = tmp_path_factory.mktemp("sample")
        run_command("sample", *words, "--out", folder)
        return folder

    return lambda folder, *words: shutil.copytree(made(*words), folder, dirs_exist_ok=True)


@pytest.fixture(scope="session")
def hip_file(sampled: Callable[..., Path], tmp_path_factory: pytest.TempPathFactory) -> Path:
    return sampled(tmp_path_factory.mktemp("hip"), "hip", "--scenario", "2") / "hip.toml"


@pytest.fixture(scope="session")
def coarse_hip_file(sampled: Callable[..., Path], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """For what is the same of bones of any size."""
    return sampled(tmp_path_factory.mktemp("coarse_hip"), "hip") / "hip.toml"


@pytest.fixture(scope="session")
def coarse_bones() -> condyle.SampleHip:
    """Nothing can change a mesh."""
    return condyle.sample_hip(scenario=1)


@pytest.fixture(scope="session")
def default_bones() -> condyle.SampleHip:
    return condyle.sample_hip()


@pytest.fixture(scope="session")
def hip(hip_file: Path) -> condyle.Joint:
    return condyle.read_joint(hip_file)
