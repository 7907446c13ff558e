"""Types are complete and say what they can; modules import each other without a ring."""

import ast
import re
import subprocess
import sys
import types
import typing
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

import condyle
import condyle.plot


@pytest.fixture(scope="session")
def checked(source: Path, tmp_path_factory: pytest.TempPathFactory) -> Callable[[Path], subprocess.CompletedProcess]:
    """Asks mypy, which remembers the module from one question to the next."""
    cache = tmp_path_factory.mktemp("mypy")

    def check(path: Path) -> subprocess.CompletedProcess:
        return subprocess.run([sys.executable, "-m", "mypy", "--config-file", source / "pyproject.toml", "--cache-dir",
                               cache, path], capture_output=True, text=True, cwd=source / "python")

    return check


def test_types_are_complete(checked: Callable[[Path], subprocess.CompletedProcess], source: Path):
    mypy = checked(source / "python/condyle")
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


def public_members(value: object) -> list[tuple[str, object]]:
    """What of a class people call or read: methods, properties, fields."""
    found = []
    for of in type.mro(value):
        if of.__module__.startswith("condyle"):
            found += [(name, each) for name, each in vars(of).items() if not name.startswith("_") or name in CALLED]
    return found


CALLED = ("__init__", "__getitem__", "__iter__", "__len__")
NOT_THERE = {"pandas": SimpleNamespace(DataFrame=object), "xarray": SimpleNamespace(Dataset=object)}


def hints(of: object) -> dict[str, object]:
    """The types of a function or of the fields of a class."""
    of = getattr(of, "__func__", of)
    of = of.fget if isinstance(of, property) else of
    return typing.get_type_hints(of, localns=NOT_THERE) if isinstance(of, type) or callable(of) else {}


def has_any(kind: object) -> bool:
    """Whether Any stands in a type, but for what numpy leaves open of an array's shape and takes as an array."""
    if kind is typing.Any:
        return True
    if typing.get_origin(kind) is np.ndarray:
        return typing.get_args(typing.get_args(kind)[1])[0] is typing.Any
    if typing.get_origin(kind) is typing.Literal:
        return False
    of_arrays = typing.get_args(ArrayLike) if typing.get_origin(kind) is typing.Union else ()
    return any(has_any(each) for each in parts_of(kind) if each not in of_arrays)


def parts_of(kind: object) -> list[object]:
    """The types that a type is made of; arguments of a callable are a list."""
    return [part for each in typing.get_args(kind) for part in (each if isinstance(each, list) else [each])]


def signatures(module: types.ModuleType) -> Iterator[tuple[str, object]]:
    for name in module.__all__:
        value = getattr(module, name)
        if isinstance(value, type) and value.__module__.startswith("condyle"):
            yield name, value
            yield from ((f"{name}.{member}", each) for member, each in public_members(value))
        elif callable(value) and getattr(value, "__module__", "").startswith("condyle"):
            yield name, value


@pytest.mark.parametrize("module", (condyle, condyle.plot), ids=lambda module: module.__name__)
def test_no_public_signature_says_any(module: types.ModuleType):
    assert has_any(dict[str, typing.Any]) and not has_any(dict[str, NDArray[np.float64]])
    checked = 0
    for name, value in signatures(module):
        for what, kind in hints(value).items():
            if not what.startswith("_"):
                checked += 1
                assert not has_any(kind), f"{name}: {what}: {kind}"
    assert checked > 40


def words_of(kind: object) -> set[str]:
    """Words of a Literal wherever it stands in a type."""
    if typing.get_origin(kind) is typing.Literal:
        return set(typing.get_args(kind))
    return set().union(*map(words_of, parts_of(kind)))


def test_arguments_that_take_words_are_of_literals():
    lists = [set(typing.get_args(each)) for each in vars(condyle._words).values() if typing.get_origin(each) is typing.Literal]
    found = []
    for name, value in signatures(condyle):
        for what, kind in hints(value).items():
            words = words_of(kind)
            owner = getattr(condyle, name.split(".")[0], None)
            is_of_record = isinstance(owner, type) and issubclass(owner, condyle.Record)  # written from the enums
            if words and what != "centre" and not name.startswith("ContactWitness") and not is_of_record:
                assert any(words <= each for each in lists), f"{name}: {what}: {words}"
                found.append(f"{name}.{what}")
    assert {"Joint.penetration.method", "Joint.__init__.side", "Limit.reason", "DescribedJoint.kind",
            "RadialTable.__init__.map"} - {"DescribedJoint.kind"} <= set(found)


USER = '''
import numpy as np
import condyle

joint = condyle.read_joint("hip.toml")
reveal_type(joint.penetration(joint.pose(flexion_deg=90)))
reveal_type(joint.penetration(joint.pose(flexion_deg=[0, 90])))
reveal_type(joint.penetration(joint.pose(flexion_deg=np.arange(3)), "normal"))
reveal_type(joint.depths({"flexion_deg": 140}))
reveal_type(joint.depths({"flexion_deg": [130, 140]}))
reveal_type(joint.in_contact(joint.motion("gait.mot").X_FM))
reveal_type(joint.coordinates(joint.pose(flexion_deg=90)))
reveal_type(joint.pairs([np.eye(4), np.eye(4)]))
reveal_type(joint.range_of_motion()["flexion"].reason)
reveal_type(condyle.sagittal_clock().hour_of([1, 0, 0]))
joint.penetration({"flexion_deg": 90}, "radail")
'''
REVEALED = ["Penetration", "Penetrations", "list[NormalContact]", "Depths", "list[Depths]",
            "ndarray[Any, dtype[bool_]]", "dict[str, float]", "list[ndarray[Any, dtype[unsignedinteger[_32Bit]]]]",
            "Union[Literal['contact'], Literal['end_of_range'], Literal['contact_at_start'], Literal['ligament'], Literal['strained_at_start']]", "float"]


def test_a_checker_distinguishes_one_pose_from_many_and_finds_a_wrong_word(checked: Callable[[Path], subprocess.CompletedProcess], tmp_path: Path):
    (tmp_path / "user.py").write_text(USER)
    said = checked(tmp_path / "user.py").stdout
    revealed = re.findall(r'Revealed type is "(.*)"', said)
    assert [re.sub(r"\b(?:[a-z_]\w*\.)+", "", each) for each in revealed] == REVEALED, said
    wrong, = re.findall(r"user.py:(\d+): error: .*\[call-overload\]", said)
    assert "radail" in USER.splitlines()[int(wrong) - 1]


def imports_of(path: Path) -> set[str]:
    """Modules of the same folder that a file imports, for a checker of types too."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom) and node.level == 1:
            found |= {alias.name for alias in node.names} if node.module is None else {node.module}
    return {name for name in found if (path.parent / f"{name}.py").is_file() and name != path.stem}


@pytest.mark.parametrize("folder", ("condyle", "condyle/plot"))
def test_no_modules_import_each_other_in_a_ring(source: Path, folder: str):
    rest = {path.stem: imports_of(path) for path in (source / "python" / folder).glob("*.py")}
    assert len(rest) > 10
    while free := {name for name, imported in rest.items() if not imported & rest.keys()}:
        rest = {name: imported for name, imported in rest.items() if name not in free}
    assert not rest, f"a ring, and what needs it: {rest}"
