"""Two meshes without a joint: whether they touch, how deep, and how one gets free of the other."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Generic, Optional, Sequence, TypeVar, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._errors import JointWarning, unknown, warn
from ._mesh import MeshLike, TriMesh, read_mesh
from ._pressure import ManyMatrices, OneMatrix
from ._record import Record, row_of
from ._records import SlideRecord, TouchRecord, TurnRecord
from ._words import Path, Progress, progress_of

if TYPE_CHECKING:
    import pandas

MeshOrPath = Union[MeshLike, Path]
AnyRecord = TypeVar("AnyRecord", bound=Record)
Numbers = Union[NDArray[np.float64], NDArray[np.bool_]]


class Answers(Sequence[AnyRecord], Generic[AnyRecord]):
    """One record for each of many poses, in their order; `answers["depth_mm"]` is that number of each as an array.

    A number within a record has both keys: `answers["deepest.depth_mm"]`. NaN where a pose has none.
    """

    def __init__(self, records: list[AnyRecord]) -> None:
        self._records = records

    @overload
    def __getitem__(self, key: int) -> AnyRecord: ...

    @overload
    def __getitem__(self, key: slice) -> Answers[AnyRecord]: ...

    @overload
    def __getitem__(self, key: str) -> Numbers: ...

    def __getitem__(self, key: Union[int, slice, str]) -> Union[AnyRecord, Answers[AnyRecord], Numbers]:
        if isinstance(key, slice):
            return Answers(self._records[key])
        if not isinstance(key, str):
            return self._records[key]
        values = [record[key] for record in self._records]
        if all(isinstance(value, bool) for value in values):
            return np.array(values, dtype=bool)
        known = next((value for value in values if value is not None), np.nan)
        if not isinstance(known, (int, float, np.ndarray)):
            raise unknown("number", key, [name for name in known] if isinstance(known, Record) else [])
        none = np.full(np.shape(known), np.nan)
        return np.array([none if value is None else value for value in values], dtype=np.float64)

    def __len__(self) -> int:
        return len(self._records)

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each pose, columns by their keys: "deepest.depth_mm". Needs pandas."""
        import pandas

        rows = [row_of(record) for record in self._records]
        return pandas.DataFrame(rows, columns=list(dict.fromkeys(key for row in rows for key in row)))

    def __repr__(self) -> str:
        return f"Answers({len(self)} poses)"


def _meshes(a: MeshOrPath, b: MeshOrPath) -> tuple[TriMesh, TriMesh]:
    fixed, mobile = (read_mesh(mesh) if isinstance(mesh, (str, os.PathLike)) else TriMesh.of(mesh) for mesh in (a, b))
    return fixed, mobile


def _answers(record: type[AnyRecord], found: tuple[bool, list[dict[str, Any]]], fixed: TriMesh, mobile: TriMesh
             ) -> Union[AnyRecord, Answers[AnyRecord]]:
    is_one, said = found
    for each in said:
        del each["condyle"]
        for end in (each.get("negative"), each.get("positive")):
            for body, mesh in (("fixed", fixed), ("mobile", mobile)):
                if end and end["features"] and mesh._first is not None:
                    _as_given(end["features"][body], mesh._first)
    records = [record.of(each) for each in said]
    for code, text in dict.fromkeys((note["code"], note["text"]) for each in said for note in each["notes"]):
        warn(f"{code}: {text}", JointWarning)
    return records[0] if is_one else Answers(records)


def _as_given(feature: dict[str, Any], first: NDArray[np.uint32]) -> None:
    """A feature by the numbers that vertices had before they were merged."""
    if feature["kind"] == "vertex":
        feature["id"] = int(first[feature["id"]])
    elif feature["kind"] == "edge":
        feature["vertices"] = sorted(int(first[vertex]) for vertex in feature["vertices"])


@overload
def touch(a: MeshOrPath, b: MeshOrPath, pose: OneMatrix = ..., *, along: ArrayLike = ..., measures: bool = ...,
          centre: Optional[ArrayLike] = ..., progress: Progress = ...) -> TouchRecord: ...


@overload
def touch(a: MeshOrPath, b: MeshOrPath, pose: ManyMatrices, *, along: ArrayLike = ..., measures: bool = ...,
          centre: Optional[ArrayLike] = ..., progress: Progress = ...) -> Answers[TouchRecord]: ...


