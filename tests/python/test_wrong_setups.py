"""Every wrong set-up of wrong_setups.py gets one clear line or note, from the command and from the module."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
from wrong_setups import ERRORS, SETUPS, Scene, Setup
from common import refused, run_command, warnings_of

import condyle

NOTE, ERROR = "condyle: note: ", "condyle: "
LONGEST = 400


@pytest.fixture
def scene(coarse_bones: condyle.SampleHip, coarse_hip_file: Path, tmp_path: Path) -> Scene:
    return Scene(tmp_path, coarse_bones, coarse_hip_file.read_text(encoding="utf-8"))


def require_one_line(text: str) -> None:
    assert "\n" not in text and 0 < len(text) < LONGEST and text.isprintable(), text


def require_command_says(setup: Setup, folder: Path) -> None:
    ran = run_command(*shlex.split(setup.command), check=False, cwd=folder, timeout=300)
    notes = [line for line in ran.stderr.splitlines() if line.startswith(NOTE)]
    rest = [line for line in ran.stderr.splitlines() if not line.startswith(NOTE)]
    assert ran.returncode == setup.ends, ran.stderr
    if setup.ends == 0:
        # Those on what was written or read have no code.
        coded = [line for line in notes if re.match(NOTE + "[a-z_]+: ", line)]
        assert coded and any(setup.says in line for line in coded), ran.stderr
        assert rest == []
        return
    line, = rest
    assert line.startswith(ERROR) and setup.says in line, line
    assert not setup.untrue or setup.untrue not in line, line
    require_one_line(line)


def require_module_says(setup: Setup, scene: Scene) -> None:
    if setup.ask is None:
        return
    if setup.ends != 0:
        line = refused(lambda: setup.ask(scene), kind=ERRORS[setup.ends])
        assert (setup.says_in_python or setup.says) in line
        assert not setup.untrue or setup.untrue not in line
        require_one_line(line)
        return
    said = [str(each.message) for each in warnings_of(lambda: setup.ask(scene))]
    assert any(setup.says in text for text in said), said
    for text in said:
        require_one_line(text)


@pytest.mark.parametrize("name", SETUPS)
def test_a_wrong_setup_is_reported(name: str, scene: Scene):
    setup = SETUPS[name]
    setup.spoil(scene)
    require_command_says(setup, scene.folder)
    require_module_says(setup, scene)


def test_there_are_sixty() -> None:
    assert len(SETUPS) >= 60
