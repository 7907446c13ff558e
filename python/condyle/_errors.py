"""What goes wrong, in the words of the command line: one line each."""


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


for _error in (FileError, MeshError, ReferenceContactError, UsageError):
    _error.__module__ = "condyle"
