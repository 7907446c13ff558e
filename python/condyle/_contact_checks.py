"""Warnings on materials, loads and motions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Iterable, Mapping

from ._errors import warn


@dataclass(frozen=True)
class ContactNote:
    """A warning on layers, a load or a motion, or a caveat of limits: `code` as in files ("unlikely_modulus"), `text` one sentence.

    docs/checks.md has the codes and the sources of the bounds.
    """

    code: str
    text: str


def contact_notes(found: Iterable[tuple[str, str]]) -> tuple[ContactNote, ...]:
    return tuple(ContactNote(code, text) for code, text in found)


def warn_of(notes: Iterable[ContactNote]) -> None:
    """A JointWarning for each note; one for notes that several answers share."""
    for note in dict.fromkeys(notes):
        warn(f"{note.code}: {note.text}")


def reported(found: Iterable[tuple[str, str]]) -> tuple[ContactNote, ...]:
    """The notes of an answer, each with a JointWarning."""
    notes = contact_notes(found)
    warn_of(notes)
    return notes


def notes_said(said: Iterable[Mapping[str, str]]) -> tuple[ContactNote, ...]:
    """The same of notes as files have them."""
    return reported((each["code"], each["text"]) for each in said)
