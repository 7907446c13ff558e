"""Warnings on materials, loads and motions, and remarks on answers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Iterable, Mapping, Optional

from ._errors import JointRemark, JointWarning, warn

#: Codes of notes on limits: docs/checks.md.
OF_LIMITS = frozenset({
    "bones_touch", "centre_moves_limits", "coarse_mesh", "differs_from_closed_form", "last_value_left_out", "limit_on_cut", "limit_on_part_cut",
    "limit_on_piece", "limit_through_bone", "narrow_bearing_margin", "nothing_holds_joint", "sliding_surfaces", "translation_ends"})


@dataclass(frozen=True)
class ContactNote:
    """A warning on layers, a load or a motion, or a caveat of limits: `code` as in files ("unlikely_modulus"), `text` one sentence.

    docs/checks.md has the codes and the sources of the bounds.
    """

    code: str
    text: str


def contact_notes(found: Iterable[tuple[str, str]]) -> tuple[ContactNote, ...]:
    return tuple(ContactNote(code, text) for code, text in found)


def kind_of(codes: Iterable[str]) -> type[UserWarning]:
    """The warning with notes of these codes."""
    return JointRemark if OF_LIMITS.issuperset(codes) else JointWarning


def warn_of(notes: Iterable[ContactNote], kind: Optional[type[UserWarning]] = None) -> None:
    """A warning for each note, of that kind or else by its code; one for notes that several answers share."""
    for note in dict.fromkeys(notes):
        warn(f"{note.code}: {note.text}", kind or kind_of([note.code]))


def reported(found: Iterable[tuple[str, str]], kind: Optional[type[UserWarning]] = None) -> tuple[ContactNote, ...]:
    """The notes of an answer, each with a warning."""
    notes = contact_notes(found)
    warn_of(notes, kind)
    return notes


def remarked(found: Iterable[tuple[str, str]]) -> tuple[ContactNote, ...]:
    """The notes of an answer on itself, each with a JointRemark."""
    return reported(found, JointRemark)


def notes_said(said: Iterable[Mapping[str, str]]) -> tuple[ContactNote, ...]:
    """The same of notes as files have them."""
    return reported((each["code"], each["text"]) for each in said)
