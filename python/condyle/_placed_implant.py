"""A total hip in the place of a hip."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Callable, Generic, Mapping, Optional, TypeVar

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._answer import Compiled, kept
from ._contact_checks import ContactNote, remarked
from ._described_joint import DescribedJoint
from ._errors import UsageError, unknown
from ._mesh import TriMesh
from ._native import Joint as NativeJoint
from ._native import PlacedImplant as NativePlacedImplant
from ._words import CupDefinition, ImplantCentre, Path, count, number, path_of, word

OfJoint = TypeVar("OfJoint", bound=DescribedJoint)

#: The sizes that :func:`sample_replacement` and :meth:`Joint.implant` take, millimetres and degrees; docs/implants.md has their defaults,
#: ranges and meanings.
REPLACEMENT_SIZES = tuple(_native.implant_sizes(True))


def sizes_in(given: Mapping[str, float], known: tuple[str, ...]) -> dict[str, float]:
    """Sizes of an implant, checked."""
    for name in given:
        if name not in known:
            raise unknown("size of the implant", name, known)
    return {name: number(value, name) for name, value in given.items()}


@dataclass(frozen=True, eq=False)
class PlacedImplant(Compiled, Generic[OfJoint]):
    """A total hip in the place of a hip, made by :meth:`Joint.implant`. Points and directions are in the frame of the joint before.

    Attributes
    ----------
    joint : Joint
        With the implant: ask it as any other. Its origin is the centre of cup and head, and its parameters are those of cup and stem.
    fixed, mobile : mapping of names to TriMesh
        The meshes of each body at zero angles: bones, then implant.
    sizes : dict
        All sizes by the names in :data:`REPLACEMENT_SIZES`.
    of_bones : frozenset of str
        The names of those that are the bones' own.
    cup, rim : dict of (inclination_deg, anteversion_deg)
        By Murray's definitions, of the cup and of the rim of the bone; `rim` is None where no rim was found.
    centre_mm : (3,) float64
        Of cup and head.
    femur_shift_mm : (3,) float64
        By how much the femur moved against the hip bone.
    cut_normal : (3,) float64
        Along the neck away from the head: across it the femur is cut, `cut_mm` from the centre; `removed_mm3` went.
    room_mm : float
        From the centre to the nearest bone of the fixed body.
    stands_out : (mm, hour) or None
        By how much the edge of the cup stands out of the rim where it does so most.
    half_angle_deg : float or None
        Between the axes of liner and neck where both first touch, in closed form; with `why_no_half_angle`.
    evidence : dict
        Landmarks of its placement, as in implant.json: head and socket with the residuals of their fits, axes and angles of the femur.
    notes : what it must be read with, each with a :class:`JointRemark`
    caveats : list of str
    """

    joint: OfJoint
    fixed: Mapping[str, TriMesh]
    mobile: Mapping[str, TriMesh]
    sizes: dict[str, float]
    of_bones: frozenset[str]
    cup: dict[str, tuple[float, float]]
    rim: Optional[dict[str, tuple[float, float]]]
    centre_mm: NDArray[np.float64]
    femur_shift_mm: NDArray[np.float64]
    cut_normal: NDArray[np.float64]
    cut_mm: float
    removed_mm3: float
    room_mm: float
    stands_out: Optional[tuple[float, float]]
    half_angle_deg: Optional[float]
    why_no_half_angle: Optional[str]
    evidence: dict[str, object]
    notes: tuple[ContactNote, ...]
    caveats: list[str]
    _native: Optional[NativePlacedImplant] = None

    def write(self, folder: Path) -> list[str]:
        """Writes implant.json, and hip.toml with its meshes, as the command does; their paths. FileError."""
        return kept(self._native, "implant", "its files need").write(path_of(folder, "folder"))

    def __repr__(self) -> str:
        inclination, anteversion = self.cup["radiographic"]
        return (f"PlacedImplant(cup {inclination:.1f}, {anteversion:.1f} radiographic, neck-shaft {self.sizes['neck_shaft_deg']:.1f}, "
                f"version {self.sizes['stem_version_deg']:.1f})")


def _angles_of(cup: Optional[dict[str, dict[str, float]]]) -> Optional[dict[str, tuple[float, float]]]:
    if cup is None:
        return None
    return {name: (each["inclination_deg"], each["anteversion_deg"]) for name, each in cup.items()}


def placed_implant(joint: OfJoint, of_native: Callable[[NativeJoint], OfJoint], sizes: Mapping[str, float], definition: CupDefinition,
                   centre: ImplantCentre, as_rim: bool, facets: int) -> PlacedImplant[OfJoint]:
    for size in ("inclination_deg", "anteversion_deg"):
        if as_rim and size in sizes:
            raise UsageError(f"{size}: not with as_rim")
    found = _native.implant(joint._asked, sizes_in(sizes, REPLACEMENT_SIZES), word(definition, "definition", CupDefinition),
                            count(facets, "facets"), word(centre, "centre", ImplantCentre), bool(as_rim))
    said = json.loads(found["json"])
    units = {name.rsplit("_", 1)[0]: name for name in REPLACEMENT_SIZES}
    meshes = [{part: TriMesh._of_native(mesh) for part, mesh in found[body]} for body in ("fixed", "mobile")]
    cup = _angles_of(said["cup"])
    assert cup is not None
    stands_out = said["stands_out"]
    return PlacedImplant(
        of_native(found["joint"]), meshes[0], meshes[1], {name: said["implant"][name] for name in REPLACEMENT_SIZES},
        frozenset(units[name] for name in said["of_bones"]), cup, _angles_of(said["rim"]), found["centre_mm"], found["femur_shift_mm"],
        found["cut_normal"], said["cut"]["offset_mm"], said["cut"]["removed_mm3"], said["room_mm"],
        stands_out and (stands_out["mm"], stands_out["hour"]), said["half_angle_deg"], said["why_no_half_angle"],
        {key: said[key] for key in ("frame", "head", "socket", "femur")}, remarked(found["notes"]), found["caveats"], found["placed"])
