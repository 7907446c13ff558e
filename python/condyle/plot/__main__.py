"""Draws what is in a folder of results: python3 -m condyle.plot FOLDER."""
from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import List, Optional, Sequence

import matplotlib
import matplotlib.pyplot as plt

from . import style
from .files import ReadError
from .folder import drawings
from .pressure_surface import PROJECTIONS

EXAMPLES = """\
examples:
  condyle rom hip.toml --band=40 --out range && python3 -m condyle.plot range
  condyle rom hip.toml --map flexion=0:120:10 adduction=-30:20:10 --out map && python3 -m condyle.plot map --format png
  condyle motion knee.toml --motion walk.mot --load --maps --out walk
  python3 -m condyle.plot walk --frames 0 20 40 --out figures
"""
WRONG_USAGE, BAD_FILE, INTERNAL = 2, 3, 5


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> "None":  # type: ignore[override]
        _refuse(f"{message}; python3 -m condyle.plot --help has examples", WRONG_USAGE)


def _refuse(line: str, code: int) -> None:
    print(f"condyle: {line}", file=sys.stderr)
    raise SystemExit(code)


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="python3 -m condyle.plot", formatter_class=argparse.RawDescriptionHelpFormatter, epilog=EXAMPLES,
        description="Draws what condyle rom, condyle motion, condyle measure or condyle sweep left in a folder: limits or "
        "limit_bands, clock_face,\nmap_MOVEMENT and map_free_range; curves, cycle and pressure_map or depth_map; hip_shape; safe_zone "
        "and safe_probability. Names what was written.")
    parser.add_argument("folder", metavar="FOLDER", type=Path, help="what was given to --out")
    parser.add_argument("--format", choices=("pdf", "svg", "png"), default="pdf",
                        help="vectors (pdf, svg) or 300 dots per inch (png); pdf if not said")
    parser.add_argument("--out", metavar="DIR", type=Path, help="where figures go; the folder itself if not said")
    parser.add_argument("--frames", metavar="N", type=int, nargs="+",
                        help="frames of pressure_map and depth_map, from 0; first, middle and last if not said")
    parser.add_argument("--projection", choices=PROJECTIONS, default="plane",
                        help="of pressure_map and depth_map: along the mean normal, or azimuthal equidistant about the joint centre")
    return parser


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Draws all figures first and writes them then; returns the exit code of a success, and exits with the others'."""
    given = _parser().parse_args(arguments)
    matplotlib.use("Agg")
    out: Path = given.out or given.folder
    try:
        rendered = []
        for name, draw in drawings(given.folder, given.frames, given.projection):
            figure = draw()
            rendered.append((out / f"{name}.{given.format}", style.rendered(figure, given.format)))
            plt.close(figure)
        out.mkdir(parents=True, exist_ok=True)
        written: List[Path] = []
        for path, content in rendered:
            style.write_whole(path, content)
            written.append(path)
    except ReadError as error:
        _refuse(str(error), BAD_FILE)
    except ImportError as error:
        _refuse(str(error), INTERNAL)
    except ValueError as error:
        _refuse(f"{given.folder}: {error}", BAD_FILE)
    except OSError as error:
        _refuse(f"{error.filename or out}: {error.strerror or error}", BAD_FILE)
    for path in written:
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
