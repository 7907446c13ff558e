"""Draws what is in a folder of results, python3 -m condyle.plot FOLDER, or a case on paper, python3 -m condyle.plot sheet INPUT..."""
from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import Callable, Dict, List, Optional, Sequence, Tuple

import matplotlib
import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from . import case_sheet, patient, study_folder, style
from .contact_sheet import MOST_JOINTS, contact_sheet
from .files import ReadError
from .folder import drawings
from .outliers import outliers_csv
from .pressure_surface import PROJECTIONS

EXAMPLES = """\
examples:
  condyle rom hip.toml --band=40 --out range && python3 -m condyle.plot range
  condyle rom hip.toml --map flexion=0:120:10 adduction=-30:20:10 --out map && python3 -m condyle.plot map --format png
  condyle hip hips.nii.gz --out patient && python3 -m condyle.plot patient --case "Case 17"
  condyle study hips.csv --measures --out study && python3 -m condyle.plot study --out figures
  condyle motion knee.toml --motion walk.mot --load --maps --out walk
  python3 -m condyle.plot walk --frames 0 20 40 --out figures
a case on paper, of which python3 -m condyle.plot sheet --help says more; a folder of that name is ./sheet:
  condyle resect hip.toml --reach "fadir=48" --out plan
  python3 -m condyle.plot sheet range plan --case "Case 17" --date 2026-11-27 --out case.pdf
"""
Rendered = List[Tuple[Path, bytes]]
WRONG_USAGE, BAD_FILE, INTERNAL, INTERRUPTED = 2, 3, 5, 130


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
        "limit_bands, clock_face,\nmap_MOVEMENT, map_MOVEMENT_ends and map_free_range; curves, cycle and pressure_map "
        "or depth_map; hip_shape; safe_zone "
        "and safe_probability.\nOf a patient's folder, as condyle hip leaves it, draws the figures of each side, sheet.pdf of each, and both: "
        "how far both turn.\nOf a study's folder, as condyle study leaves it, draws limit_distributions, limits_by_COLUMN and "
        "limits_against_COLUMN for each column of the table,\nmeasure_distributions, contact_sheet.pdf of all joints, and writes outliers.csv. "
        "Names what was written.")
    parser.add_argument("folder", metavar="FOLDER", type=Path, help="what was given to --out")
    parser.add_argument("--format", choices=("pdf", "svg", "png"), default="pdf",
                        help="vectors (pdf, svg) or 300 dots per inch (png); pdf if not said")
    parser.add_argument("--out", metavar="DIR", type=Path, help="where figures go; the folder itself if not said")
    parser.add_argument("--frames", metavar="N", type=int, nargs="+",
                        help="frames of pressure_map and depth_map, from 0; first, middle and last if not said")
    parser.add_argument("--projection", choices=PROJECTIONS, default="plane",
                        help="of pressure_map and depth_map: along the mean normal, or azimuthal equidistant about the joint centre")
    _add_heading(parser, "; of the sheets of a patient's folder")
    return parser


def _add_heading(parser: argparse.ArgumentParser, whose: str = "") -> None:
    parser.add_argument("--case", metavar="TEXT", default="", help="begins the heading: a number or a pseudonym" + whose)
    parser.add_argument("--date", metavar="TEXT", default="", help="in the heading; none is taken from the clock" + whose)
    parser.add_argument("--note", metavar="TEXT", default="", help="stands below the heading" + whose)


def _sheet_parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="python3 -m condyle.plot sheet", formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="example:\n" + EXAMPLES[EXAMPLES.index("  condyle resect"):],
        description="Writes a case on A4: a page with the verdict, the planned resection, limits now and planned with targets and bands, and notes\n"
        "that may change a decision; then contacts on the socket's clock, shape, safe zone, all other notes. Names what was written.")
    parser.add_argument("inputs", metavar="INPUT", type=Path, nargs="+",
                        help="folders of condyle rom, resect, measure or sweep --out, or their rom.json, resection.json, measures.json, sweep.json: "
                        "one of each at most, of one joint")
    parser.add_argument("--out", metavar="FILE.pdf", type=Path, required=True, help="the pages, as PDF, or FILE.png, FILE-2.png")
    _add_heading(parser)
    parser.add_argument("--picture", metavar="FILE.png", type=Path,
                        help="shown as the cut, in place of depth_mobile.png and depth_fixed.png beside resection.json")
    return parser


