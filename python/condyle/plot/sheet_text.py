"""What the sheet of a case says in words and figures, without where it stands."""
from __future__ import annotations

import re
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

from . import style
from .case_files import Case, inputs_of, provenance_of
from .limit_bars import ENDS, ends_of, value_text
from .motion_ends import MotionEnd
from .rim_clock import clock_text
from .words import MINUS, capitalised, in_sentence, motion_name, number, spaced

CHANGED_DEG = 0.05
"""Limits that differ by less are printed alike."""

CONTACTS = ("impingement", "contact")
"""Ends at which the bodies are named that meet."""

FREE = ("end_of_range", "translation_ends")
"""Ends at which nothing was met."""

DECIDE = ("wrong_side", "unlikely_version", "swapped_bodies", "same_mesh", "units_disagree", "unlikely_size", "axes_turned", "axes_not_upright", "unlikely_joint", "target_blocked",
          "stopped", "band_not_reached", "neck_is_narrowed", "bones_touch", "pieces_left_out", "gap_in_bone", "interpolated_labels", "head_not_round", "two_voxel_sizes", "touching", "thick_slices", "cut_by_view", "flat_end", "limit_on_cut", "limit_on_part_cut", "limit_on_piece", "head_socket_apart", "centre_moves_limits", "centre_off_head", "no_head", "low_coverage", "inverted_mesh", "open_mesh", "doubled_triangles",
          "self_crossings", "coarse_mesh", "bearing_is_swept", "burr_meets_kept", "narrow_bearing_margin", "alpha_stays", "more_than_must", "caveat")
"""Codes of notes that may change whether and how one cuts, the gravest first: at most five stand on the first page."""


class Row(NamedTuple):
    """A motion: where it ends now, the bodies or meshes that meet there, what is asked for, where it ends after the cut, and what is known of living hips."""

    now: MotionEnd
    pair: str
    is_of_parts: bool
    target: Optional[Dict[str, Any]]
    after: Optional[MotionEnd]
    gain_deg: float
    limit: Dict[str, Any]

    @property
    def is_changed(self) -> bool:
        """Whether the cut changes the limit: what smaller triangles around it change is no gain."""
        return abs(self.gain_deg) >= CHANGED_DEG

    @property
    def ends(self) -> List[MotionEnd]:
        """Now and, of a plan, after the cut: both with their bands, or neither."""
        ends = [self.now, *([self.after] if self.after else [])]
        return ends if all(end.band for end in ends) else [end._replace(band=None) for end in ends]

    @property
    def living(self) -> Tuple[str, bool]:
        """As in `rom`'s column of living hips, with what bone of simulated ones leaves, and whether that is a clinical range only."""
        text, bone = str((self.limit.get("living") or {}).get("text", "")).strip("-"), self.limit.get("bone_reference")
        return "; ".join(filter(None, (text, bone and f"simulated {bone['healthy_deg']:g}"))), text.startswith("clinical") and not bone

    @property
    def lacks(self) -> Tuple[float, str]:
        """By how much it ends before its target; without one before bone of healthy hips, if it is as short as with a cam, or its clinical range."""
        bone = self.limit.get("bone_reference") or {}
        deg, of = ((self.target["reach_deg"], "its target of {}") if self.target else (bone["healthy_deg"], "the {} of simulated healthy hips") if bone.get("is_short")
                   else (self.now.normal_deg, "the clinical {}"))
        if deg is None or self.now.end in FREE:
            return 0.0, ""
        return deg - self.now.turned_deg, of.format(degrees_text(deg))


def _ends(plan: Dict[str, Any], when: str, band: str) -> Dict[str, MotionEnd]:
    """Files of earlier versions have bands of targets only, or none."""
    bands = {each["motion"]: each.get(band) for each in plan["targets"]}
    listed = [{"name": each["motion"], "band": each.get(band) or bands.get(each["motion"]), **each[when]} for each in plan["limits"]]
    return {end.name: end for end in ends_of({"motions": listed})} if listed else {}


