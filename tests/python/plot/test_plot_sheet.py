"""A case on one sheet: one page of text that can be selected, nothing over anything else, nothing cut off."""
import copy
import itertools
import json
import re
import subprocess
import zlib
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.transforms import Bbox

import condyle
import condyle.plot as figures
from condyle.plot import sheet_text
from condyle.plot.__main__ import main
from condyle.plot.case_files import read_case
from condyle.plot.case_sheet import DPI

SCOPE = "osseous contact of the meshes given; soft tissue is not modelled; research software, not a medical device"
PROVENANCE = {"version": "9.8.7", "joint_file": {"path": "/secret/folder/hip.toml", "sha256": "ab" * 32},
              "fixed_mesh": {"path": "hip_bone.ply", "sha256": "cd" * 32}, "mobile_mesh": {"path": "femur.ply", "sha256": "ef" * 32}}
COMMON = {"condyle": 1, "joint": "a hip", "fixed": "hip_bone", "mobile": "femur", "side": "left", "scope": SCOPE, "provenance": PROVENANCE}
LONG = "internal rotation of the left thigh in the position in which the patient sits down on a low chair and ties the laces of both shoes"


def motion(name: str, limit: float, **more: object) -> "dict[str, object]":
    known = {"reason": "contact", "contact_kind": "impingement", "clock_hour": None, "normal_range_deg": None}
    return {"name": name, "limit_deg": limit, **known, **more}


def rom(*motions: "dict[str, object]", **more: object) -> "dict[str, object]":
    return {**COMMON, "anatomy": "hip", "normal_range_source": "AAOS 1965", "notes": [], "caveats": [], "motions": list(motions), **more}


def end(limit: float, reason: str = "contact") -> "dict[str, object]":
    return {"limit_deg": limit, "reason": reason}


def plan(*limits: "tuple[str, float, float]", targets: "dict[str, float]", **more: object) -> "dict[str, object]":
    found = {name: {"motion": name, "before": end(before), "after": end(after)} for name, before, after in limits}
    cut = {"body": "mobile", "name": "femur", "volume_mm3": 164.14, "area_mm2": 126.1, "deepest_mm": 2.739, "deepest_hour": 2.519}
    depths = [0.0, 0.0, 0.0, 1.88, 2.72] + [0.0] * 19
    return {**COMMON, "margin_mm": 0.5, "limits": list(found.values()), "cuts": [cut], "depth_by_half_hour_mm": depths,
            "resection_notes": [], "notes": [],
            "caveats": ["osseous only: labrum, cartilage, capsule and the strength of the remaining bone are not modelled"],
            "targets": [{**found[name], "reach_deg": reach, "band": None} for name, reach in targets.items()],
            "measures": [{"key": "head_neck_offset_1_30_mm", "unit": "mm", "before": 6.4, "after": 8.8},
                         {"key": "neck_shaft_angle_deg", "unit": "deg", "before": 126.22, "after": 126.24},
                         {"key": "femoral_version_deg", "unit": "deg", "before": None, "after": None}], **more}


def folder(at: Path, **answers: "dict[str, object]") -> Path:
    at.mkdir(exist_ok=True)
    for name, answer in answers.items():
        (at / f"{name}.json").write_text(json.dumps(answer))
    return at


def picture(path: Path, width: int = 400, height: int = 300) -> Path:
    """Noise, which no compression makes smaller."""
    plt.imsave(path, np.random.default_rng(1).integers(0, 256, (height, width, 3), dtype=np.uint8))
    return path


def said_in(pdf: bytes) -> str:
    """The text of a PDF whose strings are UTF-16, in its order, with one blank between words."""
    strings = []
    for stream in re.findall(rb"stream\r?\n(.*?)\r?\nendstream", pdf, re.DOTALL):
        try:
            content = zlib.decompress(stream)
        except zlib.error:
            continue
        for line in re.findall(rb"\[\s((?:(?:\((?:[^()\\]|\\.)*\)|[-\d.]+)\s)*)\]\sTJ", content, re.DOTALL):
            parts = re.findall(rb"\(((?:[^()\\]|\\.)*)\)", line, re.DOTALL)  # kerns between them
            plain = re.sub(rb"\\(.)", lambda escape: {b"n": b"\n", b"r": b"\r"}.get(escape[1], escape[1]), b"".join(parts), flags=re.DOTALL)
            strings.append(plain.decode("utf-16-be"))
    return " ".join(" ".join(strings).split())


