"""The results of one case: which of the command's files are given, and that they are of one joint."""
from __future__ import annotations

from pathlib import Path, PurePath
from typing import Any, Callable, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple

from . import files
from .files import PathLike, ReadError


class Kind(NamedTuple):
    """A file that the command writes: its name in a folder, the key that no other one has, and what reads and checks it."""

    name: str
    key: str
    read: Callable[[Path], Dict[str, Any]]


def read_resection(path: PathLike) -> Dict[str, Any]:
    """`resection.json`, by its name or that of its folder."""
    path = files.in_folder(path, "resection.json")
    plan = files.read_json(path)
    try:
        for each in plan["limits"]:
            _check_texts(each["motion"], each["before"]["reason"], each["after"]["reason"])
            _check_numbers(each["before"]["limit_deg"], each["after"]["limit_deg"])
        for each in plan["targets"]:
            _check_texts(each["motion"])
            other = each.get("other_centre") or {"centre": "", "before_deg": 0, "after_deg": 0, "is_decided": True}
            _check_texts(other["centre"], each.get("text", ""))
            _check_numbers(each["reach_deg"], each["after"]["limit_deg"], *(other[key] for key in ("before_deg", "after_deg", "is_decided")),
                           each.get("confidence_reached") or 0, plan.get("confidence") or 0)
        for band in [each.get(key) for each in plan["limits"] + plan["targets"] for key in ("before_band", "band")]:
            _check_numbers(*(band[key] for key in ("p5_deg", "median_deg", "p95_deg")) if band else ())
        for each in plan["cuts"]:
            _check_texts(each["body"], each["name"])
            _check_numbers(each["volume_mm3"], each["area_mm2"], each["deepest_mm"], each["deepest_hour"] or 0)
        for each in plan["measures"] or []:
            _check_texts(each["key"], each["unit"])
            _check_numbers(each["before"] or 0, each["after"] or 0)
        _check_numbers(plan["margin_mm"], *(plan["depth_by_half_hour_mm"] or []))
    except (KeyError, TypeError, AttributeError):
        raise ReadError(f"{path}: not what condyle resect writes") from None
    return plan


def _check_texts(*texts: object) -> None:
    if not all(isinstance(text, str) for text in texts):
        raise TypeError


def _check_numbers(*numbers: object) -> None:
    if not all(isinstance(number, (int, float)) for number in numbers):
        raise TypeError


def _read_rom(path: Path) -> Dict[str, Any]:
    rom = files.read_rom(path)
    try:
        _check_texts(rom["fixed"], rom["mobile"], rom.get("normal_range_source") or "")
        for motion in rom["motions"]:
            _check_texts(*((mesh or {}).get("part") or "" for mesh in (motion.get("features") or {}).values()))
            _check_texts(*(each[key] or "" for each in motion.get("caveats", []) for key in ("text", "source")))
        if rom.get("band"):
            sigma = dict(rom["band"]["sigma"])
            _check_numbers(rom["band"]["samples"], *sigma.pop("parameters", {}).values(), *sigma.values())
    except (KeyError, TypeError, AttributeError, ValueError):
        raise ReadError(f"{path}: not what condyle rom writes") from None
    return rom


def _read_measures(path: Path) -> Dict[str, Any]:
    return {**files.read_json(path), **files.read_measures(path)}


def _read_sweep(path: Path) -> Dict[str, Any]:
    answer, zone = files.read_json(path), files.read_sweep(path)
    try:
        for design in [answer["here"], *([answer["best"]] if answer["best"] else [])]:
            _check_numbers(design.get("margin_deg", 0), *design["values"].values(), *(limit["limit_deg"] for limit in design["limits"]))
            _check_texts(*(limit["target"] for limit in design["limits"]))
            _check_texts(*(pair[body] for pair in (limit.get("ended_by") for limit in design["limits"]) if pair for body in ("fixed", "mobile")))
        _check_numbers(answer["designs"], answer["safe_designs"])
    except (KeyError, TypeError, AttributeError):
        raise ReadError(f"{path}: not what condyle sweep writes") from None
    return {**answer, "zone": zone}


