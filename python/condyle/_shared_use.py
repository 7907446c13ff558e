"""Objects that many threads ask and one may change."""

from __future__ import annotations

import threading
from contextlib import contextmanager
from typing import Iterator

from ._errors import UsageError


class SharedUse:
    """Any number of threads may use an object at a time; a change waits until none does, and they wait for it."""

    __slots__ = ("_free", "_users", "_changes")

    def __init__(self) -> None:
        self._free = threading.Condition()
        self._users: dict[int, int] = {}  # the number of uses by each thread: a progress callback may ask again
        self._changes = 0  # waiting, or under way: new users let them pass

    @contextmanager
    def use(self) -> Iterator[None]:
        thread = threading.get_ident()
        with self._free:
            if thread not in self._users:
                self._free.wait_for(lambda: not self._changes)
            self._users[thread] = self._users.get(thread, 0) + 1
        try:
            yield
        finally:
            with self._free:
                self._users[thread] -= 1
                if not self._users[thread]:
                    del self._users[thread]
                self._free.notify_all()

    @contextmanager
    def change(self, what: str) -> Iterator[None]:
        """Held throughout: uses that begin meanwhile wait for its end. UsageError within a use by the same thread."""
        with self._free:
            if threading.get_ident() in self._users:
                raise UsageError(f"{what}: not while it is asked, as from the progress of a question")
            self._changes += 1
            try:
                self._free.wait_for(lambda: not self._users)
                yield
            finally:
                self._changes -= 1
                self._free.notify_all()