def boxes(figure: plt.Figure) -> "list[tuple[str, Bbox]]":
    """Where all texts and all axes with a picture stand, in dots of 1/72 inch."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw(renderer)
    texts = list(figure.texts)
    for ax in figure.axes:
        texts += ax.texts
        for axis in (ax.xaxis, ax.yaxis) if ax.axison else ():
            low, high = sorted(axis.get_view_interval())
            texts += [tick.label1 for tick in axis.get_major_ticks() if low - 1e-9 <= tick.get_loc() <= high + 1e-9] + [axis.label]
        texts += ax.get_legend().get_texts() if ax.get_legend() else []
    found = [(text.get_text(), text.get_window_extent(renderer)) for text in texts if text.get_text().strip() and text.get_visible()]
    found += [("picture", image.get_window_extent(renderer)) for ax in figure.axes for image in ax.images]
    scale = 72 / figure.dpi
    return [(text, Bbox(box.get_points() * scale)) for text, box in found]


def is_tidy(figure: plt.Figure) -> bool:
    """No text runs into another or over the edge. Boxes have the lines' height, of which letters with descenders leave a part free."""
    found = boxes(figure)
    for text, box in found:
        assert box.x0 >= 10 and box.y0 >= 10 and box.x1 <= 585 and box.y1 <= 832, text
    for (text, box), (other, over) in itertools.combinations(found, 2):
        across = min(box.x1, over.x1) - max(box.x0, over.x0)
        down = min(box.y1, over.y1) - max(box.y0, over.y0)
        assert across < 0.5 or down < 0.25 * min(box.height, over.height), f"{text!r} and {other!r}"
    return True


def texts_of(figure: plt.Figure) -> str:
    return " ".join(" ".join(text.get_text() for text in figure.texts).split())


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


MANY = [f"{LONG} {i}".replace(" ", "_") if i % 4 == 0 else f"motion_{i}_$x^2$" for i in range(24)]
NOTES = [f"this is note {i}, which says at some length what one has to know of the joint before one trusts any number above it" for i in range(12)]


@pytest.fixture(scope="module")
def full(tmp_path_factory) -> Path:
    """Twenty-four motions with long names, twelve notes, two cuts with pictures and bands."""
    at = tmp_path_factory.mktemp("full")
    band = {"p5_deg": 20.4, "median_deg": 30, "p95_deg": 41.6}
    caveat = {"code": "soft_tissue_ends", "text": "Soft tissue ends this motion before bone does.", "source": "a study"}
    motions = [motion(name, 30.25 + i, clock_hour=i / 4, band=band, normal_range_deg=45 + i, caveats=[caveat] if i == 3 else [])
               for i, name in enumerate(MANY)]
    limits = [(name, 30.25 + i, 30.25 + 2 * i) for i, name in enumerate(MANY)]
    answer = plan(*limits, targets={name: 55.5 for name in MANY[:3]}, notes=[{"code": "n", "text": text} for text in NOTES[6:]])
    answer["cuts"].append({**answer["cuts"][0], "body": "fixed", "name": "hip_bone", "deepest_mm": 0.9, "deepest_hour": None})
    answer["targets"][0]["band"] = {"p5_deg": 31.2, "median_deg": 40, "p95_deg": 47.9}
    picture(at / "depth_mobile.png")
    picture(at / "depth_fixed.png")
    notes = [{"code": "n", "text": text} for text in NOTES[:7]]
    sigma = {"centre_mm": 0.5, "axes_deg": 1.0, "surface_mm": 0.0}
    return folder(at, resection=answer, rom=rom(*motions, band={"samples": 200, "seed": 1, "sigma": sigma}, notes=notes))


@pytest.fixture(scope="module")
def drawn(full) -> plt.Figure:
    return figures.sheet([full], case="Case 17", date="2026-11-27", note="cam on CT " * 20)


@pytest.fixture(scope="module")
def pdf(drawn) -> bytes:
    return figures.style.rendered(drawn, "pdf", DPI)


def test_a_sheet_is_one_page_with_its_fonts_in_it_and_small(pdf):
    assert len(re.findall(rb"/Type /Page\b", pdf)) == 1
    (width, height), = re.findall(rb"/MediaBox \[ 0 0 (\S+) (\S+) \]", pdf)
    assert (float(width), float(height)) == pytest.approx((210 / 25.4 * 72, 297 / 25.4 * 72))
    assert len(re.findall(rb"/FontFile2 \d+ 0 R", pdf)) == len(re.findall(rb"/Type /FontDescriptor", pdf)) >= 2
    assert len(re.findall(rb"/ToUnicode \d+ 0 R", pdf)) == len(re.findall(rb"/Subtype /Type0", pdf)) >= 2
    assert len(pdf) < 1_000_000


