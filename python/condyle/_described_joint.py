"""Description of a joint: its bodies, frame and names, and its poses."""

from __future__ import annotations

import threading
from dataclasses import dataclass
from typing import Any, ContextManager, Mapping, Optional, Union, cast, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._answer import Unchanging
from ._coordinates import positions_in
from ._errors import JointWarning, UsageError, unknown, warn
from ._ligaments import Ligament, ligaments_of
from ._mesh import TriMesh
from ._native import Joint as NativeJoint
from ._poses import ManyNumbers, ManyPosesLike, OnePoseLike, Pose, PoseLike, Poses
from ._words import AboutLike, Anatomy, Body, JointKind, ParameterKind, PartContact, Side, TranslationFrame, ZeroFrom, number_array
from ._words import text_of, word


@dataclass(frozen=True)
class BodyPart:
    """Which vertices and triangles of a body's mesh came from one of several meshes: a first one, and how many.

    `contact`: what touching it means for a motion. "ends": the motion ends; "bearing": it slides on what is bearing of the other
    body, as cartilage does; "soft": it gives way, as a labrum does. `cut_triangles`: the last of its triangles are cut faces.
    """

    name: str
    first_vertex: int
    vertices: int
    first_triangle: int
    triangles: int
    contact: PartContact
    cut_triangles: int


@dataclass(frozen=True)
class PartParameter:
    """A number by which a part of a body is moved: `[[part]]` of docs/parts.md.

    `value` in `unit`: "deg", "mm", or "1" of a size. `in_joint_file` is the value of the joint's file, `as_given` the one at
    which the meshes stand as they are given; `range` what it may be, `sigma` its standard deviation in bands.
    """

    name: str
    kind: ParameterKind
    body: Body
    value: float
    unit: str
    in_joint_file: float
    as_given: float
    range: tuple[float, float]
    sigma: float


@dataclass(frozen=True)
class ZeroPose:
    """The pose at which a joint's angles are zero.

    `known_by`: "as_given", the pose in which the meshes are given; "stated", "landmarks" of both bodies, or "anatomy", the condyles of
    the femur. `femur_deg` are the angles at which the femur of a hip lies there by its condyles, None where it shows none;
    `is_neutral` is False if these are more than 5 degrees off, or nothing is known. `text` is one sentence.
    """

    known_by: ZeroFrom
    is_neutral: bool
    femur_deg: Optional[tuple[float, float, float]]
    text: str


@dataclass(frozen=True)
class JointNote:
    """A warning on a joint: `code` as in files ("wrong_side"), `text` one sentence."""

    code: str
    text: str


