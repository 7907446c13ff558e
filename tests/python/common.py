"""The command, which has the same answers; what it wrote; meshes and joint files that several tests make."""

from __future__ import annotations

import base64
import csv
import json
import os
import re
import subprocess
import threading
import warnings
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import condyle

FREE = 'kind = "free"\njoint = "hip"'
COMMAND = os.environ.get("CONDYLE_COMMAND", "condyle")


def run_command(*words: object, check: bool = True, **how: Any) -> subprocess.CompletedProcess[str]:
    return subprocess.run([COMMAND, *map(str, words)], check=check, capture_output=True, text=True, **how)


def json_of_command(*words: object) -> Any:
    return json.loads(run_command(*words, "--json").stdout)


def rows_of(path: Path) -> list[dict[str, str]]:
    """Those of a table, without its comments."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def text_of(path: Path) -> Any:
    """The data block of a report."""
    data = zlib.decompress(base64.b64decode(re.search(r'id="condyle-data">([^<]*)<', path.read_text()).group(1)))
    return json.loads(data[16:16 + int.from_bytes(data[12:16], "little")])


def refused(act: Any, words: str = "", kind: type[Exception] = condyle.UsageError) -> str:
    """The line, in which a pattern is found."""
    with pytest.raises(kind, match=words) as raised:
        act()
    line = str(raised.value)
    assert "\n" not in line and line
    return line


def warnings_of(act: Any) -> list[warnings.WarningMessage]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        act()
    return [each for each in caught if issubclass(each.category, condyle.JointWarning)]


def box(low: Any, high: Any) -> condyle.TriMesh:
    corners = np.array([[(low, high)[i >> k & 1][k] for k in range(3)] for i in range(8)], float)
    quads = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    return condyle.TriMesh(corners, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def at_once(count: int, act: Any) -> None:
    """In threads."""
    threads = [threading.Thread(target=act) for _ in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])


def soup(mesh: condyle.TriMesh) -> tuple[np.ndarray, np.ndarray]:
    """Each triangle with corners of its own, as STL files have them."""
    return mesh.vertices[mesh.triangles].reshape(-1, 3), np.arange(3 * len(mesh.triangles)).reshape(-1, 3)


def lifted(y_mm: float) -> np.ndarray:
    """A pose without rotation."""
    pose = np.eye(4)
    pose[1, 3] = y_mm
    return pose


def joint_file(folder: Path, more: str = "", kind: str = 'kind = "ball"', fixed: Any = None, mobile: Any = None, bodies: str = "") -> Path:
    """A right joint of two meshes, or of those that BODIES names."""
    for name, mesh in (("fixed", fixed), ("mobile", mobile)):
        if mesh is not None:
            condyle.write_mesh(folder / f"{name}.ply", mesh)
    path = folder / "hip.toml"
    path.write_text(f'condyle = 1\nname = "hip"\n{kind}\nside = "right"\nunits = "mm"\n'
                    + (bodies or 'fixed = { mesh = "fixed.ply" }\nmobile = { mesh = "mobile.ply" }\n')
                    + f'frame = {{ centre = [0, 0, 0], anterior = [1, 0, 0], superior = [0, 1, 0] }}\n{more}')
    return path


def changed(hip_file: Path, folder: Path, *changes: tuple[str, str], more: str = "") -> Path:
    """A joint file of the same meshes in another folder, with the first of each text replaced and lines at its end."""
    text = hip_file.read_text().replace('mesh = "', f'mesh = "{hip_file.parent}/')
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    path = folder / "changed.toml"
    path.write_text(text + more)
    return path
