"""What a report holds."""

import base64
import json
import re
import zlib


def text_of(path):
    """The text of its data block."""
    data = zlib.decompress(base64.b64decode(re.search(r'id="condyle-data">([^<]*)<', path.read_text()).group(1)))
    return json.loads(data[16:16 + int.from_bytes(data[12:16], "little")])
