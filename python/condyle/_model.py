"""Models of OpenSim: their joints, the poses that their functions give, and joint files for them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Mapping, Optional, Sequence, Union, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._errors import JointRemark, UnknownNameError, UsageError, warn
from ._native import Joint as NativeJoint
from ._native import Model as NativeModel
from ._propose_joint import JointProposal
from ._words import Anatomy, CoordinateMotion, Path, PolygonRule, Side, number_array, path_of, text_of, word


@dataclass(frozen=True)
class ModelCoordinate:
    """A coordinate of a model's joint, in the model's units: radians and metres.

    `motion` "rotational" turns the joint by its own value, "translational" moves it, "coupled" turns it through a function. A
    motion file in degrees has degrees for rotational ones only. None of range, clamped, locked and prescribed changes a pose.
    `stop` is where a CoordinateLimitForce or a CoordinateLinearStopForce of the model begins to act.
    """

    name: str
    motion: CoordinateMotion
    default: float
    range: Optional[tuple[float, float]]
    is_clamped: bool
    is_locked: bool
    is_prescribed: bool
    stop: Optional[tuple[float, float]] = None


@dataclass(frozen=True)
class ModelNote:
    """A note on a model: `code` as in notes of the command ("missing_mesh"), `text` one sentence."""

    code: str
    text: str


@dataclass(frozen=True)
class ModelMesh:
    """A mesh that a model attaches to a body: its file as the model names it, and where that was found."""

    body: str
    file: str
    path: Optional[str]


class ModelJoint:
    """A joint of a model.

    Attributes
    ----------
    name, type, parent_body, child_body : str
        "knee_r", "CustomJoint", "femur_r", "tibia_r".
    coordinates : tuple of ModelCoordinate
    """

    __slots__ = ("_model", "name", "type", "parent_body", "child_body", "coordinates")

    def __init__(self, model: NativeModel, name: str, kind: str, parent: str, child: str) -> None:
        self._model, self.name, self.type, self.parent_body, self.child_body = model, name, kind, parent, child
        self.coordinates = tuple(ModelCoordinate(*row) for row in model.coordinates_of(name))

    def __repr__(self) -> str:
        return f"ModelJoint({self.name!r}: {self.child_body} in {self.parent_body}, {self.type})"

    def pose(self, coordinates: Union[Mapping[str, ArrayLike], ArrayLike, None] = None) -> NDArray[np.float64]:
        """X_parent_child, p_parent = X p_child, as OpenSim has it: (4, 4), or (N, 4, 4) for N values of coordinates.

        Parameters
        ----------
        coordinates : mapping of names to numbers or (N,) arrays, or (k,) or (N, k) numbers in the order of `coordinates`
            By name with the unit behind it: "knee_angle_r_deg" or "knee_angle_r_rad", a translation "knee_ty_r_mm" or
            "knee_ty_r_m". Those that a mapping leaves out have their defaults, and so have all without any. Rows of numbers, as
            the coordinate's own name, are the model's radians and metres; the name by itself gives a warning.

        Returns
        -------
        (4, 4) or (N, 4, 4) array
            Lengths in metres, as in the model. Exact but for rounding, about 1e-15 of the model's size.

        Raises
        ------
        UnknownNameError
            For a name that is no coordinate of the joint.

        Warns
        -----
        JointRemark
            For a name without a unit.

        C++: `condyle::pose_of` in condyle/io/model_file.hpp.
        """
        if coordinates is None:
            coordinates = {}
        if isinstance(coordinates, Mapping):
            rows, is_one = self._rows_of(coordinates)
        else:
            rows = number_array(coordinates, "coordinates", f"{len(self.coordinates)} numbers")
            is_one = rows.ndim < 2
            rows = np.atleast_2d(rows)
        if rows.ndim != 2 or rows.shape[1] != len(self.coordinates):
            raise UsageError(f"coordinates: joint {self.name} has {len(self.coordinates)} coordinates, and an array of "
                             f"shape {rows.shape} was given")
        poses = self._model.poses(self.name, rows)
        return cast("NDArray[np.float64]", poses[0]) if is_one else poses

    def _rows_of(self, given: Mapping[str, ArrayLike]) -> tuple[NDArray[np.float64], bool]:
        known = {coordinate.name + unit: (i, size) for i, coordinate in enumerate(self.coordinates)
                 for unit, size in _units_of(coordinate).items()}
        known.update({coordinate.name: (i, 1.0) for i, coordinate in enumerate(self.coordinates)})
        columns = [number_array(coordinate.default, coordinate.name, "numbers") for coordinate in self.coordinates]
        by: dict[int, str] = {}
        for name, value in given.items():
            if name not in known:
                raise UnknownNameError(f"coordinates: joint {self.name} has no coordinate {name!r}; there are "
                                       f"{', '.join(c.name for c in self.coordinates) or 'none'}")
            i, unit = known[name]
            if i in by:
                raise UsageError(f"coordinates: {by[i]} and {name} are one coordinate")
            by[i] = name
            columns[i] = unit * number_array(value, name, "numbers")
        for i, name in by.items():
            if name == self.coordinates[i].name:
                taken_as = "metres" if self.coordinates[i].motion == "translational" else "radians"
                warn(f"coordinates: {name} is in {taken_as}: say so, with {' or '.join(_units_of(self.coordinates[i]))} behind its name",
                     JointRemark)
        try:
            whole = np.broadcast_arrays(*columns) if columns else [np.zeros(())]
        except ValueError:
            raise UsageError("coordinates: arrays must have one length") from None
        if whole[0].ndim > 1:
            raise UsageError("coordinates: numbers or (N,) arrays are needed")
        rows = np.stack([np.atleast_1d(column) for column in whole], axis=1) if columns else np.zeros((1, 0))
        return rows, whole[0].ndim == 0


def _units_of(coordinate: ModelCoordinate) -> dict[str, float]:
    """What may stand behind a coordinate's name, each with its metres or radians."""
    return {"_m": 1.0, "_mm": 1e-3} if coordinate.motion == "translational" else {"_rad": 1.0, "_deg": np.pi / 180}