def test_every_limit_and_every_note_stands_in_it_as_text(pdf):
    said = said_in(pdf)
    for i, name in enumerate(MANY):
        assert figures_of(i) in said and figures.words.motion_name(name)[:20] in said
    assert f"I{LONG[1:]} 20" in said and "Motion 1 $x^2$" in said
    for note in NOTES:
        assert said.count(f"• T{note[1:]}.") == said.count(note[1:]) == 1
    for words in ("Case 17", "left hip", "a hip", "2026-11-27", "cam on CT", "PLANNED: 164 mm³ of femur and 164 mm³ of hip bone removed",
                  "30.2° (31–48)", "AAOS 1965", "Condyle 9.8.7", "hip.toml abababab, hip_bone.ply cdcdcdcd, femur.ply efefefef",
                  "Motion 3 $x^2$: Soft tissue ends this motion before bone does (a study).", "Motion 3 $x^2$ †",
                  "200 joints displaced at random, standard deviations centre 0.5 mm, axes 1°.", "Planned with a margin of 0.5 mm.",
                  "Motion 2 $x^2$ reaches 34.2° after the cut, 21.2° short of its target.",
                  "shoes 0 reaches 30.2° after the cut, 25.2° short of its target; 5 to 95 % of displaced joints reach 31 to 48°.", "the strength of the remaining bone are not modelled. Osseous contact",
                  "not a medical device", "2.74 mm at the deepest, at 2:31 of the neck", "1:30–2:00 1.9, 2:00–2:30 2.7",
                  "head neck offset at 1:30 6.4 → 8.8 mm", "12:15 (2)"):
        assert words in said, words
    assert "motion now target planned band now normal ended by clock" in said and "secret" not in said and "neck shaft" not in said


def figures_of(i: int) -> str:
    """A row of the table from its limit on."""
    target, band = ("55.5°", " (31–48)" * (i == 0)) if i < 3 else ("–", "")
    hour = f"{i // 4 or 12}:{i % 4 * 15:02d}"
    return f"{30.25 + i:.1f}° {target} {30.25 + 2 * i:.1f}°{band} 20–42° {45 + i}° impingement {hour}"


def test_nothing_overlaps_and_nothing_is_cut_off(drawn):
    assert is_tidy(drawn)


def test_notes_that_do_not_fit_in_the_smallest_type_are_counted(full, tmp_path):
    answer = json.loads((full / "rom.json").read_text())
    answer["notes"] = [{"code": "n", "text": f"{i}: {NOTES[0] * 3}"} for i in range(60)]
    figure = figures.sheet([folder(tmp_path, rom=answer)])
    said = texts_of(figure)
    left_out, = map(int, re.findall(r"(\d+) more in rom\.json\.", said))
    assert is_tidy(figure) and all(f"• {i}: " in said for i in range(61 - left_out)) and f"• {61 - left_out}: " not in said and 10 < left_out < 60


def test_what_fits_on_no_page_is_refused(tmp_path, capsys):
    many = folder(tmp_path, rom=rom(*(motion(f"motion_{i}", 30) for i in range(200))))
    with pytest.raises(SystemExit) as exit:
        main(["sheet", str(many), "--out", str(tmp_path / "a.pdf")])
    assert exit.value.code == 3 and "200 motions" in capsys.readouterr().err and not (tmp_path / "a.pdf").exists()


BEFORE, AFTER = ("flexion", 110.0, 110.0), ("fadir", 20.0, 36.0)


def case(at: Path, *motions: "dict[str, object]", plan_of: "dict[str, object] | None" = None):
    return read_case([folder(at, rom=rom(*motions), **({"resection": plan_of} if plan_of else {}))])


def test_the_motion_that_lacks_most_is_named_with_what_ends_it(tmp_path):
    parts = {"fixed": {"part": "liner"}, "mobile": {"part": "neck"}}
    motions = motion("flexion", 100, normal_range_deg=120), motion("fadir", 20, clock_hour=1.25, features=parts)
    planned = plan(("flexion", 100, 100), ("fadir", 20, 36), targets={"fadir": 35})
    for n, (motions, planned, words) in enumerate((
            (motions, planned, "FADIR lacks most of its target: 20.0° of 35°, ended by impingement of neck on liner at 1:15 of the clock."),
            (motions, None, "Flexion lacks most of its clinical range: 100.0° of 120°, ended by impingement of femur on hip bone."),
            ((motion("flexion", 125, normal_range_deg=120), motion("faber", 120, reason="end_of_range")), None,
             "No motion ends before its clinical range. FABER turns least: >120°, no contact in the range."),
            ((motion("faber", 0, reason="contact_at_start"),), None, "FABER turns least: 0.0°, in contact at the start."))):
        assert sheet_text.limited_most(sheet_text.rows_of(case(tmp_path / str(n), *motions, plan_of=planned))) == words