def _meeting(answer: Dict[str, Any], motion: Dict[str, Any]) -> Tuple[str, bool]:
    """The bodies that meet, or if known their meshes; and whether it is the meshes."""
    features = motion.get("features") or {}
    meshes = [(features.get(body) or {}).get("part") for body in ("mobile", "fixed")]
    bodies = (mesh or answer.get(body) or body for mesh, body in zip(meshes, ("mobile", "fixed")))
    return " on ".join(map(spaced, bodies)), any(meshes)


def rows_of(case: Case) -> List[Row]:
    """The motions of the limits, then those that only the plan has. Where the cut changes nothing, the end after it is that before."""
    plan = case.plan or {"limits": [], "targets": []}
    targets = {each["motion"]: each for each in plan["targets"]}
    before, after = _ends(plan, "before", "before_band"), _ends(plan, "after", "band")
    rows = [(end, *_meeting(case.rom, motion), motion) for end, motion in zip(ends_of(case.rom), case.rom["motions"])] if case.rom else []
    known = {end.name for end, *_ in rows}
    rows += [(end, *_meeting(plan, {}), {}) for name, end in before.items() if name not in known]
    # Files of earlier versions have no gains.
    gains = {each["motion"]: each.get("gain_deg", each["after"]["limit_deg"] - each["before"]["limit_deg"]) for each in plan["limits"]}
    found = []
    for end, pair, is_of_parts, limit in rows:
        now = end._replace(band=end.band or (before[end.name].band if end.name in before else None))
        then, gain = after.get(end.name), gains.get(end.name, 0.0)
        found.append(Row(now, pair, is_of_parts, targets.get(end.name), now if then and abs(gain) < CHANGED_DEG else then, gain, limit))
    return found


def patient_line(case: Case, name: str, date: str) -> str:
    """Whose joint it is, as given and as the files say."""
    _, answer = case.answers()[0]
    anatomy = next((each["anatomy"] for _, each in case.answers() if isinstance(each.get("anatomy"), str)), "")
    side = " ".join(filter(None, (answer.get("side"), anatomy or "side")))
    return "  ·  ".join(filter(None, (name, side if answer.get("side") else anatomy, answer["joint"], date)))


def degrees_text(degrees: float) -> str:
    """ "45°", "42.6°": that of a gain has many digits."""
    return f"{number(round(degrees, 1))}°"


def volume_text(cut: Dict[str, Any]) -> str:
    """ "164 mm³ of femur"."""
    return f"{cut['volume_mm3']:.{0 if cut['volume_mm3'] >= 100 else 1}f} mm³ of {spaced(cut['name'])}"


def _doubts(plan: Dict[str, Any], target: Dict[str, Any]) -> Tuple[bool, bool, bool]:
    """Whether the planned joint ends before the target; is no plan, as about the other centre it ends before today's limit; or is not decided: about
    that centre, or as fewer varied joints reach the target than asked for, half if that is not said, or nobody knows how many."""
    reach, band, share = target["reach_deg"] - CHANGED_DEG, target["band"], target.get("confidence_reached")
    is_rare = share < (plan.get("confidence") or 0.5) - 1e-9 if share is not None else band["median_deg"] <= reach if band else bool(_cuts(plan))
    return target["after"]["limit_deg"] <= reach, not target.get("is_plan", True), is_rare or not (target.get("other_centre") or {"is_decided": True})["is_decided"]


def heading(case: Case) -> Tuple[str, str]:
    """What the sheet shows in a line, with its colour: a plan, if it is one, or the joint as it is."""
    if case.plan is None:
        beside = ", and designs beside it" if case.sweep else "; nothing is planned" * bool(case.rom)
        return f"NOW: {'limits of ' if case.rom else ''}the joint as it is{beside}", "#555555"
    cuts = _cuts(case.plan)
    said = "TARGET NOT REACHED: {} removed", "NO PLAN: {} removed may gain nothing", "NOT DECIDED: {} removed may not be enough"
    for words, is_so in zip(said, max((_doubts(case.plan, target) for target in case.plan["targets"]), default=())):
        if is_so:
            return words.format(cuts or "no bone"), style.VERMILION
    return (f"PLANNED: {cuts} removed", "#00704f") if cuts else ("NOTHING TO REMOVE: targets are reached as it is", "#555555")


