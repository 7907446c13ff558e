"""Many joints of one table."""

from __future__ import annotations

import csv
import hashlib
import json
import math
import os
from dataclasses import dataclass
from itertools import dropwhile
from pathlib import Path as FilePath
from typing import Any, Iterator, Mapping, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._answer import html_of
from ._errors import FileError, UsageError
from ._pressure import ElasticLayer
from ._words import Path, Progress, count, number, number_array, path_of, progress_of, text_of, word

MOST_HIPS = 10_000_000
_LAYER = ("youngs_modulus_mpa", "poisson_ratio", "thickness_mm")


@dataclass(frozen=True, eq=False, repr=False)
class StudyTable(Mapping[str, NDArray[Any]]):
    """A table of a study: `columns` by name, (N,) float64 or str each; `units` and `meanings` by the same names.

    A number that is not there is NaN, a text that is not there is "".
    """

    columns: Mapping[str, NDArray[Any]]
    units: Mapping[str, str]
    meanings: Mapping[str, str]

    def __getitem__(self, column: str) -> NDArray[Any]:
        return self.columns[column]

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __len__(self) -> int:
        return len(self.columns)

    @property
    def rows(self) -> int:
        """How many there are."""
        return len(next(iter(self.columns.values())))

    def __repr__(self) -> str:
        return f"StudyTable({self.rows} rows; {', '.join(self.columns)})"

    def to_dataframe(self) -> Any:
        """A column per column. Needs pandas."""
        import pandas

        return pandas.DataFrame(dict(self.columns))


@dataclass(frozen=True)
class StudyLoad:
    """Contact pressure that :func:`run_study` asks for, in columns `load_...` of `hips`.

    Attributes
    ----------
    at : str
        The pose, such as "flexion=30"; the reference pose if empty.
    force_n : (3,) array, optional
        On the femur, anterior, superior, lateral: it is moved to where the contact carries this force. The pose
        itself if not given.
    free_directions : (K, 3) array, optional
        Directions of the same components that it may be translated in; all if not given.
    layer : ElasticLayer, optional
        On both bodies, of one thickness; those of each joint's file if not given.
    casting : {"both", "fixed", "mobile"}, optional
        The body whose surface is cast; as each joint's file says if not given, else both.
    rule : {"cut_faces", "face_centre"}, optional
    reach_mm : float, optional
    law : {"linear", "logarithmic"}, optional
        As of :class:`ElasticContact`; as each joint's file says if not given.
    """

    at: str = ""
    force_n: Optional[ArrayLike] = None
    layer: Optional[ElasticLayer] = None
    casting: Optional[str] = None
    free_directions: Optional[ArrayLike] = None
    rule: Optional[str] = None
    reach_mm: Optional[float] = None
    law: Optional[str] = None

    def _checked(self) -> dict[str, Any]:
        if self.layer is not None and not isinstance(self.layer, ElasticLayer):
            raise UsageError(f"layer: an ElasticLayer is needed, not {type(self.layer).__name__}")
        force = np.empty(0)
        if self.force_n is not None:
            force = number_array(self.force_n, "force_n", "three numbers")
            if force.shape != (3,):
                raise UsageError("force_n: three numbers are needed")
        free = np.empty((0, 3))
        if self.free_directions is not None:
            if self.force_n is None:
                raise UsageError("free_directions: needs force_n")
            free = np.atleast_2d(number_array(self.free_directions, "free_directions", "directions (K, 3)"))
            if free.ndim != 2 or free.shape[1] != 3:
                raise UsageError("free_directions: directions (K, 3) are needed")
        layers = {name: [] if self.layer is None else [number(getattr(self.layer, name), name)] for name in _LAYER}

        def one_of(given: Optional[str], name: str, *known: str) -> Optional[str]:
            return None if given is None else word(given, name, known)

        return {"at": text_of(self.at, "at"), "force_n": force.tolist(), "free_directions": free.tolist(), **layers,
                "casting": one_of(self.casting, "casting", "both", "fixed", "mobile"),
                "rule": one_of(self.rule, "rule", "cut_faces", "face_centre"),
                "reach_mm": None if self.reach_mm is None else number(self.reach_mm, "reach_mm"),
                "law": one_of(self.law, "law", "linear", "logarithmic")}