def test_a_plan_without_limits_has_its_own_and_one_that_removes_nothing_says_so(tmp_path):
    answer = plan(BEFORE, AFTER, targets={"fadir": 36}, cuts=[], depth_by_half_hour_mm=None)
    figure = figures.sheet([folder(tmp_path, resection=answer) / "resection.json"])
    said = texts_of(figure)
    assert "PLANNED: no bone has to go" in said and "FADIR 20.0° 36° 36.0° contact" in said and "left side · a hip" in said and not figure.axes
    assert "Planned limits have no band" in said


def test_without_a_plan_the_heading_is_of_now_and_empty_columns_are_left_out(tmp_path):
    figure = figures.sheet([folder(tmp_path, rom=rom(motion("flexion", 110, clock_hour=2), motion("extension", 20))) / "rom.json"])
    said = texts_of(figure)
    assert "NOW: limits of the joint as it is" in said and "PLANNED" not in said and "No band: condyle rom --band" in said
    assert "motion now ended by clock 1 Flexion 110.0° impingement 2:00 2 Extension 20.0° impingement, away from the rim –" in said


def test_motions_stand_in_notes_in_words_and_notes_that_two_files_have_once(tmp_path):
    note = {"code": "n", "text": "fadir and internal_rotation_at_90_flexion are far"}
    answer = plan(BEFORE, ("internal_rotation_at_90_flexion", 20, 25), targets={}, notes=[note])
    found = read_case([folder(tmp_path, rom=rom(motion("fadir", 20), notes=[note]), resection=answer)])
    assert sheet_text.notes(found) == [("FADIR and internal rotation at 90° flexion are far.", "rom.json")]


def test_results_of_two_joints_or_by_other_options_are_refused(tmp_path, capsys):
    other = plan(BEFORE, targets={})
    other["provenance"] = {**PROVENANCE, "mobile_mesh": {"path": "femur.ply", "sha256": "00" * 32}}
    for answer, words in ((other, "of another mobile mesh than"), (plan(("flexion", 95.0, 95.0), targets={}), "their options differ")):
        at = folder(tmp_path, rom=rom(motion("flexion", 110)), resection=answer)
        with pytest.raises(SystemExit) as exit:
            main(["sheet", str(at), "--out", str(tmp_path / "a.pdf")])
        error = capsys.readouterr().err
        assert exit.value.code == 3 and error.startswith(f"condyle: {at / 'resection.json'}: ") and words in error and error.count("\n") == 1


ROM = rom(motion("flexion", 110))
PLAN = plan(BEFORE, targets={"flexion": 120})


@pytest.mark.parametrize("answer, path, value", [
    (PLAN, ("limits", 0, "before", "limit_deg"), "far"), (PLAN, ("targets", 0, "reach_deg"), None), (PLAN, ("targets", 0, "band"), {"p5_deg": 1}),
    (PLAN, ("cuts", 0, "volume_mm3"), "much"), (PLAN, ("measures",), 1), (PLAN, ("margin_mm",), None), (PLAN, ("resection_notes",), [{}]),
    (ROM, ("motions", 0, "features"), 3), (ROM, ("motions", 0, "caveats"), [{"code": "a"}]), (ROM, ("band",), {"samples": 3}), (ROM, ("notes",), 3),
    (ROM, ("caveats",), [1]), (ROM, ("provenance",), 3), (ROM, ("scope",), 3), (ROM, ("fixed",), 3)])
def test_a_damaged_answer_is_one_line_that_names_its_file(tmp_path, answer, path, value):
    answer = copy.deepcopy(answer)
    *above, last = path
    at = answer
    for key in above:
        at = at[key]
    at[last] = value
    name = "resection" if "cuts" in answer else "rom"
    with pytest.raises(figures.ReadError, match=f"{name}.json: [^\n]*$"):
        figures.sheet([folder(tmp_path, **{name: answer})])


def test_help_has_the_example_and_every_option(capsys):
    for words in (["--help"], ["sheet", "--help"]):
        with pytest.raises(SystemExit) as exit:
            main(words)
        said = capsys.readouterr().out
        assert exit.value.code == 0 and 'condyle.plot sheet range plan --case "Case 17" --date 2026-11-27 --out case.pdf' in said
    assert all(option in said for option in ("--out", "--case", "--date", "--note", "--picture"))


