"""A case on paper: a first page to decide by, text that can be selected, nothing over anything else, nothing cut off, nothing left out."""
import copy
import json
import re
import zlib
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text
from matplotlib.transforms import Bbox
from test_plot_folders import is_refused, run
from common import refused, run_command
from drawn import are_tidy

import condyle
import condyle.plot as figures
from condyle.plot import sheet_text
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
    return {**COMMON, "margin_mm": 0.5, "limits": list(found.values()), "cuts": [cut], "depth_by_half_hour_mm": depths, "resection_notes": [],
            "notes": [], "caveats": ["osseous only: labrum, cartilage, capsule and the strength of the remaining bone are not modelled"],
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


def is_tidy(pages: "list[plt.Figure]") -> bool:
    """No text runs into another or over the edge, none is small."""
    for figure in pages:
        assert min(text.get_fontsize() for text in figure.findobj(Text) if text.get_text().strip()) >= 7
        assert are_tidy(boxes(figure), Bbox([[10, 10], [585, 832]]))
    return True


def texts_of(pages: "list[plt.Figure]") -> str:
    return " ".join(" ".join(text.get_text() for page in pages for text in page.texts).split())


MANY = [f"{LONG} {i}".replace(" ", "_") if i % 4 == 0 else f"motion_{i}_$x^2$" for i in range(24)]
CODES = ["neck_is_narrowed", "cut_by_view", "target_blocked", "low_coverage", "open_mesh", "no_head"]
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
    answer["resection_notes"] = [{"code": code, "text": f"{code} may change a decision"} for code in CODES]
    answer["cuts"].append({**answer["cuts"][0], "body": "fixed", "name": "hip_bone", "deepest_mm": 0.9, "deepest_hour": 1.5, "depth_by_half_hour_mm": [0.0, 0.0, 0.4, 0.9] + [0.0] * 20})
    answer["targets"][0].update(band={"p5_deg": 31.2, "median_deg": 40, "p95_deg": 47.9},
                                other_centre={"centre": "socket", "before_deg": 18.04, "after_deg": 25.06, "is_decided": False})
    picture(at / "depth_mobile.png")
    picture(at / "depth_fixed.png")
    notes = [{"code": "n", "text": text} for text in NOTES[:7]]
    sigma = {"centre_mm": 0.5, "axes_deg": 1.0, "surface_mm": 0.0}
    return folder(at, resection=answer, rom=rom(*motions, band={"samples": 200, "seed": 1, "sigma": sigma}, notes=notes))


@pytest.fixture(scope="module")
def drawn(full) -> "list[plt.Figure]":
    return figures.sheet([full], case="Case 17", date="2026-11-27", note="cam on CT " * 20)


@pytest.fixture(scope="module")
def pdf(drawn) -> bytes:
    return figures.style.rendered_pages(drawn, DPI)


def test_pages_are_a4_with_their_fonts_in_the_file_and_small(pdf, drawn):
    assert len(re.findall(rb"/Type /Page\b", pdf)) == len(drawn) > 1
    for width, height in re.findall(rb"/MediaBox \[ 0 0 (\S+) (\S+) \]", pdf):
        assert (float(width), float(height)) == pytest.approx((210 / 25.4 * 72, 297 / 25.4 * 72))
    assert len(re.findall(rb"/FontFile2 \d+ 0 R", pdf)) == len(re.findall(rb"/Type /FontDescriptor", pdf)) >= 2
    assert len(re.findall(rb"/ToUnicode \d+ 0 R", pdf)) == len(re.findall(rb"/Subtype /Type0", pdf)) >= 2
    assert len(pdf) < 2 * (110 / 25.4 * DPI) * (82.5 / 25.4 * DPI) * 3 + 100_000  # two pictures of noise, three bytes a point


def test_every_limit_and_every_note_stands_in_it_as_text(pdf):
    said = said_in(pdf)
    for i, name in enumerate(MANY):
        assert figures_of(i) in said and figures.words.motion_name(name)[:20] in said
    assert f"I{LONG[1:]} 20" in said and "Motion 1 $x^2$" in said
    for note in NOTES:
        assert said.count(note[1:]) == 1
    assert said.count("may change a decision") == len(CODES) and f"After the cut: T{NOTES[9][1:]}" in said
    for words in ("Case 17", "left hip", "a hip", "2026-11-27", "cam on CT", "TARGET NOT REACHED: 164 mm³ of femur and 164 mm³ of hip bone removed",
                  "AAOS 1965", "Condyle 9.8.7", "hip.toml abababab, hip_bone.ply cdcdcdcd, femur.ply efefefef",
                  "Motion 3 $x^2$: Soft tissue ends this motion before bone does (a study).", "Motion 3 $x^2$ †",
                  "200 varied joints, standard deviations centre 0.5 mm, axes 1°.", "Green needs 50 % of varied joints that reach every target; the bone that stays keeps clear of the other bone's surface by a margin of 0.5 mm.",
                  "Cut of femur, depth in mm; hip bone overleaf", "at 1:30 of the socket's clock. Largest depth by the socket's clock (12 superior, 3 anterior), mm: 1:00–1:30 0.4, 1:30–2:00 0.9.",
                  "Motion 2 $x^2$: After the cut it ends at 34.2°, 21.2° short of its target of 55.5°; in how many varied joints was not computed.",
                  "5 to 95 % of varied joints reach 31 to 48°.", "the strength of the remaining bone are not modelled.",
                  "Osseous contact of the meshes given; soft tissue is not modelled; research software, not a medical device.", "2.7 mm at the deepest, at 2:31 of the neck's clock", "1:30–2:00 1.9, 2:00–2:30 2.7",
                  "head neck offset at 1:30 6.4 → 8.8 mm", "12:15 (2)"):
        assert words in said, words
    assert "motion now target planned socket's centre ended by (socket's clock)" in said and "secret" not in said and "neck shaft" not in said


def figures_of(i: int) -> str:
    """A row of the table from its limit on: bands in both columns, or in neither if the cut moves what has one before it only."""
    target, now, then = "55.5°" if i < 3 else "–", " (20–42)" * (i == 0), " (20–42) 18.0 → 25.1°" if i == 0 else " –"
    return f"{30.25 + i:.1f}°{now} {target} {30.25 + 2 * i:.1f}°{then} impingement, {i // 4 or 12}:{i % 4 * 15:02d}"


def test_nothing_overlaps_nothing_is_cut_off_and_no_letter_is_below_7_points(drawn):
    assert is_tidy(drawn)


def test_the_first_page_has_the_five_gravest_notes_and_any_number_follows(full, tmp_path, drawn):
    first = [text.split(" may")[0].lower() for text in texts_of(drawn[:1]).split("• ")[1:]]
    assert first == ["target_blocked", "neck_is_narrowed", "cut_by_view", "no_head", "low_coverage"]
    answer = json.loads((full / "rom.json").read_text())
    answer["notes"] = [{"code": "open_mesh" if i < 5 else "n", "text": f"{i}: {NOTES[0] * (60 if i == 7 else 18)}"} for i in range(30)]
    pages = figures.sheet([folder(tmp_path, rom=answer)])
    assert is_tidy(pages) and 1 < texts_of(pages[:1]).count("• ") < 5 and all(f"• {i}: " in texts_of(pages) for i in range(30))


def test_what_leaves_no_room_on_the_first_page_is_refused_and_many_motions_go_on_behind_it(tmp_path):
    many = folder(tmp_path, rom=rom(*(motion(f"motion_{i}", 30) for i in range(70))))
    ran = run("sheet", many, "--out", tmp_path / "a.png")
    assert (ran.returncode, ran.stdout.split()) == (0, [str(tmp_path / name) for name in ("a.png", "a-2.png")])
    ran = run("sheet", many, "--note", LONG * 60, "--out", tmp_path / "a.pdf")
    assert is_refused(ran, 3, "no room for its limits") and not (tmp_path / "a.pdf").exists()


BEFORE, AFTER = ("flexion", 110.0, 110.0), ("fadir", 20.0, 36.0)


def case(at: Path, *motions: "dict[str, object]", plan_of: "dict[str, object] | None" = None):
    return read_case([folder(at, rom=rom(*motions), **({"resection": plan_of} if plan_of else {}))])


def test_without_a_plan_the_verdict_is_on_what_lacks_most(tmp_path):
    bone = {"healthy_deg": 27.9, "is_short": True}
    short = motion("internal_rotation_at_90_flexion", 12, bone_reference=bone, clock_hour=1.25)
    flexion = motion("flexion", 100, normal_range_deg=120)
    fine = motion("internal_rotation_at_90_flexion", 32, bone_reference={**bone, "is_short": False})
    parts = {"fixed": {"part": "liner"}, "mobile": {"part": "neck"}}
    for n, (motions, words) in enumerate((
            ((flexion, short), "Flexion ends at 100.0°, femur on hip bone, 20° short of the clinical 120°."),
            ((short,), "Internal rotation at 90° flexion ends at 12.0°, femur on hip bone at 1:15 of the socket's clock, 15.9° short of the 27.9° of simulated "
             "healthy hips."),
            ((motion("flexion", 125, normal_range_deg=120), fine), "Internal rotation at 90° flexion ends at 32.0°, femur on hip bone. No motion ends before its "
             "clinical range or the 27.9° of simulated healthy hips."),
            ((motion("fadir", 20, features=parts),), "FADIR ends at 20.0°, neck on liner."),
            ((motion("faber", 120, reason="end_of_range", normal_range_deg=130),), "No contact ends any of these motions in its range. FABER is free to 120°, where its range ends."),
            ((motion("faber", 0, reason="contact_at_start"),), "FABER ends at 0.0°, in contact at the start."))):
        found = case(tmp_path / str(n), *motions)
        assert sheet_text.heading(found)[0] == "NOW: limits of the joint as it is; nothing is planned"
        assert " ".join(sheet_text.verdict(found, sheet_text.rows_of(found))).startswith(words)


BAND = {"p5_deg": 27.0, "median_deg": 36.2, "p95_deg": 44.0, "text": "27–44"}
OTHER = {"centre": "socket", "before_deg": 15.0, "after_deg": 25.1, "is_decided": False}


@pytest.mark.parametrize("after, target, more, ribbon, promise", [
    (36, {"confidence_reached": 0.5, "band": BAND, "text": "reaches 36.0 in 50 % of 200 varied hips, 164 mm3"}, {}, "PLANNED: 164 mm³ of femur removed",
     "reaches 36.0 in 50 % of 200 varied hips, 164 mm³."),
    (36, {"confidence_reached": 0.5, "band": BAND, "other_centre": OTHER, "text": "36.0 deg about the head's centre, 25.1 about the socket's: not decided"}, {},
     "NOT DECIDED: 164 mm³ of femur removed may not be enough", "36.0° about the head's centre, 25.1 about the socket's: not decided."),
    (36, {"confidence_reached": 0.5, "band": BAND, "other_centre": OTHER, "is_plan": False, "text": "no plan"}, {},
     "NO PLAN: 164 mm³ of femur removed may gain nothing", " No plan."),
    (36, {"confidence_reached": 0.15, "band": BAND, "text": "t"}, {}, "NOT DECIDED: 164", "t."),
    (30, {"confidence_reached": 0.5, "band": BAND, "text": "t"}, {}, "TARGET NOT REACHED: 164 mm³ of femur removed", "t."),
    (36, {"band": {**BAND, "median_deg": 33.0}}, {}, "NOT DECIDED: 164", "ends at 36.0°, which reaches its target of 36°; 5 to 95 % of varied joints reach 27 to 44°."),
    (36, {"band": BAND}, {}, "PLANNED: 164", "5 to 95 % of varied joints reach 27 to 44°."),
    (36, {}, {}, "NOT DECIDED: 164", "ends at 36.0°, which reaches its target of 36°; in how many varied joints was not computed."),
    (36, {}, {"cuts": []}, "NOTHING TO REMOVE: targets are reached as it is", "in how many varied joints was not computed.")])
def test_a_plan_is_called_what_both_centres_and_varied_joints_leave_of_it(tmp_path, after, target, more, ribbon, promise):
    """Files of earlier versions lack keys."""
    answer = plan(BEFORE, ("fadir", 20.0, after), targets={"fadir": 36}, confidence=0.5, **more)
    answer["targets"][0].update(target, before_band=BAND)
    found = case(tmp_path, motion("flexion", 110), motion("fadir", 20), plan_of=answer)
    rows = sheet_text.rows_of(found)
    assert sheet_text.heading(found)[0].startswith(ribbon) and sheet_text.headline(found, rows) is rows[1]
    assert sheet_text.verdict(found, rows)[0] == "FADIR ends at 20.0° (27–44), femur on hip bone." and f" {sheet_text.verdict(found, rows)[1]}".endswith(promise)
    assert [bool(end.band) for end in rows[1].ends] == [bool(target.get("band"))] * 2


def test_a_motion_that_gains_nothing_ends_where_it_did_and_columns_say_whose_numbers_they_hold(tmp_path):
    band = {"p5_deg": 88.0, "median_deg": 120, "p95_deg": 120, "text": "88–>120"}
    people = {"who": "clinical estimate", "source": "AAOS 1965"}
    motions = (motion("internal_rotation", 102.557), motion("extension", 72.7, normal_range_deg=30, living={"text": "clinical 30", "expected_deg": None, "people": people}),
               motion("faber", 120, reason="end_of_range", range_deg=120, band=band))
    answer = plan(("internal_rotation", 102.557, 104.12), ("extension", 72.7, 72.7), targets={})
    answer["limits"][0]["gain_deg"] = 0.0  # what finer triangles of the same surface add is no gain
    pages = figures.sheet([folder(tmp_path, rom=rom(*motions), resection=answer)])
    said = texts_of(pages)
    assert "Internal rotation 102.6° 102.6° – impingement" in said and "FABER >120° (88–>120) – – no contact" in said and "Extension 72.7° 72.7° clinical 30" in said
    assert [text.get_color() for text in pages[0].texts if text.get_text() == "clinical 30"] == [figures.style.GREY]
    assert "Extension: living hips from clinical estimate (AAOS 1965)." in said


def test_columns_are_those_that_a_plan_without_limits_and_limits_without_a_plan_have(tmp_path):
    answer = plan(BEFORE, AFTER, targets={"fadir": 36}, cuts=[], depth_by_half_hour_mm=None, measures=None)
    said = texts_of(figures.sheet([folder(tmp_path, resection=answer) / "resection.json"]))
    assert "NOTHING TO REMOVE: targets are reached as it is" in said and "FADIR 20.0° 36° 36.0° contact" in said and "left side · a hip" in said
    said = texts_of(figures.sheet([folder(tmp_path, rom=rom(motion("flexion", 110, clock_hour=2), motion("extension", 20))) / "rom.json"]))
    assert "PLANNED" not in said and "No band: condyle rom --band" in said
    assert "motion now ended by (socket's clock) 1 Flexion 110.0° impingement, 2:00 2 Extension 20.0° impingement, away from the rim" in said


def test_motions_stand_in_notes_in_words_and_notes_that_two_files_have_once(tmp_path):
    note = {"code": "n", "text": "fadir and internal_rotation_at_90_flexion are far"}
    answer = plan(BEFORE, ("internal_rotation_at_90_flexion", 20, 25), targets={}, notes=[note])
    found = read_case([folder(tmp_path, rom=rom(motion("fadir", 20), notes=[note]), resection=answer)])
    assert [note.text for note in sheet_text.notes(found)][0] == "FADIR and internal rotation at 90° flexion are far."


def test_results_of_two_joints_or_by_other_options_are_refused(tmp_path):
    other = plan(BEFORE, targets={})
    other["provenance"] = {**PROVENANCE, "mobile_mesh": {"path": "femur.ply", "sha256": "00" * 32}}
    for answer, words in ((other, "of another mobile mesh than"), (plan(("flexion", 95.0, 95.0), targets={}), "their options differ")):
        at = folder(tmp_path, rom=rom(motion("flexion", 110)), resection=answer)
        assert is_refused(run("sheet", at, "--out", tmp_path / "a.pdf"), 3, words, f"{at / 'resection.json'}: ")


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
    refused(lambda: figures.sheet([folder(tmp_path, **{name: answer})]), f"{name}.json: [^\n]*$", figures.ReadError)


def test_help_has_the_example_and_every_option():
    for words in (["--help"], ["sheet", "--help"]):
        ran = run(*words)
        assert ran.returncode == 0 and 'condyle.plot sheet range plan --case "Case 17" --date 2026-11-27 --out case.pdf' in ran.stdout
    assert all(option in ran.stdout for option in ("--out", "--case", "--date", "--note", "--picture"))


def test_wrong_inputs_are_refused_in_one_line(tmp_path):
    at, twice = folder(tmp_path / "a", rom=ROM), folder(tmp_path / "b", rom=ROM)
    (tmp_path / "words.png").write_text("no picture")
    (tmp_path / "other.json").write_text('{"condyle": 1}')
    for arguments, code, words in (([at], 2, "--out"), (["--out", "a.pdf"], 2, "INPUT"),
                                   ([at, "--out", tmp_path / "a.doc"], 2, "a sheet is written as .pdf or .png"),
                                   ([tmp_path, "--out", "a.pdf"], 3, "neither rom.json nor resection.json nor measures.json nor sweep.json"),
                                   ([tmp_path / "other.json", "--out", "a.pdf"], 3, "other.json: neither rom.json nor"),
                                   ([at, twice, "--out", "a.pdf"], 3, "is another rom.json"), ([tmp_path / "c", "--out", "a.pdf"], 3, "No such file"),
                                   ([at, "--picture", tmp_path / "words.png", "--out", "a.pdf"], 3, "words.png: not a PNG picture")):
        assert is_refused(run("sheet", *arguments), code, words)


def test_a_picture_that_is_given_takes_the_place_of_the_cuts(tmp_path):
    at = folder(tmp_path / "a", resection=plan(BEFORE, AFTER, targets={}))
    picture(at / "depth_mobile.png", 40, 30)
    given = picture(tmp_path / "mine.png", 20, 20)
    sizes = [[image.get_array().shape[:2] for ax in figures.sheet([at], picture=each)[0].axes for image in ax.images] for each in (None, given)]
    assert sizes == [[(30, 40)], [(20, 20)]]


@pytest.mark.filterwarnings("ignore::condyle.JointWarning")
def test_a_sweep_has_its_zone_its_targets_and_a_slice_of_more_than_two_parameters(tmp_path):
    joint = condyle.sample_replacement(bones="none", facets=60).joint
    for varied in ({"cup.inclination": (30, 50, 10)}, {"cup.inclination": (30, 50, 10), "cup.anteversion": (-20, 45, 5)},
                   {"stem.version": (5, 25, 10), "cup.inclination": (30, 50, 10), "cup.anteversion": (0, 30, 10)}):
        at = tmp_path / str(len(varied))
        joint.sweep(varied, [("sitting_on_a_low_chair", "flexion", 110), ("pivoting", "external_rotation", 40)]).write(at)
        pages = figures.sheet([at / "sweep.json"])
        said = texts_of(pages)
        assert is_tidy(pages) and "NOW: the joint as it is, and designs beside it" in said and "sitting on a low chair 110°" in said
        assert "designs leave all targets free. As it is: " in said and "not from files" in said
        assert ("stem version" in said.split("Safe zone")[1].split("Notes")[0]) == (len(varied) == 3)


def test_what_the_command_writes_is_on_the_sheet(tmp_path, coarse_hip_file):
    """The writers are C++: a key that one of them renames is detected here."""
    for name, *options in (["rom", "--band=20"], ["resect", "--reach", "fadir=48", "--curve", "0"], ["measure"]):
        run_command(name, coarse_hip_file, *options, "--out", tmp_path / name)
    paths = [tmp_path / name for name in ("measure/measures.json", "rom/rom.json", "resect/resection.json")]
    rom, plan = (json.loads(path.read_text()) for path in paths[1:])
    found = read_case([tmp_path / name for name in ("measure", "rom", "resect")])
    assert list(found.paths) == ["rom", "plan", "measures"]
    pages = figures.sheet(paths)
    said = texts_of(pages)
    assert is_tidy(pages) and len([ax for page in pages for ax in page.axes if ax.images]) == 1
    for limit, changed in zip(rom["motions"], plan["limits"]):
        assert limit["name"] == changed["motion"] and figures.words.motion_name(limit["name"]) in said
        if limit["reason"] == "contact":
            assert f"{limit['limit_deg']:.1f}°" in said and (changed["gain_deg"] < 0.05 or f"{changed['after']['limit_deg']:.1f}°" in said)
    assert f"{plan['cuts'][0]['volume_mm3']:.0f} mm³ of femur" in said and f"{plan['cuts'][0]['deepest_mm']:.1f} mm at the deepest" in said
    assert "After the cut it " in said and all(note.text in said for note in sheet_text.notes(found))
    assert "• Femoral version: the mesh ends above the knee" in said
    assert rom["provenance"]["mobile_mesh"]["sha256"][:8] in said and "alpha at 1:30 " in said and " (30–66)" in said
