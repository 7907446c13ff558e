"""What the sheet of a case says in words and figures, without where it stands."""
from __future__ import annotations

import re
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

from .case_files import Case, inputs_of, provenance_of
from .limit_bars import ENDS, turned_text
from .motion_ends import MotionEnd, motion_ends
from .rim_clock import clock_text
from .words import MINUS, capitalised, in_sentence, motion_name, number, spaced

CHANGED_DEG = 0.05
"""Limits that differ by less are printed alike."""

CONTACTS = ("impingement", "contact")
"""Ends at which the bodies are named that meet."""


class Row(NamedTuple):
    """A motion: where it ends now, the bodies or meshes that meet there, what is asked for, and where it ends after the cut."""

    now: MotionEnd
    pair: str
    is_of_parts: bool
    target: Optional[Dict[str, Any]]
    after: Optional[MotionEnd]
    gain_deg: float = 0.0

    @property
    def is_changed(self) -> bool:
        """Whether the cut changes the limit: what smaller triangles around it change is no gain."""
        return abs(self.gain_deg) >= CHANGED_DEG


def _ends(plan: Dict[str, Any], when: str) -> List[MotionEnd]:
    listed = [{"name": each["motion"], **each[when]} for each in plan["limits"]]
    return motion_ends({"motions": listed}) if listed else []


def _meeting(answer: Dict[str, Any], motion: Dict[str, Any]) -> Tuple[str, bool]:
    """The bodies that meet, or if known their meshes; and whether it is the meshes."""
    features = motion.get("features") or {}
    meshes = [(features.get(body) or {}).get("part") for body in ("mobile", "fixed")]
    bodies = (mesh or answer.get(body) or body for mesh, body in zip(meshes, ("mobile", "fixed")))
    return " on ".join(map(spaced, bodies)), any(meshes)


def rows_of(case: Case) -> List[Row]:
    """The motions of the limits, then those that only the plan has."""
    plan = case.plan or {"limits": [], "targets": []}
    targets = {each["motion"]: each for each in plan["targets"]}
    after = {end.name: end for end in _ends(plan, "after")}
    rows = [(end, *_meeting(case.rom, motion)) for end, motion in zip(motion_ends(case.rom), case.rom["motions"])] if case.rom else []
    known = {end.name for end, *_ in rows}
    rows += [(end, *_meeting(plan, {})) for end in _ends(plan, "before") if end.name not in known]
    # Files of earlier versions have no gains.
    gains = {each["motion"]: each.get("gain_deg", each["after"]["limit_deg"] - each["before"]["limit_deg"]) for each in plan["limits"]}
    return [Row(*row, targets.get(row[0].name), after.get(row[0].name), gains.get(row[0].name, 0.0)) for row in rows]


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
    volume = cut["volume_mm3"]
    return f"{volume:.{0 if volume >= 100 else 1}f} mm³ of {spaced(cut['name'])}"


def heading(case: Case) -> str:
    """What the sheet shows: a plan, or the joint as it is."""
    if case.plan is None:
        beside = ", and designs beside it" if case.sweep else ""
        return f"NOW: {'limits of ' if case.rom else ''}the joint as it is{beside}"
    cuts = [volume_text(cut) for cut in case.plan["cuts"] if cut["volume_mm3"] > 0]
    return f"PLANNED: {' and '.join(cuts)} removed; limits after it beside those now" if cuts else "PLANNED: no bone has to go"


def _end_words(row: Row) -> str:
    words = ENDS[row.now.end].words
    where = f" at {clock_text(row.now.hour)} of the clock" if row.now.hour is not None else ""
    return f"ended by {words} of {row.pair}{where}" if row.now.end in CONTACTS else words


def limited_most(rows: List[Row]) -> str:
    """The motion that lacks most of its target; without targets, of its clinical range; where none lacks anything, the one that turns least."""
    asked = {"target": [row.target["reach_deg"] if row.target else None for row in rows], "clinical range": [row.now.normal_deg for row in rows]}
    for wanted, degrees in asked.items():
        lacks = [0.0 if each is None else each - row.now.turned_deg for row, each in zip(rows, degrees)]
        most = max(range(len(rows)), key=lacks.__getitem__)
        if lacks[most] >= CHANGED_DEG:
            return (f"{motion_name(rows[most].now.name)} lacks most of its {wanted}: {turned_text(rows[most].now)} of {degrees_text(degrees[most])}, "
                    f"{_end_words(rows[most])}.")
    least = min(rows, key=lambda row: row.now.turned_deg)
    known = " or ".join(wanted for wanted, degrees in asked.items() if any(each is not None for each in degrees))
    first = f"No motion ends before its {known}. " if known else ""
    return f"{first}{motion_name(least.now.name)} turns least: {turned_text(least.now)}, {_end_words(least)}."