def _cuts(plan: Dict[str, Any]) -> str:
    return " and ".join(volume_text(cut) for cut in plan["cuts"] if cut["volume_mm3"] > 0)


def headline(case: Case, rows: List[Row]) -> Row:
    """The motion that the sheet speaks of: of the targets the one most in doubt, else what lacks most; else of a hip rotation in flexion, else what turns
    least."""
    if case.plan and case.plan["targets"]:
        plan = case.plan
        return max((row for row in rows if row.target), key=lambda row: (_doubts(plan, row.target or {}), row.lacks[0]))
    most = max(rows, key=lambda row: row.lacks[0])
    if most.lacks[0] >= CHANGED_DEG:
        return most
    ending = [row for row in rows if row.now.end not in FREE] or rows
    return next((row for row in ending if row.now.name == "internal_rotation_at_90_flexion"), min(ending, key=lambda row: row.now.turned_deg))


def verdict(case: Case, rows: List[Row]) -> List[str]:
    """What limits the joint; what the plan gives, and whether that is decided."""
    row = headline(case, rows)
    name, (lacks, wanted) = motion_name(row.now.name), row.lacks
    where = f" at {clock_text(row.now.hour)} of the socket's clock" if row.now.hour is not None else ""
    how = f"{row.pair}{where}" if row.now.end in CONTACTS else ENDS[row.now.end].words
    short = f", {degrees_text(lacks)} short of {wanted}" if lacks >= CHANGED_DEG and not row.target else ""
    first = f"{name} ends at {value_text(row.now)}, {how}{short}."
    if row.now.end in FREE:
        alone = "" if any(each.now.end not in FREE for each in rows) else "No contact ends any of these motions in its range. "
        first = f"{alone}{name} is free to {degrees_text(row.now.turned_deg)}, where its range ends."
    if case.plan and row.target:
        return [first, _promise(case.plan, row.target)]
    compared = ["its clinical range"] * any(each.now.normal_deg is not None for each in rows)
    compared += [f"the {bone['healthy_deg']:g}° of simulated healthy hips" for each in rows for bone in (each.limit.get("bone_reference"),)
                 if bone and each.now.turned_deg >= bone["healthy_deg"]]
    return [first, f"No motion ends before {' or '.join(compared)}."] if compared and lacks < CHANGED_DEG and row.now.end not in FREE else [first]


def _promise(plan: Dict[str, Any], target: Dict[str, Any]) -> str:
    """How far the plan goes, in how many varied joints, and about which centre, in the words of every shell; of files of earlier versions what they have."""
    lacks, band, text = target["reach_deg"] - target["after"]["limit_deg"], target["band"], target.get("text")
    if not text:
        reach = f"{lacks:.1f}° short of" if lacks >= CHANGED_DEG else "which reaches"
        text = f"ends at {target['after']['limit_deg']:.1f}°, {reach} its target of {degrees_text(target['reach_deg'])}"
        text += f"; 5 to 95 % of varied joints reach {band['p5_deg']:.0f} to {band['p95_deg']:.0f}°" if band else ""
    text += "; in how many varied joints was not computed" * (band is None)
    begin, said = "After the cut" if _cuts(plan) else "As it is", text.replace(" deg", "°").replace("mm3", "mm³")
    return f"{capitalised(said) if target.get('is_plan') is False else f'{begin} it {said}'}."


def other_targets(case: Case, first: str) -> List[str]:
    """What the plan gives of all targets but the first."""
    return [f"{motion_name(target['motion'])}: {_promise(case.plan, target)}" for target in case.plan["targets"] if target["motion"] != first] if case.plan else []


