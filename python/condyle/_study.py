"""Many joints of one table."""

from __future__ import annotations

import hashlib
import json
import math
import os
from dataclasses import dataclass
from itertools import dropwhile
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any, Iterator, Mapping, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._answer import html_of
from ._csv_text import plain_field
from ._contact_checks import kind_of
from ._errors import FileError, UsageError, unknown, warn
from ._pressure import ElasticLayer
from ._resection import Reach, cut_options, reach_of
from ._words import Anatomy, BearingRule, Bodies, CutFrom, FaceRule, Path, PressureLaw, Progress, band_of, count, number, number_array
from ._words import path_of, progress_of, text_of, word

if TYPE_CHECKING:
    import pandas

#: Numbers, or texts as objects.
Column = Union[NDArray[np.float64], NDArray[np.object_]]

MOST_HIPS = 10_000_000
_LAYER = ("youngs_modulus_mpa", "poisson_ratio", "thickness_mm")


@dataclass(frozen=True, eq=False, repr=False)
class StudyTable(Mapping[str, Column]):
    """A table of a study: `columns` by name, (N,) each; `units` and `meanings` by the same names.

    Numbers are float64, one that is not there NaN; texts are str in arrays of objects, one that is not there "".
    """

    columns: Mapping[str, Column]
    units: Mapping[str, str]
    meanings: Mapping[str, str]

    def __getitem__(self, column: str) -> Column:
        if column not in self.columns:
            raise unknown("column", column, self.columns)
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

    def to_dataframe(self) -> pandas.DataFrame:
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
        On the mobile body, anterior, superior, lateral: it is moved to where the contact carries this force. The pose
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
    casting: Optional[Bodies] = None
    free_directions: Optional[ArrayLike] = None
    rule: Optional[FaceRule] = None
    reach_mm: Optional[float] = None
    law: Optional[PressureLaw] = None

    def _checked(self) -> dict[str, Any]:
        if self.layer is not None and not isinstance(self.layer, ElasticLayer):
            raise UsageError(f"layer: an ElasticLayer is needed, not {type(self.layer).__name__}")
        force: NDArray[np.float64] = np.empty(0)
        if self.force_n is not None:
            force = number_array(self.force_n, "force_n", "three numbers")
            if force.shape != (3,):
                raise UsageError("force_n: three numbers are needed")
        free: NDArray[np.float64] = np.empty((0, 3))
        if self.free_directions is not None:
            if self.force_n is None:
                raise UsageError("free_directions: needs force_n")
            free = np.atleast_2d(number_array(self.free_directions, "free_directions", "directions (K, 3)"))
            if free.ndim != 2 or free.shape[1] != 3:
                raise UsageError("free_directions: directions (K, 3) are needed")
        layers = {name: [] if self.layer is None else [number(getattr(self.layer, name), name)] for name in _LAYER}

        def one_of(given: Optional[str], name: str, words: object) -> Optional[str]:
            return None if given is None else word(given, name, words)

        return {"at": text_of(self.at, "at"), "force_n": force.tolist(), "free_directions": free.tolist(), **layers,
                "casting": one_of(self.casting, "casting", Bodies),
                "rule": one_of(self.rule, "rule", FaceRule),
                "reach_mm": None if self.reach_mm is None else number(self.reach_mm, "reach_mm"),
                "law": one_of(self.law, "law", PressureLaw)}


@dataclass(frozen=True)
class StudyResection:
    """The bone that must go, which :func:`run_study` finds for each joint: columns `resect_...` of `hips`, and limits
    without it.

    Attributes
    ----------
    reach : mapping of motions to degrees, or to gains as "+10"
    cut, share, margin_mm, deepest_mm, within_mm, burr_mm, edge_mm
        As :meth:`Joint.resection` takes them.
    """

    reach: Reach
    cut: CutFrom = "mobile"
    share: Optional[float] = None
    margin_mm: float = 0
    deepest_mm: Optional[float] = None
    within_mm: Optional[float] = None
    burr_mm: Optional[float] = None
    edge_mm: float = 0.5

    def _checked(self) -> dict[str, Any]:
        return {"reach": reach_of(self.reach), **cut_options(self.cut, self.share, self.margin_mm, self.deepest_mm, self.within_mm,
                                                             self.burr_mm, self.edge_mm)}


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
        The request, as in study.json.
    """

    limits: StudyTable
    hips: StudyTable
    failures: StudyTable
    options: Mapping[str, object]

    def __repr__(self) -> str:
        motions = len(set(self.limits["motion"]))
        return f"Study({self.hips.rows} joints, {self.failures.rows} failures, {motions} motions)"

    def _repr_html_(self) -> str:
        return html_of("study", [("joints", str(self.hips.rows)), ("failures", str(self.failures.rows)),
                                 ("motions", ", ".join(dict.fromkeys(self.limits["motion"])))])

    def to_dataframe(self) -> pandas.DataFrame:
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
    # The last line ends with a line end, too. Only that character ends a line: a name may hold others that Python counts.
    return [_fields_of(line) for line in dropwhile(lambda line: line.startswith("#"), text.split("\n")[:-1])]


def _fields_of(line: str) -> list[str]:
    """As the tables are written, RFC 4180 without line ends in fields; of any length, where Python's csv has a bound."""
    if '"' not in line:
        return [plain_field(each) for each in line.split(",")]
    fields: list[str] = []
    is_open = False
    for part in line.split(","):
        if is_open:
            fields[-1] += "," + part
        else:
            fields.append(part)
        is_open ^= part.count('"') % 2 == 1
    return [plain_field(each[1:-1].replace('""', '"') if each.startswith('"') else each) for each in fields]


