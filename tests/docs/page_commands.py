#!/usr/bin/env python3
"""Runs every command line of README.md and docs/, but its decisions, page by page, and holds the answers to what pages say of them.

Usage: page_commands.py SOURCE_FOLDER CONDYLE_BINARY [PAGE...]

Each page has an empty folder of its own, in which its commands run in their order, with `condyle` and `python3` on the
path: `python3 -m condyle.plot` only where the module can be imported, pages that name $CONDYLE_DATA only where
that folder, or else shared/data beside the repository, is there; with CI=true a skipped command is an error. Commands are

- lines of fenced or indented blocks that begin with `condyle `, `python3 -m condyle`, `python3 $CONDYLE_DATA/` or `make ` (of
  which only the target is tried);
- code in running text that begins so and names a file or, after --out, a folder;
- after them, a fenced block of `text` is what the last command prints; its line `…` stands for any number of lines.

A line with a placeholder (JOINT, FILE, `[--option]`) is a synopsis: all of a command on a page together name the options
of its --help-all, no more and no fewer. Every option that stands as code anywhere must be one. Comments of the page say the
rest, each on a line of its own:

    <!-- run: no, 20 minutes -->       the next block is not run
    <!-- append: a/b.toml -->          the next block of TOML is added to this file
    <!-- exit: 6 -->                   with which code the next block's last command ends; else 0
    <!-- prints: some words -->        a command of the block before printed this
    <!-- leaves: a/b.json c.vtp -->    these files are there, and not empty
    <!-- same: a b x.csv y.h5 -->      these files are the same bytes in the folders a and b
    <!-- says: a/b.json motions.0.limit_deg = 135.5 +- 0.05 -->
"""
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAMS = ("condyle ", "python3 -m condyle", "python3 $CONDYLE_DATA/", "make ")
SYNOPSIS = re.compile(r"\[|…|\b(JOINT|FILE|MESH|DIR|POSE|OUT)\b")
MARKER = re.compile(r"<!-- (run|exit|prints|leaves|says|same|append): (.*?) -->")
#: What holds the answer of the last command, if that was run.
HELD = ("text", "prints", "leaves", "same", "says")
OPTION = re.compile(r"(?<![\w-])--[a-z](?:[a-z-]*[a-z])?\b(?!-)")
#: Their options are their own, on a line or in code that begins with one of these words.
OTHER_PROGRAMS = ("cmake", "ctest", "snakemake", "sbatch", "pip", "pkg-config", "git", "node", "scripts/", "build/",
                  "bench", "tar", "apptainer", "docker", "podman", "/usr/bin/python3", "PYTHONPATH", "CONDYLE", "python3 bench", "emcmake")


#: Of Snakemake and of condyle-bench, where they stand without their program.
OTHER_OPTIONS = {"--profile", "--forcerun", "--compare", "--filter"}


class Wrong(Exception):
    """A page that says what is not so."""


def parts_of(page: str):
    """(kind, text, line): kind is "commands", "text" (what is printed), "inline", or the name of a comment."""
    lines = page.splitlines()
    i = 0
    prose: "list[tuple[int, str]]" = []

    def inline():
        text = "\n".join(line for _, line in prose)
        for found in re.finditer(r"(`+)(.+?)\1", text, re.S):
            yield "inline", re.sub(r"\s+", " ", found[2]).strip(), prose[text.count("\n", 0, found.start())][0]
        prose.clear()

    while i < len(lines):
        line, number = lines[i], i + 1
        marker = MARKER.fullmatch(line.strip())
        if not marker and re.match(r"\s*<!-- \w+: ", line):
            yield "unknown", line.strip(), number
        if marker:
            yield from inline()
            yield marker[1], marker[2], number
        elif line.startswith("```"):
            yield from inline()
            language, block = line[3:].strip(), []
            i += 1
            while i < len(lines) and not lines[i].startswith("```"):
                block.append(lines[i])
                i += 1
            if language in ("", "sh"):
                yield "commands", "\n".join(block), number + 1
            elif language in ("text", "toml"):
                yield language, "\n".join(block), number + 1
        elif line.startswith("    ") and (i == 0 or not lines[i - 1].strip()):
            yield from inline()
            block = []
            while i < len(lines) and (lines[i].startswith("    ") or not lines[i].strip()):
                block.append(lines[i][4:])
                i += 1
            yield "commands", "\n".join(block), number
            continue
        elif not line.strip():
            yield from inline()
        else:
            prose.append((number, line))
        i += 1
    yield from inline()


def commands_in(block: str):
    """(command, line in the block); lines that go on after a backslash, and indented ones of a synopsis, are one."""
    lines = block.splitlines()
    i = 0
    while i < len(lines):
        text, at = lines[i], i
        while text.endswith("\\") and i + 1 < len(lines):
            i += 1
            text = text[:-1] + " " + lines[i].strip()
        while i + 1 < len(lines) and lines[i + 1].startswith("  ") and text.startswith(PROGRAMS):
            i += 1
            text += " " + lines[i].strip()
        i += 1
        yield re.sub(r"\s+#.*", "", text).strip(), at