def how_planned(plan: Dict[str, Any]) -> str:
    """The share that makes a plan's ribbon green, and the margin."""
    share, margin = plan.get("confidence"), number(round(plan["margin_mm"], 2))
    keeps = f"; {'for that ' if share else ''}the bone that stays keeps clear of the other bone's surface by a margin of {margin} mm" * (plan["margin_mm"] > 0)
    return f"Green needs {100 * (share or 0.5):g} % of varied joints that reach every target{keeps}."


def how_sure(case: Case, rows: List[Row]) -> str:
    """What the bands are of, and which there are not."""
    said = ["Limits are bounded or searched for, not exact."] if case.rom and case.rom.get("exact") is False else []
    band = case.rom and case.rom.get("band")
    if band:
        units = {"deg": "°", "mm": " mm"}
        sigmas = [f"{name} {number(value)}{units[unit]}" for key, value in band["sigma"].items() if key.endswith(("_deg", "_mm")) and value
                  for name, _, unit in (key.rpartition("_"),)]
        sigmas += [f"{spaced(name).replace('.', ' ')} {number(value)}" for name, value in band["sigma"].get("parameters", {}).items()]
        said.append(f"Band: 5 to 95 % of {band['samples']} varied joints, standard deviations {', '.join(sigmas)}.")
    elif case.rom:
        said.append("No band: condyle rom --band computes how far limits move in varied joints.")
    alone = [in_sentence(row.now.name) for row in rows if row.is_changed and row.now.band and not (row.after and row.after.band)]
    return " ".join(said + [f"No bands of {', '.join(alone)}: after the cut only those of targets are computed."] * bool(alone))


def _changes(plan: Dict[str, Any]) -> Dict[str, Tuple[float, float]]:
    """Measures that print otherwise after the cut."""
    known = {each["key"]: (each["before"], each["after"]) for each in plan["measures"] or [] if None not in (each["before"], each["after"])}
    return {key: (before, after) for key, (before, after) in known.items() if f"{before:.1f}" != f"{after:.1f}"}


def _measure_name(key: str) -> Tuple[str, str]:
    """Words and unit: "head neck offset at 1:30", " mm" of "head_neck_offset_1_30_mm"."""
    words, _, unit = key.rpartition("_")
    name, unit = (words, {"deg": "°", "mm": " mm"}[unit]) if unit in ("deg", "mm") else (key, "")
    return spaced(re.sub(r"_(12|3|1_30)(?=_|$)", lambda hour: f"_at_{hour[1].replace('_', ':')}{'' if '_' in hour[1] else ':00'}", name)), unit


def shape(case: Case) -> str:
    """The measures that have a range of other people, or that the cut changes; and the largest alpha, of which notes speak."""
    measures = {key: each for key, each in case.measures["measures"].items() if each.get("value") is not None} if case.measures else {}
    changes = _changes(case.plan) if case.plan else {}
    ranges = {key: each["normal"] or each["patients"] for key, each in measures.items() if each["normal"] or each["patients"]}
    said = []
    for key in dict.fromkeys((*ranges, *changes, *({"alpha_largest_deg"} & measures.keys()))):
        name, unit = _measure_name(key)
        value = " → ".join(f"{each:.1f}".replace("-", MINUS) for each in changes.get(key, [measures[key]["value"]] if key in measures else []))
        span = ranges.get(key)
        patients = " in patients" if span and not measures[key]["normal"] else ""
        said.append(f"{name} {value}{unit}" + (f" ({number(span['low'])}–{number(span['high'])}{patients})" if span else ""))
    keys = ", ".join(["other people in brackets"] * bool(ranges) + ["→ after the cut"] * bool(changes))
    return f"Shape ({keys}): {'; '.join(said)}." if said else ""


