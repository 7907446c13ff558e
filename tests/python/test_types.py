"""mypy finds nothing in the module's types."""

import ast
import subprocess
import sys
from pathlib import Path

import condyle


def test_types_are_complete(source: Path, tmp_path: Path):
    mypy = subprocess.run([sys.executable, "-m", "mypy", "--config-file", source / "pyproject.toml",
                           "--cache-dir", tmp_path, source / "python/condyle"],
                          capture_output=True, text=True, cwd=source / "python")
    assert mypy.returncode == 0, mypy.stdout + mypy.stderr


def names_in(body: list[ast.stmt]) -> set[str]:
    """Classes, functions and values of a stub, those of classes with the class before them."""
    found = set()
    for each in body:
        if isinstance(each, ast.ClassDef):
            found |= {each.name} | {f"{each.name}.{name}" for name in names_in(each.body)}
        elif isinstance(each, ast.FunctionDef):
            found.add(each.name)
        elif isinstance(each, ast.AnnAssign):
            found.add(each.target.id)
    return found


def test_the_stub_names_all_of_the_compiled_part_and_nothing_else(source: Path):
    stub = names_in(ast.parse((source / "python/condyle/_native.pyi").read_text()).body)
    compiled = set()
    for name, value in vars(condyle._native).items():
        if not name.startswith("_"):
            compiled.add(name)
            if isinstance(value, type):
                compiled |= {f"{name}.{of}" for of in vars(value) if not of.startswith("_") or of == "__init__"}
    no_constructor = {f"{name}.__init__" for name in stub if f"{name}.__init__" not in stub}
    assert stub == compiled - no_constructor
