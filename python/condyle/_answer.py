"""Base of all answers: tables, arrays with names, and their display in notebooks."""

from __future__ import annotations

import html
from decimal import ROUND_CEILING, Context
from dataclasses import fields
from typing import TYPE_CHECKING, Any, Optional, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from ._errors import UsageError, unknown

if TYPE_CHECKING:
    import pandas
    import xarray

Value = TypeVar("Value")


class Unchanging:
    """What nothing changes: a copy is the object itself, with the tables that it has built."""

    __slots__ = ()

    def __copy__(self: Value) -> Value:
        return self

    def __deepcopy__(self: Value, memo: dict[int, Any]) -> Value:
        return self


class Compiled(Unchanging):
    """An answer with a part, `_native`, that files and reports need and that a pickle leaves out."""

    def __getstate__(self) -> dict[str, Any]:
        return {**vars(self), "_native": None}


def kept(native: Optional[Value], what: str, needed_by: str) -> Value:
    """The compiled part of an answer; UsageError if it was pickled."""
    if native is None:
        raise UsageError(f"{what}: was pickled, which leaves out what {needed_by}: ask for it again")
    return native


class ByName(dict[str, Value]):
    """A mapping that says which names there are where one is asked for that there is not."""

    _what = "name"

    def __missing__(self, name: str) -> Value:
        raise unknown(self._what, name, self)


class Columns:
    """A frozen dataclass whose arrays of one length are the columns of a table."""

    def _columns(self) -> dict[str, NDArray[Any]]:
        named = {field.name: getattr(self, field.name) for field in fields(cast(Any, self))}
        return {name: value for name, value in named.items()
                if isinstance(value, np.ndarray) and value.ndim == 1 and name != "offset"}

    def to_dataframe(self) -> pandas.DataFrame:
        """A table with a column per array. Needs pandas."""
        import pandas

        return pandas.DataFrame(self._columns())

    def to_xarray(self) -> xarray.Dataset:
        """A dataset with a variable per array, along one dimension. Needs xarray."""
        import xarray

        return xarray.Dataset({name: (self._dimension, values) for name, values in self._columns().items()})

    _dimension = "entry"


def at_most(bound: float) -> str:
    """A bound in one digit, never below it, as the command says it: 3e-08."""
    return f"{float(Context(prec=1, rounding=ROUND_CEILING).create_decimal_from_float(bound)):.1g}"


def html_of(title: str, rows: list[tuple[str, str]]) -> str:
    """A small table for notebooks."""
    body = "".join(f"<tr><td>{html.escape(name)}</td><td>{html.escape(value)}</td></tr>" for name, value in rows)
    return f"<table><caption>{html.escape(title)}</caption>{body}</table>"