KINDS: Dict[str, Kind] = {
    "rom": Kind("rom.json", "motions", _read_rom),
    "plan": Kind("resection.json", "cuts", read_resection),
    "measures": Kind("measures.json", "around_neck", _read_measures),
    "sweep": Kind("sweep.json", "parameters", _read_sweep),
}


class Case(NamedTuple):
    """Answers as their files have them, and the files by their kinds. At least one answer is there."""

    paths: Dict[str, Path]
    rom: Optional[Dict[str, Any]] = None
    plan: Optional[Dict[str, Any]] = None
    measures: Optional[Dict[str, Any]] = None
    sweep: Optional[Dict[str, Any]] = None

    def answers(self) -> List[Tuple[str, Dict[str, Any]]]:
        """Names of files and what they hold, the limits first."""
        return [(path.name, getattr(self, kind)) for kind, path in self.paths.items()]


def provenance_of(answer: Dict[str, Any]) -> Dict[str, Any]:
    """Where it comes from; nothing of a joint made of arrays."""
    return answer.get("provenance") or {}


def inputs_of(provenance: Any) -> Iterator[Tuple[str, str]]:
    """Names, without folders, and SHA-256 of the files that an answer was made from."""
    if isinstance(provenance, dict) and isinstance(provenance.get("sha256"), str):
        yield PurePath(str(provenance.get("path", ""))).name, provenance["sha256"]
    elif isinstance(provenance, (dict, list)):
        for each in provenance.values() if isinstance(provenance, dict) else provenance:
            yield from inputs_of(each)


def read_case(inputs: Sequence[PathLike]) -> Case:
    """Reads files, and of folders all that are known.

    Raises ReadError for one that is bad or of no known kind, for two of a kind, and where they are not of one joint.
    """
    paths: Dict[str, Path] = {}
    for given in map(Path, inputs):
        for kind, path in _found(given).items():
            if kind in paths:
                raise ReadError(f"{path}: {paths[kind]} is another {KINDS[kind].name}: a sheet has one of each")
            paths[kind] = path
    case = Case({kind: paths[kind] for kind in KINDS if kind in paths}, **{kind: KINDS[kind].read(path) for kind, path in paths.items()})
    for path, answer in zip(case.paths.values(), (answer for _, answer in case.answers())):
        _check_words(path, answer)
    _check_one_joint(case)
    return case


def _found(path: Path) -> Dict[str, Path]:
    """The known files in a folder; a file by what is in it."""
    if path.is_dir():
        found = {kind: path / known.name for kind, known in KINDS.items() if (path / known.name).exists()}
    else:
        answer = files.read_json(path)
        found = {kind: path for kind, known in KINDS.items() if known.key in answer}
    if not found:
        raise ReadError(f"{path}: neither {' nor '.join(known.name for known in KINDS.values())}")
    return found


def _check_words(path: Path, answer: Dict[str, Any]) -> None:
    """That what every answer says in words is there, and is words."""
    try:
        notes = [note["text"] for key in ("notes", "resection_notes", "sweep_notes") for note in answer.get(key, [])]
        _check_texts(answer["joint"], answer["scope"], answer.get("side") or "", provenance_of(answer).get("version", ""))
        _check_texts(*notes, *answer.get("caveats", []))
    except (KeyError, TypeError, AttributeError):
        raise ReadError(f"{path}: joint, side, scope, notes, caveats or provenance is not what the command writes") from None


def _check_one_joint(case: Case) -> None:
    first, *others = zip(case.paths.values(), (answer for _, answer in case.answers()))
    for path, answer in others:
        for role in ("joint_file", "fixed_mesh", "mobile_mesh"):
            there, here = ({digest for _, digest in inputs_of(provenance_of(each).get(role))} for each in (first[1], answer))
            if there and here and there != here:
                raise ReadError(f"{path}: of another {role.replace('_', ' ')} than {first[0]}: a sheet is of one joint")
    if case.rom and case.plan:
        now = {motion["name"]: motion["limit_deg"] for motion in case.rom["motions"]}
        for each in case.plan["limits"]:
            before = each["before"]["limit_deg"]
            there = now.get(each["motion"], before)
            if abs(there - before) > 0.05:  # as printed
                raise ReadError(f"{case.paths['plan']}: {each['motion']} ends at {before:.1f} degrees before the cut, in {case.paths['rom']} at "
                                f"{there:.1f}: their options differ")
