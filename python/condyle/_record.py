"""Base of the records of answers: what is said, by the keys of the files."""

from __future__ import annotations

from dataclasses import is_dataclass
from typing import TYPE_CHECKING, Any, Iterator, Mapping, NoReturn, TypeVar, get_args, get_type_hints

import numpy as np
from numpy.typing import NDArray

from ._answer import html_of
from ._errors import unknown
from ._motion import Angles, Motion

if TYPE_CHECKING:
    import pandas

AnyRecord = TypeVar("AnyRecord", bound="Record")
Value = TypeVar("Value")


def _value_of(hint: Any, said: Any) -> Any:
    """A value of JSON as the type that its hint names."""
    if said is None or isinstance(said, (str, bool)):
        return said
    if type(None) in get_args(hint):  # Optional
        return _value_of(get_args(hint)[0], said)
    if isinstance(hint, type) and issubclass(hint, Record):
        return hint.of(said)
    if hint is Angles:
        return Angles(said)
    if hint == NDArray[np.float64]:
        return np.array(said, dtype=np.float64)
    return [_value_of(get_args(hint)[0], each) for each in said] if isinstance(said, list) else said


def _is_same(one: Any, other: Any) -> bool:
    """Equality of values that may hold arrays."""
    if isinstance(one, np.ndarray):
        return isinstance(other, np.ndarray) and np.array_equal(one, other, equal_nan=True)
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(_is_same(one[key], other[key]) for key in one)
    if is_dataclass(one) and type(one) is type(other):
        return _is_same(vars(one), vars(other))
    return bool(one == other)


def columns_of(values: object) -> dict[str, object]:
    """What a record or an answer holds as a row of a table: a motion by its name, and records in it by both keys, "normal_low", as in files."""
    row: dict[str, object] = {}
    hints = _hints_of(type(values))
    for key, value in vars(values).items():
        if isinstance(value, Record):
            row.update((f"{key}_{inner}", each) for inner, each in columns_of(value).items())
        elif value is not None or not any(isinstance(each, type) and issubclass(each, Record) for each in get_args(hints.get(key))):
            row[key] = value.name if isinstance(value, Motion) else value
    return row


def row_of(record: Record, prefix: str = "") -> dict[str, object]:
    """Numbers and words of a record, and of records in it, by their keys; a point has a column for each coordinate."""
    row: dict[str, object] = {}
    for key, value in vars(record).items():
        if isinstance(value, Record):
            row.update(row_of(value, f"{prefix}{key}."))
        elif isinstance(value, np.ndarray):
            row.update((f"{prefix}{key}.{axis}", each) for axis, each in zip("xyz", value))
        elif not isinstance(value, list):
            row[prefix + key] = value
    return row


class Record:
    """A frozen record, whose values are attributes and, as in its file, have keys: `limit.closed_form["limit_deg"]`.

    `limit["closed_form.limit_deg"]` is the same, and None if there is no closed form.
    """

    @classmethod
    def of(cls: type[AnyRecord], said: Mapping[str, object]) -> AnyRecord:
        """The record that an object of JSON holds."""
        record = object.__new__(cls)
        hints = _hints_of(cls)
        vars(record).update((key, _value_of(hints[key], value)) for key, value in said.items())
        return record

    def __getitem__(self, key: str) -> object:
        value: object = self
        for part in key.split("."):
            if value is None:
                return None
            known = vars(value) if isinstance(value, Record) else {}
            if part not in known:
                raise unknown("key", part, known)
            value = known[part]
        return value

    def to_dataframe(self) -> pandas.DataFrame:
        """A table of one row, columns by their keys: "deepest.depth_mm". Needs pandas."""
        import pandas

        return pandas.DataFrame([row_of(self)])

    def __iter__(self) -> Iterator[str]:
        return iter(vars(self))

    def keys(self) -> list[str]:
        return list(vars(self))

    def _repr_html_(self) -> str:
        return html_of(type(self).__name__, [(key, str(value)) for key, value in columns_of(self).items() if value is not None])

    def __setattr__(self, key: str, value: object) -> NoReturn:
        raise AttributeError(f"{type(self).__name__}.{key} is not assigned to")

    def __delattr__(self, key: str) -> NoReturn:
        raise AttributeError(f"{type(self).__name__}.{key} is not deleted")

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and _is_same(vars(self), vars(other))

    def __hash__(self) -> int:
        return hash((type(self), *vars(self)))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{key}={value!r}' for key, value in vars(self).items())})"


_hints: dict[type, dict[str, Any]] = {}


def _hints_of(cls: type) -> dict[str, Any]:
    """Type hints of a class, looked up once: a record has many of them."""
    if cls not in _hints:
        _hints[cls] = get_type_hints(cls)
    return _hints[cls]