def sweep_line(sweep: Dict[str, Any]) -> str:
    """How many designs are safe, which is the one as it is, and which the best."""
    def values(design: Dict[str, Any]) -> str:
        units = sweep["zone"]["units"]
        return ", ".join(f"{spaced(name).replace('.', ' ')} {number(value)}{ {'deg': '°', 'mm': ' mm'}.get(units.get(name, ''), '')}"
                         for name, value in design["values"].items())

    best = sweep["best"]
    return (f"{sweep['safe_designs']} of {sweep['designs']} designs leave all targets free. As it is: {values(sweep['here'])}." +
            (f" Best design, with a margin of {best['margin_deg']:.1f}°: {values(best)}." if best else ""))


class Note(NamedTuple):
    """A note; `grave` is its place among those that may change a decision, the first of which is 0, and more for all others."""

    text: str
    grave: int


def notes(case: Case) -> List[Note]:
    """All notes, each once, motions and measures in words; what is left out; then what usually ends motions, by the studies that say so."""
    words = {row.now.name: in_sentence(row.now.name) for row in rows_of(case)}
    words.update((key, _measure_name(key)[0]) for key in (case.measures["measures"] if case.measures else {}))
    name = re.compile(r"\b(" + "|".join(map(re.escape, sorted(words, key=len, reverse=True))) + r")\b")
    found: Dict[str, Note] = {}

    def add(text: str, code: str, when: str = "") -> None:
        said = name.sub(lambda match: words[match[0]], text.rstrip(".")) if words else text.rstrip(".")
        if said not in found:
            found[said] = Note(f"{when}{capitalised(said)}.", DECIDE.index(code) if code in DECIDE and not when else len(DECIDE))

    for _, answer in case.answers():
        for key in ("resection_notes", "sweep_notes", "notes"):
            for note in answer.get(key, []):
                add(note["text"], note.get("code", ""), "After the cut: " * (answer is case.plan and key == "notes" and case.rom is not None))
    for _, answer in case.answers():
        for caveat in answer.get("caveats", []):
            add(caveat, "caveat" if answer is case.plan else "")
    usual: Dict[str, List[str]] = {}
    for limit in case.rom["motions"] if case.rom else []:
        gap, people = ((limit.get("living") or {}).get(key) for key in ("gap", "people"))
        said = [(str(caveat.get("text", "")).rstrip("."), caveat.get("source")) for caveat in limit.get("caveats", [])]
        said += [(f"soft tissue ended it {gap['mean_deg']:g}° (SD {gap['sd_deg']:g}°) before bone did in {gap['hips']} hips of cadavers", gap["source"])] if gap else []
        said += [(f"living hips from {people['who']}", people["source"])] if people else []
        said += [("clinical range", case.rom.get("normal_range_source") if case.rom else None)] * (limit.get("normal_range_deg") is not None and not people)
        for text, source in said:
            usual.setdefault(f"{text}{f' ({source})' if source else ''}.", []).append(in_sentence(limit["name"]))
    return list(found.values()) + [Note(f"{capitalised(', '.join(of))}: {text}", len(DECIDE)) for text, of in usual.items()]


def first_and_rest(said: List[Note], most: int) -> Tuple[List[Note], List[Note]]:
    """At most so many notes that may change a decision, the gravest first, and all others."""
    first = sorted((note for note in said if note.grave < len(DECIDE)), key=lambda note: note.grave)[:most]
    return first, [note for note in said if note not in first]


def scope(case: Case) -> str:
    """What is modelled, each once."""
    return " ".join(f"{capitalised(each)}." for each in dict.fromkeys(answer["scope"] for _, answer in case.answers()))


def made_from(case: Case) -> str:
    """The version, and the files that the answers were made from with the beginning of their SHA-256."""
    sources = [provenance_of(answer) for _, answer in case.answers()]
    versions = dict.fromkeys(source["version"] for source in sources if "version" in source)
    inputs = ", ".join(f"{name} {digest[:8]}" for name, digest in dict.fromkeys(each for source in sources for each in inputs_of(source)))
    return f"Condyle {', '.join(versions)}. Made from (SHA-256): {inputs}." if inputs else "Made by Condyle, not from files."