class Page:
    def __init__(self, path: Path, source: Path, condyle: Path, help_of, has_module: bool) -> None:
        self.path, self.source, self.help_of, self.has_module = path, source, help_of, has_module
        self.condyle = condyle
        self.ran, self.held, self.skipped, self.needs_data = 0, 0, [], False
        #: Of the last command, and of all of its block; None where it was not run.
        self.printed, self.printed_by_block = None, ""
        self.next_is_run, self.next_exit = True, 0
        #: The file that the next block of TOML is added to.
        self.append_to = None
        self.errors: "list[str]" = []
        #: By command: where on the page the first stands, and the options that all name.
        self.synopses: "dict[str, tuple[int, set[str]]]" = {}

    def wrong(self, line: int, what: str) -> Wrong:
        return Wrong(f"{self.path.relative_to(self.source)}: line {line}: {what}")

    def check(self, folder: Path) -> None:
        self.folder = folder
        for name in ("examples", "workflow"):
            (folder / name).symlink_to(self.source / name)
        page = self.path.read_text(encoding="utf-8")
        self.needs_data = "$CONDYLE_DATA" in page
        for kind, text, line in parts_of(page):
            if kind in HELD and self.printed is None:
                continue
            try:
                getattr(self, f"on_{kind}")(text, line)
            except Wrong as error:
                self.errors.append(str(error))
            except (OSError, LookupError, TypeError, ValueError, AttributeError) as error:
                self.errors.append(str(self.wrong(line, f"{kind}: {text}: {error}")))
        self.check_synopses()

    # Values on the page.

    def on_commands(self, block: str, line: int) -> None:
        is_run, code = self.next_is_run, self.next_exit
        self.next_is_run, self.next_exit = True, 0
        self.printed_by_block = ""
        found = [(command, line + at) for command, at in commands_in(block) if command.startswith(PROGRAMS)]
        for n, (command, at) in enumerate(found):
            if SYNOPSIS.search(command):
                self.synopsis(command, at)
            elif is_run:
                self.run(command, at, code if n + 1 == len(found) else 0)

    def on_inline(self, code: str, line: int) -> None:
        words = code.split()
        names_a_file = re.search(r"[\w}]/|\.(toml|csv|ply|html)\b| --out ", code) or any((self.folder / each).is_dir() for each in words[3:])
        if code.startswith(PROGRAMS[:2]) and not SYNOPSIS.search(code) and names_a_file:
            is_run, self.next_is_run = self.next_is_run, True
            self.printed_by_block = ""
            if is_run:
                self.run(code, line, self.next_exit)
            self.next_exit = 0
        elif not code.startswith(OTHER_PROGRAMS):
            command = words[1] if len(words) > 1 and words[0] == "condyle" else None
            if code.startswith(PROGRAMS[1]):
                command = "plot"
            self.options(code, command, line)

    def on_text(self, block: str, line: int) -> None:
        pattern = "".join(r"(?:.*\n)*?" if shown.strip() == "…" else re.escape(shown.rstrip()) + r"[ \t]*\n" for shown in block.splitlines())
        if not re.fullmatch(pattern, self.printed):
            raise self.wrong(line, f"this is not what the command prints:\n{self.printed}")
        self.held += 1

    def on_append(self, text: str, line: int) -> None:
        self.append_to = text

    def on_toml(self, block: str, line: int) -> None:
        name, self.append_to = self.append_to, None
        if name and self.printed is not None:
            with open(self.folder / name, "a", encoding="utf-8") as file:
                file.write(f"\n{block}\n")

    def on_unknown(self, text: str, line: int) -> None:
        raise self.wrong(line, f"a comment that means nothing: {text}")

    def on_run(self, text: str, line: int) -> None:
        self.next_is_run = not text.startswith("no")

    def on_exit(self, text: str, line: int) -> None:
        self.next_exit = int(text)

    def on_prints(self, text: str, line: int) -> None:
        if " ".join(text.split()) not in " ".join(self.printed_by_block.split()):
            raise self.wrong(line, f"'{text}' is not in what the commands print:\n{self.printed_by_block}")
        self.held += 1

    def on_leaves(self, text: str, line: int) -> None:
        for name in text.split():
            if not (self.folder / name).is_file() or (self.folder / name).stat().st_size == 0:
                raise self.wrong(line, f"the commands leave no {name}")
            self.held += 1

    def on_same(self, text: str, line: int) -> None:
        one, other, *names = text.split()
        for name in names:
            if (self.folder / one / name).read_bytes() != (self.folder / other / name).read_bytes():
                raise self.wrong(line, f"{name} differs between {one} and {other}")
            self.held += 1

    def on_says(self, text: str, line: int) -> None:
        name, keys, expected, tolerance = re.fullmatch(r"(\S+) (\S+) = (\S+)(?: \+- (\S+))?", text).groups()
        value = json.loads((self.folder / name).read_text())
        for key in keys.split("."):
            value = value[int(key)] if isinstance(value, list) else value[key]
        is_right = str(value) == expected if tolerance is None else abs(value - float(expected)) <= float(tolerance)
        if not is_right:
            raise self.wrong(line, f"{name}: {keys} is {value}, not {expected}")
        self.held += 1

    # The commands that use it.

    def synopsis(self, command: str, line: int) -> None:
        words = command.split()
        if words[0] == "condyle":
            self.options(command, words[1], line)
            self.synopses.setdefault(words[1], (line, set()))[1].update(OPTION.findall(command))

    def check_synopses(self) -> None:
        for command, (line, named) in self.synopses.items():
            left_out = self.help_of(command) - named - {"--help", "--help-all", "--version"}
            if left_out:
                self.errors.append(str(self.wrong(line, f"condyle {command} also has {', '.join(sorted(left_out))}")))

    def options(self, text: str, command, line: int) -> None:
        for option in OPTION.findall(text):
            if option not in OTHER_OPTIONS and option not in self.help_of(command):
                raise self.wrong(line, f"{' '.join(filter(None, ('condyle', command)))} has no option {option}")
            self.held += 1

    def run(self, command: str, line: int, code: int) -> None:
        self.printed = None
        if self.needs_data and not command.startswith("make ") and not Path(os.environ["CONDYLE_DATA"]).is_dir():
            return self.skipped.append("no shared data: set CONDYLE_DATA")
        if command.startswith("python3 -m condyle") and not self.has_module:
            return self.skipped.append("no module condyle.plot")
        if command.startswith("make "):
            # To run it here would build what is tested; that there is such a target is what can be wrong.
            command = f"make -s -n -C {shlex.quote(str(self.source))} {command[5:]} >/dev/null"
        print(f"{self.path.name}: {command}", flush=True)
        done = subprocess.run(["bash", "-c", command], cwd=self.folder, capture_output=True, text=True)
        if done.returncode != code:
            raise self.wrong(line, f"{command}: ends with {done.returncode}, not {code}: {done.stderr.strip()}")
        self.printed = done.stdout
        self.printed_by_block += done.stdout
        self.ran += 1