class DescribedJoint(Unchanging):
    """A joint before anything is asked of it."""

    __slots__ = ("_native", "_fixed", "_mobile", "_notes", "_has_warned", "_lock")
    _native: NativeJoint
    _fixed: TriMesh
    _mobile: TriMesh
    _notes: Optional[tuple[JointNote, ...]]
    _has_warned: bool
    _lock: ContextManager[bool]

    def _hold(self, native: NativeJoint, fixed: TriMesh, mobile: TriMesh) -> None:
        self._native, self._fixed, self._mobile = native, fixed, mobile
        self._notes, self._has_warned, self._lock = None, False, threading.RLock()

    @property
    def name(self) -> str:
        return self._native.name

    @property
    def person(self) -> dict[str, Union[float, str]]:
        """Whose joint it is: `age` in years, `sex` and `species`, each if it is known. Limits are held against people like this one."""
        return {key: value for key, value in zip(("age", "sex", "species"), self._native.person) if value is not None}

    @property
    def ligaments(self) -> tuple[Ligament, ...]:
        """Its ligaments, in the order of the joint file (docs/ligaments.md).

        C++: `Joint::ligaments` in condyle/joint.hpp.
        """
        return ligaments_of(self._native)

    @property
    def planned(self) -> str:
        """What a plan did to the joint: "without 164.1 mm3 of femur", "with a total hip", "cup.inclination 42 deg instead of 40"; "" if nothing.

        C++: `Joint::planned` in condyle/joint.hpp.
        """
        return self._native.planned

    @property
    def kind(self) -> JointKind:
        """"ball", "hinge" or "free"."""
        return self._native.kind

    @property
    def joint(self) -> Anatomy:
        """"hip", "knee", "ankle", "elbow" or "shoulder": order, signs and names of the angles."""
        return self._native.anatomy

    @property
    def side(self) -> Side:
        """"right" or "left"."""
        return self._native.side

    @property
    def parameters(self) -> dict[str, PartParameter]:
        """The parameters of parts with a pose of their own, by their names ("cup.inclination"), in the file's order.

        C++: `Joint::posed` in condyle/joint.hpp.
        """
        return {name: PartParameter(name, kind, body, value, unit, described, as_given, (low, high), sigma)
                for name, kind, body, value, unit, described, as_given, low, high, sigma in self._native.parameters()}

    @property
    def fixed(self) -> TriMesh:
        """The fixed body's mesh in F, mm; vertices as they were numbered when given."""
        return self._fixed

    @property
    def mobile(self) -> TriMesh:
        """The mobile body's mesh in M, mm."""
        return self._mobile

    @property
    def fixed_name(self) -> str:
        return self._native.fixed_name

    @property
    def mobile_name(self) -> str:
        return self._native.mobile_name

    @property
    def fixed_parts(self) -> tuple[BodyPart, ...]:
        """The meshes that the fixed body is made of; empty if it is one."""
        return tuple(BodyPart(*part) for part in self._native.fixed_parts)

    @property
    def mobile_parts(self) -> tuple[BodyPart, ...]:
        """The meshes that the mobile body is made of; empty if it is one."""
        return tuple(BodyPart(*part) for part in self._native.mobile_parts)

    def part(self, name: str, body: Body = "mobile") -> TriMesh:
        """The mesh of one part of a body, in that body's frame. UnknownNameError lists the valid names.

        C++: `condyle::mesh_of_part` in condyle/joint.hpp.
        """
        is_fixed = word(body, "body", Body) == "fixed"
        parts = [each.name for each in (self.fixed_parts if is_fixed else self.mobile_parts)]
        if text_of(name, "name") not in parts:
            raise unknown(f"{body} part", name, parts)
        return TriMesh._of_native(self._native.part(is_fixed, name))

    @property
    def translation_frame(self) -> TranslationFrame:
        """Along which axes a free joint's x, y and z are: "fixed" or "joint_axes"."""
        return self._native.translation_frame

    @property
    def X_WF(self) -> NDArray[np.float64]:
        """(4, 4) the joint frame in the frame in which the meshes were given, mm."""
        return self._native.X_WF

    @property
    def angle_names(self) -> tuple[tuple[str, str], ...]:
        """The names of each of the three angles, above zero and below."""
        return tuple(self._native.angle_names)

    @property
    def reference_pose(self) -> Pose:
        """(4, 4) X_FM in which the mobile mesh was given."""
        six = self._native.reference_pose
        pose: Pose = self._native.poses_at(np.array([six[:3]]), np.array([six[3:]]))[0]
        return pose

    @property
    def zero(self) -> ZeroPose:
        """What zero angles are known by, and how the femur of a hip lies there.

        C++: `condyle::zero_pose` in condyle/joint_checks.hpp.
        """
        known_by, is_neutral, femur_deg, text = self._native.zero()
        return ZeroPose(known_by, is_neutral, None if femur_deg is None else (femur_deg[0], femur_deg[1], femur_deg[2]), text)

    @property
    def scope(self) -> str:
        """The tissues whose contact answers cover, by the names of the meshes, and those they do not, in one line."""
        return self._native.scope

    @property
    def processing(self) -> tuple[str, ...]:
        """Conversions, repairs and fits that made this joint, one line each."""
        return tuple(self._native.processing)

    @property
    def notes(self) -> tuple[JointNote, ...]:
        """Warnings on the joint, as `notes` of the command's JSON: docs/checks.md. They change nothing.

        Computed once, here or at the first answer, which warns of each (:class:`JointWarning`): some tenths of a second
        for 50,000 triangles.

        C++: `condyle::check_joint` in condyle/joint_checks.hpp.

        >>> import condyle
        >>> bones = condyle.sample_hip(side="right")
        >>> [note.code for note in condyle.Joint(bones.hip_bone, bones.femur, side="left").notes]
        ['wrong_side']
        """
        if self._notes is None:
            with self._lock:
                if self._notes is None:
                    self._notes = tuple(JointNote(code, text) for code, text in self._native.checks())
        return self._notes

    # Its place.

    @overload
    def pose(self, **coordinates: float) -> Pose: ...  # type: ignore

    @overload
    def pose(self, **coordinates: Union[float, ManyNumbers]) -> Poses: ...

    def pose(self, **coordinates: ArrayLike) -> Union[Pose, Poses]:
        """X_FM at these angles, (4, 4); of arrays of N values (N, 4, 4): p_F = X_FM p_M, mm.

        Angles in degrees by their names at this joint and `_deg`: of a hip `flexion_deg`, `adduction_deg`,
        `internal_rotation_deg`, and with the opposite sign `extension_deg`, `abduction_deg`, `external_rotation_deg`;
        of a free joint `x_mm`, `y_mm`, `z_mm` too. What is left out is 0. UsageError for other names, for one given
        under both of its names, and for numbers that are not finite.

        C++: `condyle::pose_at` in condyle/joint_coordinates.hpp.

        >>> import condyle
        >>> bones = condyle.sample_hip(scenario=1)
        >>> joint = condyle.Joint(bones.hip_bone, bones.femur)
        >>> joint.pose(flexion_deg=90)[:3, :3].tolist()
        [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
        >>> joint.pose(flexion_deg=[0, 30, 60], abduction_deg=10).shape
        (3, 4, 4)
        """
        angles, translations = positions_in(coordinates, self._native.angle_names, "pose", is_free=self.kind == "free")
        if self.kind == "hinge" and (angles[:, 1:] != 0).any():
            raise UsageError(f"pose: a hinge rotates in {self.angle_names[0][0]} only")
        poses = self._native.poses_at(angles, translations)
        if any(np.ndim(value) for value in coordinates.values()):
            return cast(Poses, poses)
        one: Pose = poses[0]
        return one

    @overload
    def coordinates(self, pose: OnePoseLike) -> dict[str, float]: ...

    @overload
    def coordinates(self, pose: ManyPosesLike) -> dict[str, NDArray[np.float64]]: ...

    def coordinates(self, pose: PoseLike) -> Union[dict[str, float], dict[str, NDArray[np.float64]]]:
        """The angles in degrees and the translation in mm of a pose or of N, by the names that :meth:`pose` takes.

        >>> import condyle
        >>> bones = condyle.sample_hip(scenario=1)
        >>> joint = condyle.Joint(bones.hip_bone, bones.femur)
        >>> joint.coordinates(joint.pose(flexion_deg=90))
        {'flexion_deg': 90.0, 'adduction_deg': 0.0, 'internal_rotation_deg': 0.0}
        """
        matrices = self._matrices(pose)
        angles, mm = self._native.coordinates_of(matrices)
        named = {f"{positive}_deg": angles[:, i] for i, (positive, _) in enumerate(self._native.angle_names)}
        if self.kind == "free":
            named.update({f"{axis}_mm": mm[:, i] for i, axis in enumerate("xyz")})
        return {name: float(values[0]) for name, values in named.items()} if np.ndim(matrices) == 2 else named

    def _matrices(self, pose: PoseLike) -> ArrayLike:
        """Matrices, or a mapping of coordinates as `pose()` takes them."""
        if not isinstance(pose, Mapping):
            return pose
        coordinates: Mapping[str, Any] = pose
        matrices: ArrayLike = self.pose(**coordinates)
        return matrices

    def _asked_at(self, pose: PoseLike) -> tuple[NativeJoint, ArrayLike]:
        """The joint and where it is asked: what is no pose is refused before a warning is given."""
        matrices = self._matrices(pose)
        return self._asked, matrices

    def _about(self, about: Optional[AboutLike]) -> Union[int, NDArray[np.float64]]:
        """The number of an angle, or the numbers of an axis and a point of it."""
        if about is None or isinstance(about, str):
            return 0 if about is None else self._angle(about)
        line = number_array(about, "about", "an angle's name, three numbers, or an axis and a point")
        if line.shape not in ((3,), (2, 3)):
            raise UsageError(f"about: three numbers, or an axis and a point are needed, not an array of shape {line.shape}")
        return line.reshape(-1)

    def _angle(self, about: str) -> int:
        positive = [names[0] for names in self._native.angle_names]
        if about not in positive:
            raise unknown("about", about, positive)
        return positive.index(about)

    @property
    def _asked(self) -> NativeJoint:
        """The compiled joint, of which an answer is asked. The first one warns of each note."""
        if not self._has_warned:
            with self._lock:
                self._warn()
        return self._native

    def _warn(self) -> None:
        if self._has_warned:
            return
        self._has_warned = True  # whoever shows a warning may ask the joint
        try:
            for note in self.notes:
                warn(f"{self.name}: {note.code}: {note.text}", JointWarning)
        except BaseException:  # a warning that is an error is one again at the next answer
            self._has_warned = False
            raise
