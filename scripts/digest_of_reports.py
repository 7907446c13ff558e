#!/usr/bin/env python3
"""Prints one SHA-256 of the data of reports, docs/report-data.md, without their provenance: digest_of_reports.py REPORT...

Two sets of reports with one digest give the page the same to show, whatever commit and command line made them.
"""
import base64
import hashlib
import json
import re
import sys
import zlib
from pathlib import Path

DATA = re.compile(rb'<script type="application/octet-stream" id="condyle-data">([^<]*)</script>')


def main() -> None:
    digest = hashlib.sha256()
    for path in map(Path, sys.argv[1:]):
        block = zlib.decompress(base64.b64decode(DATA.search(path.read_bytes())[1]))
        end = 16 + int.from_bytes(block[12:16], "little")
        text = json.loads(block[16:end], object_hook=lambda part: {key: part[key] for key in part if key != "provenance"})
        digest.update(f"{path.name} {json.dumps(text, sort_keys=True)}".encode() + block[end:])
    print(digest.hexdigest())


if __name__ == "__main__":
    main()