def help_reader(condyle: Path, has_module: bool):
    """The options of a command or of condyle.plot ("plot"), of all of them for None."""
    def help_of(*words) -> str:
        return subprocess.run([*words, "--help-all" if words[1:2] and words[0] == condyle else "--help"], capture_output=True, text=True, check=True).stdout

    def defined(*words) -> "set[str]":
        return set(re.findall(r"^  (?:-\w, ?)?(--[a-z][a-z-]*)", help_of(*words), re.M))

    of_all = defined(condyle)
    known = {name: of_all | defined(condyle, name) for name in re.findall(r"^  ([a-z]+)  +\S", help_of(condyle), re.M)}
    for made in ("hip", "cartilages", "cohort", "replacement", "reverse-shoulder"):
        known["sample"] |= defined(condyle, "sample", made)
    if has_module:
        known["plot"] = defined(sys.executable, "-m", "condyle.plot") | defined(sys.executable, "-m", "condyle.plot", "sheet")
    everything = of_all.union(*known.values())
    return lambda command: known.get(command, everything)


def pages_of(source: Path, names: "list[str]") -> "list[Path]":
    """Those named, else README.md and all of docs/ but its decisions."""
    return [source / name for name in names] or [source / "README.md", *(
        page for page in sorted((source / "docs").rglob("*.md")) if page.parent.name != "decisions")]


def main() -> int:
    source, condyle = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    pages = pages_of(source, sys.argv[3:])
    if os.environ.get("PYTHONPATH"):
        # Commands run in folders of their own.
        folders = os.environ["PYTHONPATH"].split(os.pathsep)
        os.environ["PYTHONPATH"] = os.pathsep.join(os.path.abspath(folder) for folder in folders)
    os.environ["MPLBACKEND"] = "Agg"
    os.environ.setdefault("CONDYLE_DATA", str(source.parent / "shared/data"))
    has_module = subprocess.run([sys.executable, "-c", "import condyle.plot"], capture_output=True).returncode == 0
    help_of = help_reader(condyle, has_module)
    ran = held = 0
    wrong, skipped = [], set()
    with tempfile.TemporaryDirectory() as made:
        tools = Path(made) / "bin"
        tools.mkdir()
        (tools / "condyle").symlink_to(condyle)
        (tools / "python3").symlink_to(sys.executable)
        os.environ["PATH"] = f"{tools}:{os.environ['PATH']}"
        for path in pages:
            folder = Path(made) / path.stem
            folder.mkdir()
            page = Page(path, source, condyle, help_of, has_module)
            page.check(folder)
            wrong += page.errors
            ran, held = ran + page.ran, held + page.held
            skipped |= {f"{path.name}: {why}" for why in page.skipped}
    for line in sorted(skipped):
        print(f"skipped: {line}")
    print(f"{ran} commands, {held} statements held")
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong or ran == 0 or (skipped and os.environ.get("CI") == "true") else 0


if __name__ == "__main__":
    sys.exit(main())
