"""Fields of CSV tables as Condyle writes them: docs/formats.md, "Texts in CSV tables"."""

from __future__ import annotations

import re

# Apostrophes, then what a spreadsheet would compute; behind the first one a text as it was.
_FORMULA = re.compile(r"'+[=+\-@].", re.DOTALL)
_ESCAPE = re.compile(r"\\u([0-9a-fA-F]{4})")


def plain_field(field: str) -> str:
    """The text that a field was written for: without the apostrophe before a formula, escapes as characters."""
    if field.startswith("'") and _FORMULA.match(field):
        field = field[1:]
    return _ESCAPE.sub(_character, field) if "\\u" in field else field


def _character(escape: re.Match[str]) -> str:
    value = int(escape.group(1), 16)
    is_written = (0 < value < 0x20 or 0x7F <= value < 0xA0 or value == 0x5C or 0x2028 <= value <= 0x2029
                  or 0x202A <= value <= 0x202E or 0x2066 <= value <= 0x2069)
    return chr(value) if is_written else escape.group(0)
