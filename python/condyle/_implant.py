"""Implants made of their sizes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Mapping, Optional

from . import _native
from ._joint import Joint
from ._mesh import TriMesh
from ._placed_implant import REPLACEMENT_SIZES, sizes_in
from ._words import Bones, CupDefinition, Side, count, word

#: The sizes that :func:`sample_reverse_shoulder` takes.
REVERSE_SHOULDER_SIZES = tuple(_native.implant_sizes(False))


@dataclass(frozen=True)
class SampleImplant:
    """An implant in the joint frame at zero angles: the meshes of each body by the names of their parts, and the joint of them.

    `half_angle_deg`: between the axes of liner and neck where both first touch, in closed form; None if one of them is no body of
    revolution, with the reason in `why_no_half_angle`.
    """

    fixed: Mapping[str, TriMesh]
    mobile: Mapping[str, TriMesh]
    joint: Joint
    half_angle_deg: Optional[float]
    why_no_half_angle: str


def _made(is_hip: bool, sizes: dict[str, float], definition: str, facets: int, scenario: Optional[int],
          side: Side) -> SampleImplant:
    fixed, mobile, joint, half_angle, why = _native.sample_implant(
        is_hip, sizes, definition, count(facets, "facets"), scenario, word(side, "side", Side) == "left")
    meshes = [{part: TriMesh._of_native(mesh) for part, mesh in body} for body in (fixed, mobile)]
    return SampleImplant(meshes[0], meshes[1], Joint._of_native(joint), half_angle, why)


def sample_replacement(*, bones: Bones = "sample", definition: CupDefinition = "radiographic", facets: int = 360,
                       scenario: int = 1, side: Side = "right", **sizes: float) -> SampleImplant:
    """A total hip of these sizes in the sample hip, or alone with `bones="none"`.

    Sizes by the names in :data:`REPLACEMENT_SIZES`, as the options of the command with their unit: `inclination_deg`,
    `neck_radius_mm`. `definition` says which of Murray's definitions inclination and anteversion are by. Parts are `liner` and
    `hip_bone`, fixed, and `head`, `neck`, `stem` and `femur`, mobile. UsageError for a size that is out of its range or does not fit.

    C++: `condyle::sample_replacement` in condyle/sample/hip.hpp; `condyle sample replacement`.

    >>> hip = sample_replacement(inclination_deg=45, head_radius_mm=18, bones="none")
    >>> list(hip.mobile), round(hip.half_angle_deg, 4)
    (['head', 'neck', 'stem'], 70.5288)
    """
    with_bones = word(bones, "bones", Bones) == "sample"
    level = count(scenario, "scenario", 1, 4)
    return _made(True, sizes_in(sizes, REPLACEMENT_SIZES), word(definition, "definition", CupDefinition), facets,
                 level if with_bones else None, side)


def sample_reverse_shoulder(*, facets: int = 360, side: Side = "right", **sizes: float) -> SampleImplant:
    """A reverse shoulder of these sizes, by the names in :data:`REVERSE_SHOULDER_SIZES`.

    Parts are `head` and `pillar`, fixed, and `liner` and `stem`, mobile. UsageError as :func:`sample_replacement`.

    C++: `condyle::implant_meshes` in condyle/implant.hpp; `condyle sample reverse-shoulder`.

    >>> round(sample_reverse_shoulder().half_angle_deg, 4)
    102.6073
    """
    return _made(False, sizes_in(sizes, REVERSE_SHOULDER_SIZES), "radiographic", facets, None, side)