def test_wrong_inputs_are_refused_in_one_line(tmp_path, capsys):
    at, twice = folder(tmp_path / "a", rom=ROM), folder(tmp_path / "b", rom=ROM)
    (tmp_path / "words.png").write_text("no picture")
    (tmp_path / "other.json").write_text('{"condyle": 1}')
    for arguments, code, words in (([at], 2, "--out"), (["--out", "a.pdf"], 2, "INPUT"),
                                   ([at, "--out", tmp_path / "a.doc"], 2, "a sheet is written as .pdf"),
                                   ([tmp_path, "--out", "a.pdf"], 3, "neither rom.json nor resection.json nor measures.json nor sweep.json"),
                                   ([tmp_path / "other.json", "--out", "a.pdf"], 3, "other.json: neither rom.json nor"),
                                   ([at, twice, "--out", "a.pdf"], 3, "is another rom.json"), ([tmp_path / "c", "--out", "a.pdf"], 3, "No such file"),
                                   ([at, "--picture", tmp_path / "words.png", "--out", "a.pdf"], 3, "words.png: not a PNG picture")):
        with pytest.raises(SystemExit) as exit:
            main(["sheet", *map(str, arguments)])
        error = capsys.readouterr().err
        assert exit.value.code == code and error.startswith("condyle: ") and error.count("\n") == 1 and words in error


def test_a_picture_that_is_given_takes_the_place_of_the_cuts(tmp_path):
    at = folder(tmp_path / "a", resection=plan(BEFORE, AFTER, targets={}))
    picture(at / "depth_mobile.png", 40, 30)
    given = picture(tmp_path / "mine.png", 20, 20)
    sizes = [[image.get_array().shape[:2] for ax in figures.sheet([at], picture=each).axes for image in ax.images] for each in (None, given)]
    assert sizes == [[(30, 40)], [(20, 20)]]


@pytest.mark.filterwarnings("ignore::condyle.JointWarning")
def test_a_sweep_has_its_zone_its_targets_and_a_slice_of_more_than_two_parameters(tmp_path):
    joint = condyle.sample_replacement(bones="none", facets=60).joint
    for varied in ({"cup.inclination": (30, 50, 10)}, {"cup.inclination": (30, 50, 10), "cup.anteversion": (-20, 45, 5)},
                   {"stem.version": (5, 25, 10), "cup.inclination": (30, 50, 10), "cup.anteversion": (0, 30, 10)}):
        at = tmp_path / str(len(varied))
        joint.sweep(varied, [("sitting_on_a_low_chair", "flexion", 110), ("pivoting", "external_rotation", 40)]).write(at)
        figure = figures.sheet([at / "sweep.json"])
        said = texts_of(figure)
        assert is_tidy(figure) and "NOW: the joint as it is, and designs beside it" in said and "sitting on a low chair 110°" in said
        assert "designs leave all targets free. As it is: " in said and "not from files" in said
        assert ("stem version" in said.split("Safe zone")[1].split("Notes")[0]) == (len(varied) == 3)


def test_what_the_command_writes_is_on_the_sheet(tmp_path, command, coarse_hip_file):
    """The writers are C++: a key that one of them renames is detected here."""
    for name, *options in (["rom", "--band=20"], ["resect", "--reach", "fadir=48", "--curve", "0"], ["measure"]):
        subprocess.run([command, name, coarse_hip_file, *options, "--out", tmp_path], check=True, capture_output=True)
    rom, plan = (json.loads((tmp_path / f"{name}.json").read_text()) for name in ("rom", "resection"))
    found = read_case([tmp_path])
    assert list(found.paths) == ["rom", "plan", "measures"]
    figure = figures.sheet([tmp_path / "measures.json", tmp_path / "rom.json", tmp_path / "resection.json"])
    said = texts_of(figure)
    assert is_tidy(figure) and len([ax for ax in figure.axes if ax.images]) == 1
    for limit, changed in zip(rom["motions"], plan["limits"]):
        assert limit["name"] == changed["motion"] and figures.words.motion_name(limit["name"]) in said
        if limit["reason"] == "contact":
            assert f"{limit['limit_deg']:.1f}°" in said and f"{changed['after']['limit_deg']:.1f}°" in said
    assert f"{plan['cuts'][0]['volume_mm3']:.1f} mm³ of femur" in said and f"{plan['cuts'][0]['deepest_mm']:.2f} mm at the deepest" in said
    assert "FADIR reaches 48.0° after the cut, its target of 48°." in said and all(note.text in said for note in sheet_text.notes(found))
    assert "• Femoral version: the mesh ends above the knee" in said
    assert rom["provenance"]["mobile_mesh"]["sha256"][:8] in said and "alpha at 1:30 " in said and " (30–66)" in said
