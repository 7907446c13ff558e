#!/usr/bin/env python3
"""Runs the command lines of README.md and docs/ by two commands, and holds what they print, how they end and what they write against each
other, byte for byte.

Usage: same_answers.py SOURCE_FOLDER CONDYLE OTHER_CONDYLE [PAGE...]

Left aside is what the other one cannot do: HDF5 (study.h5, the digest of it in study.json, `motion --jam`), and what takes another program
(python3, make). Progress is no answer. Says how much processor time both took for each command.
"""
import collections
import json
import os
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "docs"))
from page_commands import SYNOPSIS, commands_in, pages_of, parts_of  # noqa: E402

PROGRESS = re.compile(r"^.*: \d+ of \d+ \(\d+ %\).*\n|\r\x1b\[K[^\r\n]*", re.M)
WITHOUT_HDF5 = re.compile(r" --jam\b")


def lines_of(page: Path):
    """Blocks as they are run: text to append to a file, or command lines."""
    append_to, runs = None, True
    for kind, text, _ in parts_of(page.read_text(encoding="utf-8")):
        if kind == "append":
            append_to = text
        elif kind == "run":
            runs = not text.startswith("no")
        elif kind == "toml":
            if append_to:
                yield "append", (append_to, text)
            append_to = None
        elif kind in ("commands", "inline"):
            found = [command for command, _ in commands_in(text) if command.startswith("condyle ") and not SYNOPSIS.search(command)]
            if kind == "inline" and not re.search(r"[\w}]/|\.(toml|csv|ply|html)\b| --out ", text):
                found = []
            if runs:
                yield from (("command", command) for command in found)
            if kind == "commands" or found:
                runs = True


def ran(command: str, folder: Path, tools: Path, module: Path):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    # The command that was built has its module beside it, with which the other one draws too.
    environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "PYTHONPATH": str(module)}
    done = subprocess.run(["bash", "-c", command], cwd=folder, capture_output=True, env=environment)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    took_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return done.returncode, done.stdout, PROGRESS.sub("", done.stderr.decode(errors="replace")), took_s


def contents(path: Path) -> bytes:
    if path.name != "study.json":
        return path.read_bytes()
    record = json.loads(path.read_text())
    record["files"].pop("study.h5", None)
    return json.dumps(record).encode()


def differences(one: Path, other: Path):
    names = {path.relative_to(folder) for folder in (one, other) for path in folder.rglob("*") if path.is_file() and not path.is_symlink()}
    for name in sorted(names):
        if name.name == "study.h5":
            continue
        if not (one / name).is_file() or not (other / name).is_file():
            yield f"{name}: written by one only"
        elif contents(one / name) != contents(other / name):
            yield f"{name}: differs"


def main() -> int:
    source = Path(sys.argv[1]).resolve()
    commands = [Path(word).resolve() for word in sys.argv[2:4]]
    pages = pages_of(source, sys.argv[4:])
    wrong, count, took = [], 0, collections.defaultdict(lambda: [0.0, 0.0])
    with tempfile.TemporaryDirectory() as made:
        tools = []
        for number, command in enumerate(commands):
            tools.append(Path(made) / f"bin_{number}")
            tools[-1].mkdir()
            (tools[-1] / "condyle").symlink_to(command)
        for page in pages:
            if "$CONDYLE_DATA" in page.read_text(encoding="utf-8") and not os.environ.get("CONDYLE_DATA"):
                print(f"skipped: {page.name}: CONDYLE_DATA is not set")
                continue
            # The same name, since answers have paths in them.
            folders = [Path(made) / str(number) / page.stem for number in (0, 1)]
            for folder in folders:
                folder.mkdir(parents=True)
                for name in ("examples", "workflow"):
                    (folder / name).symlink_to(source / name)
            for kind, what in lines_of(page):
                if kind == "append":
                    for folder in folders:
                        if (folder / what[0]).exists():
                            with open(folder / what[0], "a", encoding="utf-8") as file:
                                file.write(f"\n{what[1]}\n")
                    continue
                if WITHOUT_HDF5.search(what):
                    continue
                answers = [ran(what, folder, tool, commands[0].parent / "python") for folder, tool in zip(folders, tools)]
                count += 1
                name = what.split()[1]
                for number in (0, 1):
                    took[name][number] += answers[number][3]
                print(f"{page.name}: {what} ({answers[0][3]:.2f} s, {answers[1][3]:.2f} s)", flush=True)
                for part, of_one, of_other in zip(("exit code", "standard output", "standard error"), *answers):
                    if of_one != of_other and "study.h5" not in str(of_one):
                        wrong.append(f"{page.name}: {what}: {part}: {of_one!r:.600} and {of_other!r:.600}")
            wrong += [f"{page.name}: {line}" for line in differences(*folders)]
    for name, (one, other) in sorted(took.items()):
        print(f"{name}: {one:.1f} s and {other:.1f} s of processor time, {other / max(one, 1e-3):.1f} times")
    print(f"{count} commands, {len(wrong)} differences")
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