class Model:
    """A model of OpenSim that was read, its meshes looked for and not opened.

    Attributes
    ----------
    name : str
    version : int
        Version of the format: 40000 is OpenSim 4.0.
    bodies, contacts : tuple of str
    joints : tuple of str
        The joints that can be read.
    refused : dict of str to str
        Joints that cannot be read, and why.
    meshes : tuple of ModelMesh
    ignored : dict of str to int
        How many of each kind of component are not used here: muscles, ligaments, markers.
    notes : tuple of ModelNote
    """

    __slots__ = ("_native", "_kinds", "name", "version", "bodies", "contacts", "joints", "refused", "meshes", "ignored", "notes")

    def __init__(self, native: NativeModel) -> None:
        self._native = native
        self.name, self.version = native.name, native.version
        self.bodies, self.contacts = tuple(native.bodies), tuple(native.contacts)
        self._kinds = {name: (kind, parent, child) for name, kind, parent, child, why_not in native.joints if why_not is None}
        self.joints = tuple(self._kinds)
        self.refused = {name: why_not for name, _, _, _, why_not in native.joints if why_not is not None}
        self.meshes = tuple(ModelMesh(*mesh) for mesh in native.meshes)
        self.ignored = dict(native.ignored)
        self.notes = tuple(ModelNote(*note) for note in native.notes)

    def __repr__(self) -> str:
        return f"Model({self.name!r}: {len(self.bodies)} bodies, {len(self.joints)} joints)"

    def joint(self, name: str) -> ModelJoint:
        """The joint of that name. UsageError with the names there are; FileError for one that cannot be read."""
        text_of(name, "name")
        if name not in self._kinds:
            self._native.coordinates_of(name)  # says which there are, or what is wrong with it
        return ModelJoint(self._native, name, *self._kinds[name])

    def propose_joint(self, joint: str, joint_file: Path, *, anatomy: Optional[Anatomy] = None,
                      side: Optional[Side] = None, contact: Optional[str] = None,
                      polygons: PolygonRule = "split") -> JointProposal:
        """Proposes a joint file for one of its joints. Nothing is written.

        `joint_file` is where it is to lie, for meshes are named from its folder; `anatomy` ("knee") and `side` are inferred from names
        if not given; `contact` is one of `contacts`, else the first between the two bodies; `polygons` is that of
        :func:`read_mesh`. The proposal's `evidence` says what the
        model has and the file has not. UsageError for names that are not there, or do not determine joint or side.

        C++: `condyle::propose_joint` in condyle/io/model_file.hpp; `condyle init MODEL --joint`.
        """
        toml, to_fill_in, notes = self._native.proposed(text_of(joint, "joint"), path_of(joint_file, "joint_file"),
                                                        *_choices(anatomy, side, contact, polygons))
        return JointProposal(toml, tuple(to_fill_in), tuple(f"{code}: {text}" for code, text in notes))

    def _joint(self, joint: str, anatomy: Optional[Anatomy], side: Optional[Side], contact: Optional[str],
               polygons: PolygonRule) -> NativeJoint:
        return self._native.joint(text_of(joint, "joint"), *_choices(anatomy, side, contact, polygons))


def _choices(anatomy: Optional[Anatomy], side: Optional[Side], contact: Optional[str],
             polygons: PolygonRule) -> tuple[str, str, str, str]:
    return ("" if anatomy is None else word(anatomy, "anatomy", Anatomy), "" if side is None else word(side, "side", Side),
            "" if contact is None else text_of(contact, "contact"), word(polygons, "polygons", PolygonRule))


def read_model(path: Path, *, geometry: Union[Path, Sequence[Path]] = ()) -> Model:
    """Reads a model of OpenSim (.osim), of any version from 1.5 to 4.6.

    Meshes are looked for in the model's folder, its folder Geometry, and those of `geometry`. FileError, one line with the line
    of the file, for what is not as it must be; joints of a kind that is not read are in `refused`.

    C++: `condyle::read_model` in condyle/io/model_file.hpp; `condyle inspect MODEL`.
    """
    folders = [geometry] if isinstance(geometry, str) or hasattr(geometry, "__fspath__") else list(geometry)
    return Model(_native.read_model(path_of(path), [path_of(cast(Path, folder), "geometry") for folder in folders]))
