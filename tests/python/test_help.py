"""`--help` of every command: it fits a terminal, and its examples run as they are printed."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from common import COMMAND, run_command


def help_of(*words: str, all: bool = False) -> str:
    return run_command(*words, "--help-all" if all else "--help").stdout


def subcommands(*words: str) -> list[str]:
    listed = help_of(*words).partition("\nSubcommands:\n")[2].partition("\n\n")[0]
    return [" ".join([*words, name]) for name in re.findall(r"^  (\S+)", listed, re.M)]


#: "" is condyle itself.
COMMANDS = ["", *subcommands(), *subcommands("sample")]


@pytest.fixture
def on_path(tmp_path_factory, monkeypatch):
    """The command and Python by the names that examples use."""
    tools = tmp_path_factory.mktemp("bin")
    (tools / "condyle").symlink_to(Path(COMMAND).resolve())
    (tools / "python3").symlink_to(sys.executable)
    monkeypatch.setenv("PATH", f"{tools}{os.pathsep}{os.environ['PATH']}")


@pytest.mark.parametrize("words", COMMANDS)
def test_it_fits_a_terminal_and_has_an_example(words):
    text = help_of(*words.split())
    assert max(map(len, text.splitlines())) <= 100
    assert len(text.splitlines()) <= 60
    if words not in ("", "sample"):  # theirs has that of the commands below
        rest = re.search("^More options by --help-all: ", text, re.M)
        assert bool(rest) == (len(help_of(*words.split(), all=True).splitlines()) > 60)
    assert re.search("^Example: condyle ", text, re.M)


@pytest.mark.parametrize("words", COMMANDS)
def test_its_examples_run_as_printed_in_an_empty_folder(words, on_path, tmp_path):
    # The lines below the first are indented by as much as "Example: " is long, and those that go on after a backslash by more.
    example = re.search("^Example: (.*\n(?: {9}.*\n)*)", help_of(*words.split()), re.M)[1]
    if "condyle.plot" in example:
        pytest.importorskip("matplotlib")
    ran = subprocess.run(["sh", "-e", "-c", example], cwd=tmp_path, capture_output=True, text=True)
    assert ran.returncode == 0, f"{example}{ran.stderr}"


def test_options_of_one_name_say_what_they_mean_in_each_command():
    def says(command, *texts):
        words = " ".join(help_of(command, all=True).split())
        return [text in words for text in texts]

    contact, right, lateral = "or with its layers, load or motion", "and to the right, of a left joint too", "to the left of a left one"
    for command in ("load", "motion", "rom", "report"):
        assert says(command, contact, right, lateral) == [True, True, False], command
    for command in ("frame", "depth", "measure", "resect", "implant", "picture"):
        assert says(command, contact, right, lateral) == [False, False, False], command
    for command in ("sweep", "study"):
        assert says(command, contact, right, lateral) == [False, False, True], command
