"""Contents of a joint file, from the arguments of Joint()."""

from __future__ import annotations

import json
from typing import Any, Mapping, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._coordinates import position_in
from ._errors import UsageError
from ._words import Anatomy, Axes, Body, JointKind, LengthUnit, Side, TranslationFrame, ball, number, number_array, text_of
from ._words import word

_axes: dict[str, tuple[ArrayLike, ArrayLike]] = {"LPS": ((0, -1, 0), (0, 0, 1)), "RAS": ((0, 1, 0), (0, 0, 1))}


def description_of(*, name: Any, kind: Any, joint: Any, side: Any, units: Any, translation_frame: Any, centre: Any,
                   fit_body: Any, fit_within: Any, axes: Any, anterior: Any, superior: Any, landmarks: Any,
                   reference_pose: Any, person: Any, ligaments: Any, fixed_in_W: Any, mobile_in_W: Any) -> dict[str, Any]:
    """For the compiled part, in mm and degrees."""
    anatomy = word(joint, "joint", Anatomy)
    to_mm = {"mm": 1.0, "cm": 10.0, "in": 25.4, "m": 1000.0}[word(units, "units", LengthUnit)]
    is_fit = isinstance(centre, str)
    if is_fit:
        word(centre, "centre", ("fit", "three numbers"))
    if fit_within is not None and not is_fit:
        raise UsageError('fit_within: is for centre="fit"')
    if landmarks is not None and not isinstance(landmarks, Mapping):
        raise UsageError(f"landmarks: points by their names are needed, not {type(landmarks).__name__}")
    anterior, superior = _directions(axes, anterior, superior, landmarks)
    word(kind, "kind", JointKind)
    zero_from, coordinates = _zero(reference_pose)
    angles, translation = position_in(coordinates, _native.angle_names_of(anatomy), "reference_pose",
                                      is_free=kind == "free")
    frame = word(translation_frame, "translation_frame", TranslationFrame)
    _refuse_what_files_refuse(kind, anatomy, frame, angles)
    return {
        "name": text_of(name, "name"), "kind": kind, "anatomy": anatomy,
        "side": word(side, "side", Side), "units": units,
        "translation_frame": frame,
        "centre": None if centre is None or is_fit else _point_in_mm(centre, to_mm, "centre"),
        "fit": word(fit_body, "fit_body", Body) if is_fit else None,
        "fit_within": None if fit_within is None else _ball_in_mm(fit_within, to_mm),
        "anterior": anterior, "superior": superior,
        "landmarks": None if landmarks is None else {
            str(point): _point_in_mm(place, to_mm, f"landmarks: {str(point)[:60]!r}")
            for point, place in landmarks.items()},
        "fixed_in_W": _pose_in_mm(fixed_in_W, to_mm, "fixed_in_W"),
        "mobile_in_W": _pose_in_mm(mobile_in_W, to_mm, "mobile_in_W"),
        "person": _person(person), "ligaments": _ligament_tables(ligaments),
        "zero_from": zero_from, "reference_angles_deg": angles, "reference_translation_mm": translation * to_mm,
    }


def _person(person: Any) -> tuple[Optional[float], Optional[str], str]:
    """Age and sex, each None if it is not given, and species."""
    if person is None:
        return None, None, ""
    if not isinstance(person, Mapping) or not set(person) <= {"age", "sex", "species"}:
        raise UsageError('person: "age", "sex" and "species" are its names')
    age, sex = person.get("age"), person.get("sex")
    return (None if age is None else number(age, "person: age", 0, 120),
            None if sex is None else word(sex, "person: sex", ("female", "male")),
            text_of(person.get("species", ""), "person: species"))


def _ligament_tables(ligaments: Any) -> str:
    """As a joint file has them: what they may have is checked in one place."""
    if not isinstance(ligaments, (list, tuple)) or not all(isinstance(each, Mapping) for each in ligaments):
        raise UsageError("ligaments: a list of mappings with the keys of [[ligament]] is needed")
    return "".join("[[ligament]]\n" + "".join(f"{_toml(str(key))} = {_toml(value)}\n" for key, value in each.items())
                   for each in ligaments)


def _toml(value: Any) -> str:
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_toml(str(key))} = {_toml(each)}" for key, each in value.items()) + " }"
    if np.ndim(value) > 0:
        return "[" + ", ".join(_toml(each) for each in value) + "]"
    return repr(number(value, "ligaments"))


def _zero(reference_pose: Any) -> tuple[str, Any]:
    """What zero angles are known by, and the coordinates given."""
    if reference_pose is None:
        return "as_given", {}
    if not isinstance(reference_pose, Mapping) or "from" not in reference_pose:
        return "stated", reference_pose
    return (word(reference_pose["from"], "reference_pose: from", ("anatomy",)),
            {name: value for name, value in reference_pose.items() if name != "from"})


def _refuse_what_files_refuse(kind: str, anatomy: str, frame: str, angles: NDArray[np.float64]) -> None:
    if kind == "hinge" and anatomy == "shoulder":
        raise UsageError("joint: a shoulder is no hinge")
    if kind == "hinge" and (angles[1:] != 0).any():
        raise UsageError(f"reference_pose: a hinge rotates in {_native.angle_names_of(anatomy)[0][0]} only")
    if frame == "joint_axes" and kind != "free":
        raise UsageError(f"translation_frame: a {kind} does not translate")
    if frame == "joint_axes" and anatomy == "shoulder":
        raise UsageError('translation_frame: a shoulder has two of its axes along one line: use "fixed"')


def _directions(axes: Any, anterior: Any, superior: Any, landmarks: Any) -> tuple[Any, Any]:
    """X and Y of the joint frame in that of the meshes; landmarks are left to the compiled part."""
    given = [what for what, value in (("axes", axes), ("anterior", anterior), ("landmarks", landmarks))
             if value is not None]
    if len(given) > 1:
        raise UsageError(f"{given[1]}: given beside {given[0]}")
    if (anterior is None) != (superior is None):
        raise UsageError("superior: anterior and superior are given together")
    if axes is not None:
        return _axes[word(axes, "axes", Axes)]
    return ((1, 0, 0), (0, 1, 0)) if anterior is None else (anterior, superior)


def _point_in_mm(given: Any, to_mm: float, name: str) -> NDArray[np.float64]:
    return number_array(given, name, "three numbers") * to_mm


def _ball_in_mm(given: Any, to_mm: float) -> tuple[NDArray[np.float64], float]:
    centre, radius = ball(given, "fit_within")
    return _point_in_mm(centre, to_mm, "fit_within"), radius * to_mm


def _pose_in_mm(given: Any, to_mm: float, name: str) -> Optional[NDArray[np.float64]]:
    if given is None:
        return None
    pose = np.array(number_array(given, name, "numbers of shape (4, 4)"))
    if pose.shape != (4, 4):
        raise UsageError(f"{name}: an array of shape (4, 4) is needed, not {pose.shape}")
    pose[:3, 3] *= to_mm
    return pose
