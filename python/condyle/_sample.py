"""The parametric hip."""

from __future__ import annotations

from typing import Mapping, NamedTuple, Optional

from . import _native
from ._errors import UsageError, unknown
from ._mesh import TriMesh
from ._words import Side, count, number, word

#: The measures that :func:`sample_hip` takes, millimetres and degrees; C++: condyle/sample/hip.hpp has their
#: ranges and meanings.
HIP_PARAMETERS = (
    "head_radius_mm", "joint_space_mm", "neck_shaft_angle_deg", "femoral_anteversion_deg", "neck_radius_mm",
    "neck_length_mm", "shaft_length_mm", "alpha_angle_deg", "acetabular_inclination_deg", "acetabular_version_deg",
    "lateral_centre_edge_angle_deg")


class SampleHip(NamedTuple):
    """Two bones in the joint frame in the neutral pose, apart: `hip_bone` is the fixed body, `femur` the mobile one, `Joint(*bones)`."""

    hip_bone: TriMesh
    femur: TriMesh


class SampleCartilages(NamedTuple):
    """Two cartilages in the joint frame of the bones: `acetabular`, with its labrum, is fixed, `femoral` mobile."""

    acetabular: TriMesh
    femoral: TriMesh


def _parameters(given: Mapping[str, float]) -> dict[str, float]:
    for name in given:
        if name not in HIP_PARAMETERS:
            raise unknown("measure of the hip", name, HIP_PARAMETERS)
    return {name: number(value, name) for name, value in given.items()}


def _resolution(scenario: Optional[int], triangles: Optional[tuple[int, int]], edge_mm: Optional[float], first: int,
                last: int) -> tuple[Optional[int], Optional[tuple[int, int]], Optional[float]]:
    if sum(each is not None for each in (scenario, triangles, edge_mm)) > 1:
        raise UsageError("scenario, triangles, edge_mm: only one of them is given")
    if scenario is not None:
        scenario = count(scenario, "scenario", first, last)
    if triangles is not None:
        if not isinstance(triangles, (tuple, list)) or len(triangles) != 2:
            raise UsageError("triangles: two numbers are needed, of the fixed and of the mobile body")
        triangles = count(triangles[0], "triangles"), count(triangles[1], "triangles")
    return scenario, triangles, None if edge_mm is None else number(edge_mm, "edge_mm")


def _is_left(side: Side) -> bool:
    return word(side, "side", Side) == "left"


def sample_hip(*, scenario: Optional[int] = None, triangles: Optional[tuple[int, int]] = None,
               edge_mm: Optional[float] = None, side: Side = "right", **parameters: float) -> SampleHip:
    """A hip with these measures: closed meshes without self-intersections, mm, X anterior, Y superior, Z to the right.

    Resolution: `scenario` 1 to 4 (2 if nothing is given), or `triangles` (hip bone, femur), or `edge_mm`. Measures by
    the names in :data:`HIP_PARAMETERS`; without `alpha_angle_deg` there is no cam. The same arguments give the same
    meshes.
    UsageError naming the measure that is out of its range.

    C++: `condyle::sample_hip` in condyle/sample/hip.hpp; `condyle sample hip`.

    >>> sample_hip(scenario=1, alpha_angle_deg=70).femur
    TriMesh(773 vertices, 1542 triangles, closed)
    """
    resolution = _resolution(scenario, triangles, edge_mm, 1, 4)
    bone, femur = _native.sample_hip(_parameters(parameters), *resolution, _is_left(side))
    return SampleHip(TriMesh._of_native(bone), TriMesh._of_native(femur))


def sample_cartilages(*, clearance_mm: float = 0.2, femoral_thickness_mm: float = 1.65, scenario: Optional[int] = None,
                      triangles: Optional[tuple[int, int]] = None, edge_mm: Optional[float] = None,
                      side: Side = "right", **parameters: float) -> SampleCartilages:
    """The cartilages of the sample hip with these measures; they fit :func:`sample_hip` of the same measures.

    Resolution: `scenario` 5 to 8 (5 if nothing is given), or `triangles` (acetabular, femoral), or `edge_mm`.

    C++: `condyle::sample_cartilages` in condyle/sample/cartilages.hpp.

    >>> sample_cartilages().femoral
    TriMesh(1414 vertices, 2824 triangles, closed)
    """
    resolution = _resolution(scenario, triangles, edge_mm, 5, 8)
    acetabular, femoral = _native.sample_cartilages(
        _parameters(parameters), number(clearance_mm, "clearance_mm"),
        number(femoral_thickness_mm, "femoral_thickness_mm"), *resolution, _is_left(side))
    return SampleCartilages(TriMesh._of_native(acetabular), TriMesh._of_native(femoral))
