"""Errors, in the words of the command line: one line each."""

from __future__ import annotations

import difflib
import sys
import warnings
from typing import Iterable


class CondyleError(Exception):
    """Base of the module's own errors: one line. Each is also one of Python's own errors, by its bases."""


class FileError(CondyleError, OSError):
    """A file that cannot be read or written, or does not say what its format asks for.

    The message is one line: file, element, what is wrong.
    """


class MeshError(CondyleError, ValueError):
    """A mesh that was read well but does not allow the question asked of it.

    Open where a closed surface is needed, of inverted orientation, the joint centre on its surface. One line.
    """


class ReferenceContactError(MeshError):
    """Bodies in contact in the reference pose where nothing was said about it."""


class UsageError(CondyleError, ValueError):
    """A value outside its domain: a pose, a range, an unknown name, an array of another shape. One line."""


class UnknownNameError(UsageError, KeyError):
    """A name that there is not: of a motion, an angle, a column, a finding. The line says which there are."""

    __str__ = Exception.__str__  # KeyError would put the line in quotes


class OutOfRangeError(UsageError, IndexError):
    """A number of a pose or of a point beyond the last one. The line says how many there are."""


class JointWarning(UserWarning):
    """What looks wrong with a joint, its layers, load or motion: docs/checks.md. The answer is unchanged.

    Each note of :attr:`Joint.notes` is one warning, at the joint's first answer: "right hip: wrong_side: ...".
    `warnings.simplefilter("error", condyle.JointWarning)` makes them errors, as `--strict` of the command does.
    """


class JointRemark(UserWarning):
    """What an answer must be read with, and how something was read: nothing is wrong, and `--strict` lets it pass."""


for _error in (CondyleError, FileError, MeshError, ReferenceContactError, UsageError, UnknownNameError, OutOfRangeError,
               JointWarning, JointRemark):
    _error.__module__ = "condyle"


def unknown(what: str, name: object, known: Iterable[str]) -> UnknownNameError:
    """The error of a name that there is not: "motion: no 'flexoin': did you mean 'flexion'? there are flexion, ..."."""
    names = list(known)
    said = repr(name)[:60] if isinstance(name, str) else type(name).__name__
    near = difflib.get_close_matches(name, names, 1) if isinstance(name, str) else []
    guess = f" did you mean {near[0]!r}?" if near else ""
    return UnknownNameError(f"{what}: no {said}{':' if guess else ';'}{guess} "
                            + (f"there are {', '.join(names)}" if names else "there are none"))


def warn(text: str, kind: type[UserWarning]) -> None:
    """A warning of one printable line, at the line of the caller's that asked the module."""
    depth, frame = 2, sys._getframe(1)
    while frame.f_back is not None and str(frame.f_globals.get("__name__")).partition(".")[0] == "condyle":
        depth, frame = depth + 1, frame.f_back
    line = "".join(letter if letter.isprintable() else "?" for letter in text)
    warnings.warn(kind(line), stacklevel=depth)