def touch(a: MeshOrPath, b: MeshOrPath, pose: ArrayLike = np.eye(4), *, along: ArrayLike = (), measures: bool = False,
          centre: Optional[ArrayLike] = None, progress: Progress = None) -> Union[TouchRecord, Answers[TouchRecord]]:
    """Whether two meshes touch, and how deep: the answer of `condyle touch`, by its keys.

    Parameters
    ----------
    a, b : mesh
        The one that stays and the one that moves, each a :class:`TriMesh`, what :meth:`TriMesh.of` takes, or the path of a file.
    pose : (4, 4), or (N, 4, 4) for :class:`Answers`
        Where `b` is in the frame of `a`; the identity if not given.
    along : (K, 3)
        Directions in the frame of `a`, of any length but zero, along which `b` is moved until it is free.
    measures : bool
        Penetration volume and areas too, which take longer than the rest.
    centre : (3,), optional
        A joint centre in the frame of `a`: then `ray_depth_mm` is how deep along rays from there, as `condyle depth` measures.

    Each note of the answer is a :class:`JointWarning` too, once for all poses. A number has the same spelling of one pose and of many:
    `answer["deepest.depth_mm"]`; `to_dataframe()` has a row for each.

    C++: `condyle::answer_touch` in condyle/answer/depth.hpp.

    >>> import numpy as np
    >>> import condyle
    >>> box = condyle.TriMesh([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)],
    ...                       [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
    ...                        [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])
    >>> X = np.eye(4)
    >>> X[:3, 3] = 0.25, 0.25, 0.875
    >>> answer = condyle.touch(box, box, X, along=[[0, 0, 1]], measures=True)
    >>> answer.in_contact, answer.deepest.depth_mm, round(answer.free[0].distance_mm, 9), round(answer.volume_mm3, 9)
    (True, 0.125, 0.125, 0.0703125)
    >>> X[2, 3] = 1.5
    >>> condyle.touch(box, box, [X])["nearest_distance_mm"]
    array([0.5])
    """
    fixed, mobile = _meshes(a, b)
    directions = np.reshape(np.asarray(along), (0, 3)) if np.size(along) == 0 else along
    found = _native.touch(fixed._native, mobile._native, pose, directions, bool(measures), centre,
                          progress_of(progress))
    return _answers(TouchRecord, found, fixed, mobile)


@overload
def turn(a: MeshOrPath, b: MeshOrPath, axis: ArrayLike, centre: ArrayLike = ..., pose: OneMatrix = ..., *,
         progress: Progress = ...) -> TurnRecord: ...


@overload
def turn(a: MeshOrPath, b: MeshOrPath, axis: ArrayLike, centre: ArrayLike, pose: ManyMatrices, *,
         progress: Progress = ...) -> Answers[TurnRecord]: ...


def turn(a: MeshOrPath, b: MeshOrPath, axis: ArrayLike, centre: ArrayLike = (0, 0, 0), pose: ArrayLike = np.eye(4), *,
         progress: Progress = None) -> Union[TurnRecord, Answers[TurnRecord]]:
    """Where `b`, which turns about an axis, meets `a`: first contact both ways and all free intervals of a whole turn.

    `axis` (3,), of any length but zero, and `centre` (3,), a point on it, are in the frame of `a`; the rest as in
    :func:`touch`.
    C++: `condyle::answer_turn`.

    >>> import condyle
    >>> hip = condyle.sample_hip()
    >>> answer = condyle.turn(hip.hip_bone, hip.femur, [0, 0, 1])
    >>> answer.free_at_start, answer.positive.reason
    (True, 'contact')
    """
    fixed, mobile = _meshes(a, b)
    found = _native.turn(fixed._native, mobile._native, axis, centre, pose, progress_of(progress))
    return _answers(TurnRecord, found, fixed, mobile)


@overload
def slide(a: MeshOrPath, b: MeshOrPath, along: ArrayLike, pose: OneMatrix = ..., *, progress: Progress = ...
          ) -> SlideRecord: ...


@overload
def slide(a: MeshOrPath, b: MeshOrPath, along: ArrayLike, pose: ManyMatrices, *, progress: Progress = ...
          ) -> Answers[SlideRecord]: ...


def slide(a: MeshOrPath, b: MeshOrPath, along: ArrayLike, pose: ArrayLike = np.eye(4), *, progress: Progress = None
          ) -> Union[SlideRecord, Answers[SlideRecord]]:
    """Where `b`, which slides along a direction, meets `a`: first contact both ways and all positions where it is free.

    `along` (3,), of any length but zero, is in the frame of `a`; the rest as in :func:`touch`.
    C++: `condyle::answer_slide`.

    >>> import condyle
    >>> hip = condyle.sample_hip()
    >>> answer = condyle.slide(hip.hip_bone, hip.femur, [0, 0, -1])
    >>> answer.free_at_start, round(answer.positive.moved_mm, 6) > 0
    (True, True)
    """
    fixed, mobile = _meshes(a, b)
    found = _native.slide(fixed._native, mobile._native, along, pose, progress_of(progress))
    return _answers(SlideRecord, found, fixed, mobile)