def _figures(given: argparse.Namespace) -> Rendered:
    heading = _heading(given)
    if study_folder.is_study(given.folder):
        return _of_study(given)
    if patient.sides_of(given.folder):
        found, sheets = patient.figures_of(given.folder, given.frames, given.projection), patient.sheets_of(given.folder, heading)
    else:
        found, sheets = drawings(given.folder, given.frames, given.projection), []
        _refuse_heading(given)
    out = given.out or given.folder
    return [_rendered(out / f"{name}.{given.format}", draw, given.format) for name, draw in found] + \
        [file for name, draw in sheets for file in _pages(out / f"{name}.{'png' if given.format == 'png' else 'pdf'}", draw)]


def _refuse_heading(given: argparse.Namespace) -> None:
    if any(_heading(given).values()):
        _refuse(f"{given.folder}: --case, --date and --note stand on sheets, which only a patient's folder has, as condyle hip leaves it",
                WRONG_USAGE)


def _of_study(given: argparse.Namespace) -> Rendered:
    study, out = study_folder.read(given.folder), given.out or given.folder
    _refuse_heading(given)
    if given.frames:
        raise ReadError(f"{given.folder}: no curves.csv in it, so no frames to draw")
    found = [_rendered(out / f"{name}.{given.format}", draw, given.format) for name, draw in study_folder.figures_of(study)]
    found.append((out / "outliers.csv", outliers_csv(study).encode("utf-8", "surrogateescape")))
    if study.hips.rows > MOST_JOINTS:
        print(f"condyle: note: no contact_sheet.pdf: {study.hips.rows} joints, at most {MOST_JOINTS} stand on one", file=sys.stderr)
        return found
    return found + [(out / "contact_sheet.pdf", style.rendered_pages(contact_sheet(study, name=given.folder.resolve().name), case_sheet.DPI))]


def _heading(given: argparse.Namespace) -> Dict[str, str]:
    return {"case": given.case, "date": given.date, "note": given.note}


def _rendered(path: Path, draw: Callable[[], Figure], format: str, dpi: float = 300) -> Tuple[Path, bytes]:
    figure = draw()
    try:
        return path, style.rendered(figure, format, dpi)
    finally:
        plt.close(figure)


def _pages(path: Path, draw: Callable[[], List[Figure]]) -> Rendered:
    pages = draw()
    try:
        return style.rendered_files(pages, path, case_sheet.DPI)
    finally:
        for page in pages:
            plt.close(page)


def _sheet(given: argparse.Namespace) -> Rendered:
    return _pages(given.out, lambda: case_sheet.sheet(given.inputs, **_heading(given), picture=given.picture))


def _starter_is_gone() -> bool:
    """Whether the command that draws these figures was killed: its folder may be the next one's by now."""
    try:
        os.kill(int(os.environ.get("CONDYLE_STARTED_BY", os.getpid())), 0)
    except OSError:  # nobody has its number, or somebody else
        return True
    return False


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Draws all figures first and writes them then; returns the exit code of a success, and exits with the others'."""
    words = sys.argv[1:] if arguments is None else list(arguments)
    is_sheet = words[:1] == ["sheet"]
    parser = _sheet_parser() if is_sheet else _parser()
    given = parser.parse_args(words[1:] if is_sheet else words)
    if is_sheet and given.out.suffix.lower() not in (".pdf", ".png"):
        parser.error("argument --out: a sheet is written as .pdf or .png")
    matplotlib.use("Agg")
    about = given.out if is_sheet else given.folder
    try:
        rendered = _sheet(given) if is_sheet else _figures(given)
        for path, content in rendered:
            if _starter_is_gone():
                _refuse("the command that asked for figures has ended", INTERRUPTED)
            path.parent.mkdir(parents=True, exist_ok=True)
            style.write_whole(path, content)
    except KeyboardInterrupt:
        _refuse("interrupted", INTERRUPTED)
    except ReadError as error:
        _refuse(str(error), BAD_FILE)
    except ImportError as error:
        _refuse(str(error), INTERNAL)
    except ValueError as error:
        _refuse(f"{about}: {error}", BAD_FILE)
    except OSError as error:
        _refuse(f"{error.filename or about}: {error.strerror or error}", BAD_FILE)
    for path, _ in rendered:
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
