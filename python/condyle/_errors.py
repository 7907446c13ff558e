"""What goes wrong, in the words of the command line: one line each."""

from __future__ import annotations

import sys
import warnings



class FileError(OSError):
    """A file that cannot be read or written, or does not say what its format asks for.

    The message is one line: file, element, what is wrong.
    """


class MeshError(ValueError):
    """A mesh that was read well but does not allow the question asked of it.

    Open where a closed surface is needed, of inverted orientation, the joint centre on its surface. One line.
    """


class ReferenceContactError(MeshError):
    """Bodies in contact in the reference pose where nothing was said about it."""


class UsageError(ValueError):
    """A value outside its domain: a pose, a range, an unknown name, an array of another shape. One line."""


class JointWarning(UserWarning):
    """What looks wrong with a joint of which something is asked: docs/checks.md. The answer stays what it is.

    Each note of :attr:`Joint.notes` is one warning, at the joint's first answer: "right hip: wrong_side: ...".
    `warnings.simplefilter("error", condyle.JointWarning)` makes them errors, as `--strict` of the command does.
    """


for _error in (FileError, MeshError, ReferenceContactError, UsageError, JointWarning):
    _error.__module__ = "condyle"


def warn(text: str) -> None:
    """A JointWarning of one printable line, at the line of the caller's that asked the module."""
    depth, frame = 2, sys._getframe(1)
    while frame.f_back is not None and str(frame.f_globals.get("__name__")).partition(".")[0] == "condyle":
        depth, frame = depth + 1, frame.f_back
    line = "".join(letter if letter.isprintable() else "?" for letter in text)
    warnings.warn(JointWarning(line), stacklevel=depth)
