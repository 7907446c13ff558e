"""Fields of CSV tables as Condyle writes them: docs/formats.md, "Texts in CSV tables"."""

from __future__ import annotations

import re

# Apostrophes, then what a spreadsheet would compute; behind the first one a text as it was.
_FORMULA = re.compile(r"'+[=+\-@].", re.DOTALL)
_ESCAPE = re.compile(r"\\u([0-9a-fA-F]{4})")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")


def plain_field(field: str) -> str:
    """The text that a field was written for: without the apostrophe before a formula, escapes as characters."""
    if field.startswith("'") and _FORMULA.match(field):
        field = field[1:]
    return _ESCAPE.sub(_character, field) if "\\u" in field else field


def csv_field(text: str) -> str:
    """A text as a field, which `plain_field` reads back once the quotes are off; for spreadsheets never a formula."""
    field = "".join(f"\\u{ord(each):04x}" if _is_escaped(ord(each)) and each != "\\" or _ESCAPE.match(text, i) else each
                    for i, each in enumerate(text))
    if _FORMULA.match("'" + text) and not _NUMBER.fullmatch(text):
        field = "'" + field
    if field == text and not text.startswith("#") and not any(each in text for each in ',"'):
        return text
    return '"' + field.replace('"', '""') + '"'


def _is_escaped(value: int) -> bool:
    return (0 < value < 0x20 or 0x7F <= value < 0xA0 or value == 0x5C or 0x2028 <= value <= 0x2029
            or 0x202A <= value <= 0x202E or 0x2066 <= value <= 0x2069)


def _character(escape: re.Match[str]) -> str:
    value = int(escape.group(1), 16)
    return chr(value) if _is_escaped(value) else escape.group(0)