def _table_of(texts: Mapping[str, str], name: str, folder: FilePath) -> StudyTable:
    dictionary = [row for row in _rows_of(texts["columns.csv"])[1:] if row[0] == name]
    if any(len(row) != 5 for row in dictionary):
        raise FileError(f"{folder / 'columns.csv'}: a column of {name}.csv has not 5 fields")
    header, *rows = _rows_of(texts[f"{name}.csv"]) or [[]]
    if header != [column for _, column, *_ in dictionary] or any(len(row) != len(header) for row in rows):
        raise FileError(f"{folder / (name + '.csv')}: has other columns than columns.csv says")
    columns: dict[str, Column] = {}
    for i, (_, column, _, kind, _) in enumerate(dictionary):
        fields = [row[i] for row in rows]
        try:
            # Objects: in an array of fixed length each text would be as long as the longest.
            columns[column] = (np.array([_number(field) for field in fields], float) if kind == "number" else
                               np.array(fields, object))
        except ValueError:
            raise FileError(f"{folder / (name + '.csv')}: column '{column}': a field is not a number") from None
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
    array(['flexion', 'fadir'], dtype=object)
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
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise FileError(f"{place / 'study.json'}: is not the record of a study") from None
    texts = {}
    for name in ("columns.csv", "limits.csv", "hips.csv", "failures.csv"):
        texts[name] = _text_of(place, name)
        if hashlib.sha256(texts[name].encode("utf-8", "surrogateescape")).hexdigest() != digests.get(name):
            raise FileError(f"{place / name}: is not the one that study.json was written with")
    return Study(_table_of(texts, "limits", place), _table_of(texts, "hips", place),
                 _table_of(texts, "failures", place), options)


Axis = Mapping[str, Sequence[float]]


def _axis(given: Any, what: str) -> str:
    """As the command's --map has it, "flexion=0:120:5"."""
    if not isinstance(given, Mapping) or len(given) != 1:
        raise UsageError(f'{what}: one angle with first, last and step is needed: {{"flexion": (0, 120, 10)}}')
    (name, values), = given.items()
    if not isinstance(values, (tuple, list)) or len(values) not in (2, 3):
        raise UsageError(f"{what}: first, last and step are needed")
    return f"{text_of(name, what)}={':'.join(repr(number(value, what)) for value in values)}"


def _grid(given: Any, vary: Optional[str]) -> Optional[tuple[str, str, Optional[str]]]:
    if given is None:
        if vary is not None:
            raise UsageError("vary: is for map")
        return None
    if not isinstance(given, (tuple, list)) or len(given) != 2:
        raise UsageError('map: two angles are needed: ({"flexion": (0, 120, 5)}, {"adduction": (-30, 30, 5)})')
    return _axis(given[0], "map"), _axis(given[1], "map"), None if vary is None else text_of(vary, "vary")


def _warn_of(noted: Sequence[tuple[str, str]]) -> None:
    for joint, codes in noted:
        warn(f"{joint}: {codes}", kind_of(codes.split()))


