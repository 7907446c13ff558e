#!/usr/bin/env python3
"""Writes the C++ lines of a page for a test to include: page_code.py PAGE FOLDER

Each block whose paragraph begins with a library's name goes into FOLDER/NAME.inc, with the lines that it has in the page
for what the compiler says of it.
"""

import re
import sys
from pathlib import Path

page, folder = Path(sys.argv[1]), Path(sys.argv[2])
text = page.read_text(encoding="utf-8")
folder.mkdir(parents=True, exist_ok=True)
for block in re.finditer(r"^(\w+)[^\n]*:\n\n```cpp\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
    line = text.count("\n", 0, block.start(2)) + 1
    (folder / f"{block[1]}.inc").write_text(f'#line {line} "{page}"\n{block[2]}', encoding="utf-8")