@dataclass(frozen=True, eq=False, repr=False)
class Study:
    """The results of a study, as :func:`read_study` gives them.

    Attributes
    ----------
    limits : StudyTable
        A row per joint and motion, in the order of the table.
    hips : StudyTable
        A row per joint.
    failures : StudyTable
        A row per joint that could not be answered, with `exit_code` and `message`.
    options : mapping
        What was asked, as in study.json.
    """

    limits: StudyTable
    hips: StudyTable
    failures: StudyTable
    options: Mapping[str, Any]

    def __repr__(self) -> str:
        motions = len(set(self.limits["motion"].tolist()))
        return f"Study({self.hips.rows} joints, {self.failures.rows} failures, {motions} motions)"

    def _repr_html_(self) -> str:
        return html_of("study", [("joints", str(self.hips.rows)), ("failures", str(self.failures.rows)),
                                 ("motions", ", ".join(dict.fromkeys(self.limits["motion"].tolist())))])

    def to_dataframe(self) -> Any:
        """`limits` with the columns of `hips` beside, a row per joint and motion. Needs pandas."""
        limits, hips = self.limits.to_dataframe(), self.hips.to_dataframe()
        more = [name for name in hips.columns if name not in limits.columns]
        return limits.merge(hips[["id", *more]], on="id", how="left", validate="many_to_one")


def _number(field: str) -> float:
    return float(field) if field else math.nan


def _text_of(folder: FilePath, name: str) -> str:
    try:
        return (folder / name).read_bytes().decode("utf-8", "surrogateescape")
    except OSError as error:
        raise FileError(f"{folder / name}: {error.strerror or error}") from None


def _rows_of(text: str) -> list[list[str]]:
    """From the header on: comments come before it."""
    return list(csv.reader(dropwhile(lambda line: line.startswith("#"), text.splitlines())))


def _table_of(texts: Mapping[str, str], name: str, folder: FilePath) -> StudyTable:
    dictionary = [row for row in _rows_of(texts["columns.csv"])[1:] if row[0] == name]
    header, *rows = _rows_of(texts[f"{name}.csv"])
    if header != [column for _, column, *_ in dictionary] or any(len(row) != len(header) for row in rows):
        raise FileError(f"{folder / (name + '.csv')}: has other columns than columns.csv says")
    columns: dict[str, NDArray[Any]] = {}
    for i, (_, column, _, kind, _) in enumerate(dictionary):
        fields = [row[i] for row in rows]
        columns[column] = (np.array([_number(field) for field in fields], float) if kind == "number" else
                           np.array(fields, str))
    return StudyTable(columns, {row[1]: row[2] for row in dictionary}, {row[1]: row[4] for row in dictionary})


def read_study(folder: Path) -> Study:
    """Reads what `condyle study`, `condyle merge` or :func:`run_study` has written; of a shard its own folder.

    FileError where a file is missing or is not the one that study.json was written with. Linear in the tables: a
    million rows take some ten seconds.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     sample_cohort(folder, 1)
    ...     study = run_study(f"{folder}/cohort.csv", f"{folder}/study", motions=["flexion", "fadir"])
    >>> study
    Study(1 joints, 0 failures, 2 motions)
    >>> study.limits["motion"]
    array(['flexion', 'fadir'], dtype='<U7')
    >>> study.limits.units["limit_deg"]
    'deg'
    """
    place = FilePath(path_of(folder, "folder"))
    if not (place / "study.json").exists() and (place / "shards").is_dir():
        raise FileError(f"{place}: has shards only: condyle merge puts them together")
    try:
        record = json.loads(_text_of(place, "study.json"))
        digests = {name: of["sha256"] for name, of in record["files"].items()}
        options = record["options"]
    except (ValueError, KeyError, TypeError, AttributeError):
        raise FileError(f"{place / 'study.json'}: is not the record of a study") from None
    texts = {}
    for name in ("columns.csv", "limits.csv", "hips.csv", "failures.csv"):
        texts[name] = _text_of(place, name)
        if hashlib.sha256(texts[name].encode("utf-8", "surrogateescape")).hexdigest() != digests.get(name):
            raise FileError(f"{place / name}: is not the one that study.json was written with")
    return Study(_table_of(texts, "limits", place), _table_of(texts, "hips", place),
                 _table_of(texts, "failures", place), options)