def reached(plan: Dict[str, Any]) -> List[str]:
    """A sentence for each target."""
    said = []
    for target in plan["targets"]:
        short = target["reach_deg"] - target["after"]["limit_deg"]
        how = f"its target of {degrees_text(target['reach_deg'])}" if short < CHANGED_DEG else f"{short:.1f}° short of its target"
        band = f"; 5 to 95 % of displaced joints reach {target['band']['p5_deg']:.0f} to {target['band']['p95_deg']:.0f}°" if target["band"] else ""
        said.append(f"{motion_name(target['motion'])} reaches {target['after']['limit_deg']:.1f}° after the cut, {how}{band}.")
    if plan["margin_mm"] > 0:
        said.append(f"Planned with a margin of {number(plan['margin_mm'])} mm.")
    return said


def how_sure(case: Case) -> str:
    """What the bands are of, and which there are not."""
    said = ["Limits are bounded or searched for, not exact."] if case.rom and case.rom.get("exact") is False else []
    band = case.rom and case.rom.get("band")
    if band:
        units = {"deg": "°", "mm": " mm"}
        sigmas = [f"{name} {number(value)}{units[unit]}" for key, value in band["sigma"].items() if key.endswith(("_deg", "_mm")) and value
                  for name, _, unit in (key.rpartition("_"),)]
        sigmas += [f"{spaced(name).replace('.', ' ')} {number(value)}" for name, value in band["sigma"].get("parameters", {}).items()]
        said.append(f"Band: 5 to 95 % of {band['samples']} joints displaced at random, standard deviations {', '.join(sigmas)}.")
    elif case.rom:
        said.append("No band: condyle rom --band computes how far limits move in displaced joints.")
    if case.plan and any(target["band"] for target in case.plan["targets"]):
        said.append("In brackets: 5 to 95 % after the cut.")
    elif case.plan:
        said.append("Planned limits have no band: condyle resect --band computes one for the targets.")
    return " ".join(said)


def _changes(plan: Dict[str, Any]) -> Dict[str, Tuple[float, float]]:
    """Measures that print otherwise after the cut."""
    known = {each["key"]: (each["before"], each["after"]) for each in plan["measures"] if None not in (each["before"], each["after"])}
    return {key: (before, after) for key, (before, after) in known.items() if f"{before:.1f}" != f"{after:.1f}"}


def _measure_name(key: str) -> Tuple[str, str]:
    """Words and unit: "head neck offset at 1:30", " mm" of "head_neck_offset_1_30_mm"."""
    words, _, unit = key.rpartition("_")
    name, unit = (words, {"deg": "°", "mm": " mm"}[unit]) if unit in ("deg", "mm") else (key, "")
    return spaced(re.sub(r"_(12|3|1_30)(?=_|$)", lambda hour: f"_at_{hour[1].replace('_', ':')}{'' if '_' in hour[1] else ':00'}", name)), unit


def shape(case: Case) -> str:
    """The measures that have a range of other people, or that the cut changes."""
    measures = {key: each for key, each in case.measures["measures"].items() if each.get("value") is not None} if case.measures else {}
    changes = _changes(case.plan) if case.plan else {}
    ranges = {key: each["normal"] or each["patients"] for key, each in measures.items() if each["normal"] or each["patients"]}
    said = []
    for key in dict.fromkeys((*ranges, *changes)):
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
    """A note and the file that has it."""

    text: str
    file: str


def notes(case: Case) -> List[Note]:
    """All notes, each once, motions and measures in words; then what usually ends motions, by the studies that say so."""
    words = {row.now.name: in_sentence(row.now.name) for row in rows_of(case)}
    words.update((key, _measure_name(key)[0]) for key in (case.measures["measures"] if case.measures else {}))
    name = re.compile(r"\b(" + "|".join(map(re.escape, sorted(words, key=len, reverse=True))) + r")\b")
    found: Dict[str, str] = {}
    for file, answer in case.answers():
        for key in ("resection_notes", "sweep_notes", "notes"):
            for note in answer.get(key, []):
                text = name.sub(lambda match: words[match[0]], note["text"]) if words else note["text"]
                found.setdefault(f"{capitalised(text.rstrip('.'))}.", file)
    usual: Dict[str, List[str]] = {}
    for limit in case.rom["motions"] if case.rom else []:
        for caveat in limit.get("caveats", []):
            source = f" ({caveat['source']})" if caveat.get("source") else ""
            usual.setdefault(f"{str(caveat.get('text', '')).rstrip('.')}{source}.", []).append(in_sentence(limit["name"]))
    return ([Note(text, file) for text, file in found.items()] +
            [Note(f"{capitalised(', '.join(of))}: {text}", case.paths["rom"].name) for text, of in usual.items()])


def not_modelled(case: Case) -> str:
    """Caveats and the scope, each once."""
    said = [each for _, answer in case.answers() for each in answer.get("caveats", [])] + [answer["scope"] for _, answer in case.answers()]
    return " ".join(f"{capitalised(each)}." for each in dict.fromkeys(said))


def made_from(case: Case) -> str:
    """The version, and the files that the answers were made from with the beginning of their SHA-256."""
    sources = [provenance_of(answer) for _, answer in case.answers()]
    versions = dict.fromkeys(source["version"] for source in sources if "version" in source)
    inputs = ", ".join(f"{name} {digest[:8]}" for name, digest in dict.fromkeys(each for source in sources for each in inputs_of(source)))
    return f"Condyle {', '.join(versions)}. Made from (SHA-256): {inputs}." if inputs else "Made by Condyle, not from files."
