#!/usr/bin/env python3
"""A study in the manner of a BIDS app: the joint files (sub-*/**/*.toml) of a dataset are the rows of OUT/joints.csv, each a shard.

    workflow/bids_app.py DATASET OUT participant --participant_label 01 02 --options="--band=200"
    workflow/bids_app.py DATASET OUT group

`participant` answers for the joints of these participants (default: all), in any number of jobs, each again if need be; `group` puts all
together. CONDYLE names the command where it is not on the path. After a change of the dataset's joint files OUT is to be another folder.
"""
import argparse
import os
import shlex
import subprocess
import sys
from pathlib import Path


def written_table(dataset: Path, out: Path) -> "list[str]":
    """Writes OUT/joints.csv, the same from every job. Returns the participant of each row."""
    joints = sorted(path for path in dataset.glob("sub-*/**/*.toml"))
    names = [path.relative_to(dataset).with_suffix("").as_posix() for path in joints]
    participants = [name.split("/")[0] for name in names]
    fields = [(name.replace("/", "_"), os.path.relpath(path, out), whose) for name, path, whose in zip(names, joints, participants)]
    rows = [("id", "joint", "participant"), *fields]
    text = "".join(",".join('"' + field.replace('"', '""') + '"' for field in row) + "\n" for row in rows)
    out.mkdir(parents=True, exist_ok=True)
    beside = out / f".joints.csv.{os.uname().nodename}.{os.getpid()}"
    beside.write_text(text, encoding="utf-8")
    beside.replace(out / "joints.csv")
    return participants


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("dataset", type=Path, metavar="DATASET")
    parser.add_argument("out", type=Path, metavar="OUT")
    parser.add_argument("level", choices=("participant", "group"))
    parser.add_argument("--participant_label", "--participant-label", nargs="+", metavar="LABEL", help="with or without sub-")
    parser.add_argument("--options", default="", help="of condyle study, the same in all jobs")
    given = parser.parse_args()
    condyle = os.environ.get("CONDYLE", "condyle")
    if given.level == "group":
        return subprocess.run([condyle, "merge", given.out]).returncode
    participants = written_table(given.dataset.resolve(), given.out.resolve())
    chosen = {"sub-" + label.removeprefix("sub-") for label in given.participant_label or participants or ["*"]}
    if missing := sorted(chosen.difference(participants)):
        parser.error(f"{given.dataset}: no joint file of {', '.join(missing)}")
    codes = [subprocess.run([condyle, "study", given.out / "joints.csv", "--out", given.out, "--shard", f"{row}/{len(participants)}",
                             *shlex.split(given.options)]).returncode
             for row, whose in enumerate(participants, 1) if whose in chosen]
    return next((code for code in codes if code), 0)


sys.exit(main())
