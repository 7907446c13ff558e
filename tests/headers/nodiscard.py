#!/usr/bin/env python3
"""Every public function that returns a value is [[nodiscard]]. Usage: nodiscard.py INCLUDE_FOLDER [NAME...]

Names are functions that are called for what they do as well: their value may be dropped. Left out are constructors, conversions,
comparisons and what returns its own object, which nobody calls for its value alone, and what is private.
"""
import re
import sys
from pathlib import Path
from typing import Iterator

# Words before a name that are no type.
SPECIFIERS = r"\b(?:inline|constexpr|static|friend|virtual|explicit|extern|template|typename)\b"
FUNCTION = re.compile(r"(?P<before>.*?)(?P<name>operator\s*(?:\(\)|\[\]|[^\s\w(]+|[\w:&<> ]+)|~?[A-Za-z_]\w*)\s*\((?!\*)", re.S)


def without_comments(text: str) -> str:
    """The same lines with blanks for comments, literals and preprocessor lines."""
    def blank(found: "re.Match[str]") -> str:
        return re.sub(r"[^\n]", " ", found[0])
    return re.sub(r'//[^\n]*|/\*.*?\*/|^\s*#(?:[^\n]*\\\n)*[^\n]*|"(?:\\.|[^"\\\n])*"', blank, text, flags=re.S | re.M)


def flattened(statement: str) -> str:
    """Without what stands in angle brackets, template parameters and arguments, whose parentheses call nothing; as long as before."""
    statement = re.sub(r"operator\s*<=?>?|operator\s*>=?|->", lambda found: "@" * len(found[0]), statement)
    while (shorter := re.sub(r"<[^<>]*>", lambda found: "_" * len(found[0]), statement)) != statement:
        statement = shorter
    return statement


def declarations(text: str) -> "Iterator[tuple[int, str, str]]":
    """Statements at the scope of namespaces and classes, each with its place and the class around it; private ones are left out."""
    scopes, start, at = [], 0, 0  # a scope: the class or "", and whether what is declared now is private
    while at < len(text):
        char = text[at]
        if char in "{;":
            statement = text[start:at]
            hidden = any(private for _, private in scopes)
            kind = re.search(r"^\s*(?:template\s*<[^{;]*>\s*)?(namespace|class|struct|union|extern)\b(?:\s*\[\[\w+\]\])?\s*(\w*)", statement)
            opens = char == "{" and kind and not re.search(r"\(", statement)
            if opens:
                scopes.append(("" if kind[1] in ("namespace", "extern") else kind[2], kind[1] == "class"))
            else:
                if not hidden:
                    yield start, statement, next((name for name, _ in reversed(scopes) if name), "")
                if char == "{":  # a body or a value
                    at = end_of_block(text, at)
                    rest = re.match(r"\s*;", text[at + 1:])
                    if rest and not re.search(r"\)[^)]*$", statement):
                        at += rest.end()
                    elif "=" in flattened(statement) or re.match(r"\s*[,;]", text[at + 1:]):
                        at = text.index(";", at)
            start = at + 1
        elif char == "}":
            scopes.pop()
            start = at + 1
        elif char == "(":
            at = end_of_block(text, at)
        elif label := re.compile(r"\s*(public|protected|private)\s*:(?!:)").match(text, at):
            scopes[-1] = (scopes[-1][0], label[1] != "public")
            at = label.end() - 1
            start = at + 1
        at += 1


def end_of_block(text: str, at: int) -> int:
    depth = 0
    while True:
        depth += {"{": 1, "(": 1, "}": -1, ")": -1}.get(text[at], 0)
        if depth == 0:
            return at
        at += 1


def function_of(statement: str, around: str) -> "str | None":
    """The name of what returns a value; nothing for what is no such function."""
    flat = flattened(statement)
    found = FUNCTION.match(flat)
    if not found or "=" in found["before"]:
        return None
    name = statement[found.start("name"):found.end("name")].strip()
    before = re.sub(r"\[\[.*?\]\]", "", found["before"])
    kind = re.sub(SPECIFIERS + r"|_+(?=\s)", " ", before).split()
    if kind in ([], ["void"]) or kind[0] in ("using", "typedef", "static_assert", "enum"):
        return None
    is_comparison = re.search(r"operator\s*(==|!=|<|>)", name) is not None
    if is_comparison or name.startswith("operator") and "".join(kind) == around + "&":
        return None
    return name


def main(folder: Path, *free: str) -> int:
    missing, functions = [], 0
    for header in sorted(folder.rglob("*.hpp")):
        text = without_comments(header.read_text(encoding="utf-8"))
        for start, statement, around in declarations(text):
            if not (name := function_of(statement, around)):
                continue
            functions += 1
            if "[[nodiscard]]" not in statement and name not in free:
                line = text.count("\n", 0, start + len(statement) - len(statement.lstrip())) + 1
                missing.append(f"{header}:{line}: {name}() returns a value: [[nodiscard]], or its name to tests/headers/CMakeLists.txt")
    if functions < 400:
        missing.append(f"only {functions} functions were found: are the headers written another way?")
    print("\n".join(missing), end="\n" if missing else "")
    return bool(missing)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), *sys.argv[2:]))
