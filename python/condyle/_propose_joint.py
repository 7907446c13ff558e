"""Joint files proposed for two meshes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional

from . import _native
from ._words import Anatomy, LengthUnit, Path, PolygonRule, Side, path_of, text_of, word


@dataclass(frozen=True)
class JointProposal:
    """A joint file as text, the keys in it that are left to fill in, a unit that was inferred
    and is not mm, and the votes from which side and axes were.

    `evidence` has one line for each piece of evidence; the text has them as comments.
    """

    toml: str
    to_fill_in: tuple[str, ...]
    evidence: tuple[str, ...] = ()


def propose_joint(fixed: Path, mobile: Path, joint_file: Path, *, joint: Optional[Anatomy] = None,
                  side: Optional[Side] = None, units: Optional[LengthUnit] = None,
                  polygons: PolygonRule = "refuse", species: str = "", seat: bool = False) -> JointProposal:
    """Proposes a joint file for two mesh files: kind, centre, axes, side and units. Nothing is written.

    `joint_file` is where it is to lie, for meshes are named from its folder; `joint` is a hip if not given, and "knee",
    "ankle", "elbow" and "shoulder" have `fixed` nearer to the trunk; `side` "right" or "left" and `units` "mm", "cm", "in" or "m" are
    inferred from the bones if not given; `polygons` is that of :func:`read_mesh`, and the file says so too; of another `species` than human
    no unit is inferred from sizes; with `seat` the mobile mesh is moved so that its head lies in the socket, and MeshError says why it cannot be.
    FileError where a mesh cannot be read.

    C++: `condyle::propose_joint` in condyle/io/joint_file.hpp; `condyle init`.
    """
    toml, to_fill_in, evidence = _native.propose_joint(
        path_of(fixed, "fixed"), path_of(mobile, "mobile"), path_of(joint_file, "joint_file"),
        None if joint is None else word(joint, "joint", Anatomy),
        None if side is None else word(side, "side", Side),
        None if units is None else word(units, "units", LengthUnit),
        word(polygons, "polygons", PolygonRule), text_of(species, "species"), bool(seat))
    return JointProposal(toml, tuple(to_fill_in), tuple(evidence))