def run_study(table: Path, folder: Path, *, motions: Optional[Sequence[str]] = None, band_samples: int = 0,
              seed: Optional[int] = None, depth_at: str = "", load: Optional[StudyLoad] = None,
              shard: Optional[tuple[int, int]] = None, strict: bool = False, progress: Progress = None) -> Study:
    """Answers for every row of a table of hips and writes the results: docs/cohort.md has both.

    `motions` by their names, all if not given; bands of `band_samples` displaced joints (20 or more; 0: none) by
    `seed`, that of each joint's file, else 1, if not given; how deep the bones are in each other in the pose
    `depth_at`, such as "flexion=90 internal_rotation=30"; contact pressure by `load`; `shard` (3, 7) is the third of
    seven parts, which :func:`merge_study` puts together. What lies there of the same inputs, options and version is
    not computed again. A hip that cannot be answered is a row of `failures`; with `strict` its error is raised, and a
    MeshError for one with which something looks wrong (`notes` in `hips`).

    C++: `condyle::run_study` in condyle/io/study.hpp; `condyle study`.
    """
    part = None
    if shard is not None:
        if not isinstance(shard, (tuple, list)) or len(shard) != 2:
            raise UsageError("shard: a number and how many there are, such as (3, 7)")
        of = count(shard[1], "shard", 1, 1_000_000)
        part = count(shard[0], "shard", 1, of), of
    if isinstance(motions, str):
        raise UsageError("motions: a list of names is needed, not a text")
    names = [] if motions is None else list(motions)
    if not all(isinstance(name, str) for name in names) or not isinstance(depth_at, str):
        raise UsageError("motions and depth_at are texts")
    if load is not None and not isinstance(load, StudyLoad):
        raise UsageError(f"load: a StudyLoad is needed, not {type(load).__name__}")
    out = path_of(folder, "folder")
    _native.run_study(path_of(table, "table"), out, names, count(band_samples, "band_samples", high=100_000),
                      None if seed is None else count(seed, "seed", high=2**64 - 1), depth_at,
                      None if load is None else load._checked(), part, bool(strict), progress_of(progress))
    return read_study(out if part is None else os.path.join(out, "shards", f"{part[0]}_of_{part[1]}"))


def merge_study(folder: Path) -> Study:
    """Puts the shards below a folder together: the same bytes as of one run. FileError where one is missing.

    C++: `condyle::merge_study` in condyle/io/study.hpp; `condyle merge`.
    """
    out = path_of(folder, "folder")
    _native.merge_study(out)
    return read_study(out)


def sample_cohort(folder: Path, n: int, *, seed: int = 1, scenario: int = 1, meshes: bool = False,
                  progress: Progress = None) -> None:
    """Draws `n` hips from stated distributions: writes `cohort.csv`, a table for a study, and `cohort.json`.

    With `meshes` each hip's meshes and joint file too, a second or more each; without, the study makes each hip of its
    measures. Hip k of a seed is the same whatever `n`. Distributions: docs/cohort.md.

    C++: `condyle::write_sample_cohort` in condyle/io/sample_files.hpp; `condyle sample cohort`.
    """
    _native.sample_cohort(path_of(folder, "folder"), count(n, "n", 1, MOST_HIPS),
                          count(seed, "seed", high=2**64 - 1), count(scenario, "scenario", 1, 4), bool(meshes),
                          progress_of(progress))