def run_study(table: Path, folder: Path, *, motions: Optional[Sequence[str]] = None, anatomy: Anatomy = "hip",
              bearing: BearingRule = "leave_out", bearing_margin_mm: Optional[float] = None,
              accept_reference_contact: bool = False, exclude_reference_contacts: bool = False,
              map: Optional[tuple[Axis, Axis]] = None, vary: Optional[str] = None, band_samples: int = 0,
              seed: Optional[int] = None, sigma_centre_mm: Optional[float] = None,
              sigma_axes_deg: Optional[float] = None, sigma_surface_mm: Optional[float] = None, depth_at: str = "",
              load: Optional[StudyLoad] = None, follow_load: Optional[StudyLoad] = None, measures: bool = False,
              resection: Optional[StudyResection] = None, shard: Optional[tuple[int, int]] = None,
              strict: bool = False, crate_date: Optional[str] = None, progress: Progress = None) -> Study:
    """Answers for every row of a table of joints and writes the results: docs/cohort.md has both.

    Parameters
    ----------
    motions : names, optional
        All that a joint has if not given.
    anatomy : "hip", "knee", "ankle", "elbow" or "shoulder"
        The anatomy of all joints of the table.
    bearing, bearing_margin_mm, accept_reference_contact, exclude_reference_contacts
        As of :meth:`Joint.range_of_motion`.
    map : two mappings, optional
        Column and row of a map of each joint, as of :meth:`RangeOfMotion.map`: `({"flexion": (0, 120, 5)},
        {"adduction": (-30, 30, 5)})`; `vary` is the third angle if not given.
    band_samples : int
        For bands of so many varied joints (20 or more; 0: none), by `seed` and the standard deviations `sigma_...`;
        those not given are those of each joint's file, else 1, 0.5 mm, 1 degree and 0.25 mm.
    depth_at : str
        How deep the bodies are in each other in this pose, such as "flexion=90 internal_rotation=30".
    load : StudyLoad, optional
        Contact pressure.
    follow_load : StudyLoad, optional
        The centre of free joints is not held: at each angle the contact carries this `force_n`. Limits are bounded then, not exact,
        as those of rows whose column `follow` names a recorded motion: :meth:`Joint.range_following`.
    measures : bool
        The shape of each hip, as of :meth:`Joint.measures`, in columns `measured_...` of `hips`; with bands if `band_samples` says
        so. The pelvis is tilted forwards by the table's column `pelvic_tilt_deg`.
    resection : StudyResection, optional
        The bone that must go so that motions reach their targets, and limits without it.
    shard : (number, of), optional
        (3, 7) is the third of seven parts, which :func:`merge_study` puts together.
    strict : bool
        A joint that cannot be answered raises its error, and MeshError one with which something looks wrong.
    crate_date : str, optional
        A day, "2026-01-31": `ro-crate-metadata.json` is written too, with this date. Not of a shard.

    Results there of the same inputs, options and version are not computed again. Without `strict` a joint that cannot
    be answered is a row of `failures`, and one with which something looks wrong (`notes` in `hips`) is warned of,
    :class:`JointWarning`, or :class:`JointRemark` if only its limits have notes. Where no joint could be answered, the
    error of the first one is raised once the files are written; not of a shard.

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
    if resection is not None and not isinstance(resection, StudyResection):
        raise UsageError(f"resection: a StudyResection is needed, not {type(resection).__name__}")
    if follow_load is not None and not isinstance(follow_load, StudyLoad):
        raise UsageError(f"follow_load: a StudyLoad is needed, not {type(follow_load).__name__}")
    if follow_load is not None and (follow_load.force_n is None or follow_load.at):
        raise UsageError("follow_load: needs force_n, and no pose: the motions have them")
    band = band_of(band_samples, seed, sigma_centre_mm, sigma_axes_deg, sigma_surface_mm)
    for name, given in (("seed", seed), ("sigma_centre_mm", sigma_centre_mm), ("sigma_axes_deg", sigma_axes_deg),
                        ("sigma_surface_mm", sigma_surface_mm)):
        if given is not None and band is None:
            raise UsageError(f"{name}: is for band_samples")
    options = {
        "anatomy": word(anatomy, "anatomy", Anatomy), "motions": names,
        "count_bearing": word(bearing, "bearing", BearingRule) == "count",
        "bearing_margin_mm": None if bearing_margin_mm is None else number(bearing_margin_mm, "bearing_margin_mm"),
        "accept_reference_contact": bool(accept_reference_contact),
        "exclude_reference_contacts": bool(exclude_reference_contacts), "map": _grid(map, vary),
        "band": band,
        "depth_at": depth_at, "load": None if load is None else load._checked(),
        "follow_load": None if follow_load is None else follow_load._checked(),
        "measures": bool(measures), "resection": None if resection is None else resection._checked()}
    out = path_of(folder, "folder")
    _warn_of(_native.run_study(path_of(table, "table"), out, options, part, bool(strict),
                               None if crate_date is None else text_of(crate_date, "crate_date"), progress_of(progress)))
    return read_study(out if part is None else os.path.join(out, "shards", f"{part[0]}_of_{part[1]}"))


def merge_study(folder: Path, *, crate_date: Optional[str] = None) -> Study:
    """Puts the shards below a folder together: the same bytes as of one run. FileError where one is missing.

    Warns, and raises where no joint was answered, as :func:`run_study` of all rows does; `crate_date` as there.

    C++: `condyle::merge_study` in condyle/io/study.hpp; `condyle merge`.
    """
    out = path_of(folder, "folder")
    _warn_of(_native.merge_study(out, None if crate_date is None else text_of(crate_date, "crate_date")))
    return read_study(out)


def sample_cohort(folder: Path, n: int, *, seed: int = 1, scenario: int = 1, meshes: bool = False,
                  progress: Progress = None) -> None:
    """Draws `n` hips from stated distributions: writes `cohort.csv`, a table for a study, and `cohort.json`.

    With `meshes` each hip's meshes and joint file too, a second or more each; without, the study makes each hip of its
    measures. Hip k of a seed is the same whatever `n`. Distributions: docs/cohort.md.

    C++: `condyle::write_sample_cohort` in io/result/sample_files.hpp; `condyle sample cohort`.
    """
    _native.sample_cohort(path_of(folder, "folder"), count(n, "n", 1, MOST_HIPS),
                          count(seed, "seed", high=2**64 - 1), count(scenario, "scenario", 1, 4), bool(meshes),
                          progress_of(progress))
