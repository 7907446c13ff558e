"""Two bodies and how one moves in the other."""

from __future__ import annotations

from typing import Any, Literal, Mapping, Optional, Sequence, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._answer import html_of
from ._brush import Brushed, BrushStroke, brushed
from ._contact_checks import reported
from ._described_joint import DescribedJoint
from ._errors import UsageError
from ._gaps import ContactMeasures, Depths, Gaps, VertexDepths, VertexGaps, measures_of, of_vertices
from ._joint_description import description_of
from ._labels import LabelLike, LabelMap, LabelSurface, joint_bones
from ._followed_range import FollowedRange, followed_range
from ._hip_measures import HipMeasures
from ._ligaments import LigamentStates, ligament_states, ligament_stiffness
from ._limits import PathLimit, path_limit
from ._mesh import MeshLike, TriMesh
from ._model import Model, read_model
from ._motion import MotionLike, Motions
from ._motion_contact import ContactFrames, contact_along
from ._native import Joint as NativeJoint
from ._penetration import Penetration, Penetrations, vertices_inside
from ._placed_implant import PlacedImplant, placed_implant
from ._pose_standing import PoseStanding
from ._poses import ManyPosesLike, OnePoseLike, PoseLike
from ._pressure import ElasticContact
from ._range_of_motion import RangeOfMotion
from ._resection import Reach, Resection, resection
from ._recorded_motion import JointMotion, RecordedContact, recorded_contact
from ._surface_contact import NormalContact, normal_contact
from ._sweep import Sweep, TargetLike, sweep
from ._words import AboutLike, Anatomy, Axes, Ball, BearingRule, BestDesign, Bodies, Body, BodyStyle
from ._words import Cavities, ClockPlane, Colour, CupDefinition, CutFrom, DepthMethod, FaceRule, GapMethod
from ._words import ImplantCentre, JointKind, LabelTask, LengthUnit, Path, Pieces, PolygonRule, Progress, Side, TranslationFrame
from ._words import count, number, path_of, progress_of, text_of, word


class Joint(DescribedJoint):
    """A fixed and a mobile body in the joint frame, ready to be asked at any pose.

    The frame F: millimetres, origin at the joint centre, X anterior, Y superior, Z to the subject's right. The mobile
    body's own frame M coincides with F at zero angles. :func:`read_joint` makes one of a joint file; the arguments here
    are the keys of docs/joint-file.md.

    Parameters
    ----------
    fixed, mobile : mesh
        Each a :class:`TriMesh`, what :meth:`TriMesh.of` takes, or a :class:`LabelSurface`.
    kind : "ball", "hinge" or "free"
    joint : "hip", "knee", "ankle", "elbow" or "shoulder"
    side : "right" or "left"
    units : "mm", "cm", "in" or "m"
        Unit of the meshes and of every length given here.
    centre : (3,) numbers, "fit", or None
        "fit": of the head of the mobile body, or with `fit_body="fixed"` of the socket. None: the origin, or what the
        landmarks say.
    fit_within : (centre, radius), optional
        Only vertices in that ball are fitted to.
    axes : "RAS" or "LPS", optional
        Or `anterior` and `superior`, unit vectors; or `landmarks`, points by their names. None of them: X and Y.
    reference_pose : mapping, optional
        In which the mobile mesh is given: angles in degrees by their names, x, y and z in `units`. One that is given, `{}` too, says
        where neutral is; with `{"from": "anatomy"}` the angles of a hip follow from the condyles of its femur.
    person : mapping, optional
        Whose joint it is, that limits are held against people like this one: `{"age": 34, "sex": "female"}`, or one of the two.
        Of another `"species"` than human nothing is held against sizes and ranges of people.
    ligaments : list of mappings, optional
        Each with the keys that `[[ligament]]` of a joint file has (docs/ligaments.md), in `units` and the frames of the meshes.
    fixed_in_W, mobile_in_W : (4, 4) numbers, optional
        Where the frame of each mesh lies in the frame of the lengths given here, translation in `units`.

    Raises
    ------
    UsageError
        Where the description cannot be followed. MeshError where a fit finds nothing.

    Warnings (`notes`) are issued at the first answer: :class:`JointWarning`. Any number of threads may ask;
    tables are built when the first question needs them, and kept. Joints can be pickled; copies are the joint itself,
    which nothing changes.

    C++: `condyle::make_joint` in condyle/make_joint.hpp, `condyle::JointContact` in condyle/contact.hpp.

    >>> import condyle
    >>> bones = condyle.sample_hip()
    >>> joint = condyle.Joint(bones.hip_bone, bones.femur, name="right hip")
    >>> joint
    Joint('right hip': ball hip, right; fixed 4884 vertices, mobile 3086 vertices)
    >>> joint.penetration(joint.pose(flexion_deg=0)).max_depth_mm
    0.0
    """

    __slots__ = ("__weakref__",)

    def __init__(self, fixed: Union[MeshLike, LabelSurface], mobile: Union[MeshLike, LabelSurface], *, name: str = "joint", kind: JointKind = "ball",
                 joint: Anatomy = "hip", side: Side = "right", units: LengthUnit = "mm",
                 translation_frame: TranslationFrame = "fixed",
                 centre: Union[ArrayLike, Literal["fit"], None] = None, fit_body: Body = "mobile",
                 fit_within: Optional[Ball] = None, axes: Optional[Axes] = None,
                 anterior: Optional[ArrayLike] = None, superior: Optional[ArrayLike] = None,
                 landmarks: Optional[Mapping[str, ArrayLike]] = None,
                 reference_pose: Optional[Mapping[str, Union[float, str]]] = None,
                 person: Optional[Mapping[str, Union[float, str]]] = None,
                 ligaments: Sequence[Mapping[str, object]] = (), fixed_in_W: Optional[ArrayLike] = None,
                 mobile_in_W: Optional[ArrayLike] = None, fixed_name: str = "fixed",
                 mobile_name: str = "mobile") -> None:
        images = [body._image if isinstance(body, LabelSurface) else None for body in (fixed, mobile)]
        fixed, mobile = (TriMesh.of(body.mesh if isinstance(body, LabelSurface) else body) for body in (fixed, mobile))
        description = description_of(
            name=name, kind=kind, joint=joint, side=side, units=units, translation_frame=translation_frame,
            centre=centre, fit_body=fit_body, fit_within=fit_within, axes=axes, anterior=anterior, superior=superior,
            landmarks=landmarks, reference_pose=reference_pose, person=person, ligaments=ligaments, fixed_in_W=fixed_in_W, mobile_in_W=mobile_in_W)
        for text, what in ((fixed_name, "fixed_name"), (mobile_name, "mobile_name")):
            text_of(text, what)
        native = _native.make_joint(description, fixed_name, fixed._native, images[0], mobile_name, mobile._native, images[1])
        self._hold(native, TriMesh._moved(native.fixed, fixed), TriMesh._moved(native.mobile, mobile))

    @classmethod
    def _of_native(cls, native: NativeJoint) -> Joint:
        return cls._remade(native, (None, None, None, ()), (None, None, None, ()))

    @classmethod
    def from_file(cls, path: Path) -> Joint:
        """The same as :func:`read_joint`."""
        return cls._of_native(_native.read_joint(path_of(path)))

    @classmethod
    def from_labels(cls, labels: Union[LabelMap, Path], fixed: Optional[LabelLike] = None,
                    mobile: Optional[LabelLike] = None, *, mobile_labels: Union[LabelMap, Path, None] = None,
                    task: Optional[LabelTask] = None, side: Optional[Side] = None, pieces: Pieces = "largest",
                    cavities: Cavities = "fill", triangles: Optional[int] = None, progress: Progress = None) -> Joint:
        """The hip of two bones of a label map, by number or name, or of two maps of one bone each.

        The joint that `condyle init` proposes: both surfaces, the centre fitted to the head, the axes of the image; the side by
        the labels' names, else inferred from the bones. Notes on the bones are warned of. UsageError where something cannot be
        inferred, or for labels that are not there.

        C++: `condyle::propose_joint` in condyle/io/label_file.hpp; `condyle init`.
        """
        bone, other, found = joint_bones(labels, fixed, mobile, mobile_labels, task,
                                         None if side is None else word(side, "side", Side), pieces, cavities, triangles,
                                         progress)
        return cls(bone, other, name=f"{other.name} in {bone.name}", side=found, axes="LPS",
                   centre="fit", fixed_name=bone.name, mobile_name=other.name)

    @classmethod
    def from_model(cls, model: Union[Model, Path], joint: str, *, anatomy: Optional[Anatomy] = None,
                   side: Optional[Side] = None, contact: Optional[str] = None,
                   polygons: PolygonRule = "split") -> Joint:
        """The joint of a model of OpenSim: what :func:`read_joint` reads from the file that `condyle init` proposes for it.

        :attr:`processing` lists the parts of the model that are not used or were read differently. Raises as
        :meth:`Model.propose_joint` does, and FileError where no mesh of a body is there.

        C++: `condyle::read_joint` in condyle/io/model_file.hpp; `condyle motion MODEL --joint`.
        """
        read = model if isinstance(model, Model) else read_model(model)
        return cls._of_native(read._joint(joint, anatomy, side, contact, polygons))

    def with_parameters(self, values: Mapping[str, float]) -> Joint:
        """The joint whose parts are moved to these values of :attr:`parameters`: {"cup.inclination": 42}.

        Parameters that are not named keep their values. UsageError for a name that there is not, and a value outside of its
        range. Lengths are mm.

        C++: `condyle::with_parameters` in condyle/io/joint_file.hpp; `--set` of commands.
        """
        if not isinstance(values, Mapping):
            raise UsageError("values: must be a mapping from names of parameters to numbers")
        given = [(text_of(name, "values"), number(value, str(name))) for name, value in values.items()]
        return Joint._of_native(self._native.with_parameters(given))

    def __reduce__(self) -> tuple[Any, ...]:
        return Joint._remade, (self._native, self._fixed._numbering(), self._mobile._numbering())

    @classmethod
    def _remade(cls, native: NativeJoint, fixed: tuple[Any, ...], mobile: tuple[Any, ...]) -> Joint:
        joint = cls.__new__(cls)
        joint._hold(native, TriMesh._numbered(native.fixed, *fixed), TriMesh._numbered(native.mobile, *mobile))
        return joint

    # Its answers.

    @overload
    def penetration(self, pose: OnePoseLike, method: GapMethod = "radial", *, about: Optional[AboutLike] = None,
                    bodies: Bodies = "both", progress: Progress = None) -> Penetration: ...

    @overload
    def penetration(self, pose: ManyPosesLike, method: GapMethod = "radial", *, about: Optional[AboutLike] = None,
                    bodies: Bodies = "both", progress: Progress = None) -> Penetrations: ...

    @overload
    def penetration(self, pose: OnePoseLike, method: Literal["normal"], *, about: None = None,
                    bodies: Bodies = "both", progress: Progress = None) -> NormalContact: ...

    @overload
    def penetration(self, pose: ManyPosesLike, method: Literal["normal"], *, about: None = None,
                    bodies: Bodies = "both", progress: Progress = None) -> list[NormalContact]: ...

    def penetration(self, pose: PoseLike, method: DepthMethod = "radial", *, about: Optional[AboutLike] = None,
                    bodies: Bodies = "both", progress: Progress = None
                    ) -> Union[Penetration, NormalContact, list[NormalContact]]:
        """Which vertices of each body are inside the other one, and how deep, at one pose or many.

        Parameters
        ----------
        pose : (4, 4) or (N, 4, 4) numbers, or a mapping
            X_FM, translation in mm; or the keyword arguments of :meth:`pose`.
        method : "radial", "tangential" or "normal"
            Along rays from the joint centre (the fast path); along arcs about an axis; or along the normals of triangles,
            which open meshes allow too: that is :meth:`normal_contact`, which takes further arguments.
        about : text, (3,) numbers, or a pair of such
            With "tangential": the angle whose axis at the pose arcs go about (default: flexion), only for poses that do not
            translate; an axis of F through the joint centre; or an axis and a point of it, mm, such as a screw's.
        bodies : "both", "mobile" or "fixed"
            With "radial": vertices of which body are asked for.
        progress : callable of (done, total), optional
            Called now and then on this thread.

        Returns
        -------
        Penetration for one pose, Penetrations for N (see there); of "normal" what :meth:`normal_contact` gives.

        Raises UsageError for what is no pose, MeshError where the joint centre lies on a surface. The interpreter's
        lock is released; Ctrl-C ends it. Coordinates are read as float64; poses are copied.

        C++: `JointContact::mobile_in_fixed`, `fixed_in_mobile`, `tangential` in condyle/contact.hpp; `condyle depth`.

        >>> import condyle
        >>> bones = condyle.sample_hip()
        >>> joint = condyle.Joint(bones.hip_bone, bones.femur)
        >>> inside = joint.penetration(joint.pose(flexion_deg=140))
        >>> len(inside.mobile), len(inside.fixed)
        (41, 26)
        >>> many = joint.penetration(joint.pose(flexion_deg=[0, 70, 140]))
        >>> [len(each.mobile) for each in many]
        [0, 0, 41]
        >>> about = [0, 0, 1], [5, -40, 0]
        >>> len(joint.penetration(joint.pose(flexion_deg=140), "tangential", about=about).mobile)
        41
        """
        word(method, "method", DepthMethod)
        if about is not None and method != "tangential":
            raise UsageError("about: is for method tangential")
        if method == "normal":
            return normal_contact(self, pose, "both", "cut_faces", 20, progress)
        word(bodies, "bodies", Bodies)
        matrices = self._matrices(pose)
        if method == "radial":
            is_one, mobile, fixed = _native.penetration_radial(
                self._asked, matrices, bodies != "fixed", bodies != "mobile", progress_of(progress))
        else:
            is_one, mobile, fixed = _native.penetration_tangential(
                self._asked, matrices, self._about(about), progress_of(progress))
        inside = vertices_inside(mobile, self._mobile, is_one), vertices_inside(fixed, self._fixed, is_one)
        if is_one:
            return Penetration(*inside, method)
        poses: Any = matrices
        return Penetrations(*inside, method, count=len(poses))

    @overload
    def pairs(self, pose: OnePoseLike, *, progress: Progress = None) -> NDArray[np.uint32]: ...

    @overload
    def pairs(self, pose: ManyPosesLike, *, progress: Progress = None) -> list[NDArray[np.uint32]]: ...

    def pairs(self, pose: PoseLike, *, progress: Progress = None
              ) -> Union[NDArray[np.uint32], list[NDArray[np.uint32]]]:
        """The exact set of triangle pairs that meet, ascending; touching counts. Open meshes too.

        (K, 2) uint32, fixed and mobile triangle; of N poses a list of N such arrays, views of one.

        C++: `JointContact::pairs` in condyle/contact.hpp.
        """
        is_one, found, offset = _native.pairs(*self._asked_at(pose), progress_of(progress))
        return found if is_one else [found[first:last] for first, last in zip(offset[:-1], offset[1:])]

    @overload
    def in_contact(self, pose: OnePoseLike, *, progress: Progress = None) -> bool: ...

    @overload
    def in_contact(self, pose: ManyPosesLike, *, progress: Progress = None) -> NDArray[np.bool_]: ...

    def in_contact(self, pose: PoseLike, *, progress: Progress = None) -> Union[bool, NDArray[np.bool_]]:
        """Whether the bodies share a point: a bool, of N poses (N,) bool.

        C++: `JointContact::in_contact` in condyle/contact.hpp.
        """
        is_one, answers = _native.in_contact(*self._asked_at(pose), progress_of(progress))
        return bool(answers[0]) if is_one else answers

    def gaps(self, pose: OnePoseLike, method: GapMethod = "radial", *, about: Optional[AboutLike] = None) -> Gaps:
        """The gap of every vertex at one pose: see :class:`VertexGaps`. Methods and errors as of :meth:`penetration`.

        C++: `JointContact::radial` and `tangential` in condyle/contact.hpp.
        """
        word(method, "method", GapMethod)
        if method == "radial":
            if about is not None:
                raise UsageError("about: is for method tangential")
            mobile, fixed = _native.radial_gaps(*self._asked_at(pose))
        else:
            mobile, fixed = _native.tangential_gaps(*self._asked_at(pose), self._about(about))
        return Gaps(of_vertices(VertexGaps, mobile, self._mobile), of_vertices(VertexGaps, fixed, self._fixed))

    @overload
    def depths(self, pose: OnePoseLike, *, progress: Progress = None) -> Depths: ...

    @overload
    def depths(self, pose: ManyPosesLike, *, progress: Progress = None) -> list[Depths]: ...

    def depths(self, pose: PoseLike, *, progress: Progress = None) -> Union[Depths, list[Depths]]:
        """The depth to read of every vertex: :class:`Depths` of X_FM (4, 4); of (N, 4, 4) a list of N.

        As `condyle depth` answers. Tables are built at the first call and kept; Ctrl-C ends the call between two poses.

        C++: `condyle::answer_depth` in condyle/answer.hpp.

        >>> import condyle
        >>> bones = condyle.sample_hip()
        >>> joint = condyle.Joint(bones.hip_bone, bones.femur)
        >>> f"{joint.depths(joint.pose(flexion_deg=140)).max_depth_mm:.2f} mm"
        '10.98 mm'
        >>> [f"{depths.max_depth_mm:.2f}" for depths in joint.depths(joint.pose(flexion_deg=[130, 140]))]
        ['0.00', '10.98']
        """
        joint, poses = self._asked_at(pose)
        is_one, found = _native.reliable_depths(joint, poses, progress_of(progress))
        answers = [Depths(of_vertices(VertexDepths, mobile, self._mobile),
                          of_vertices(VertexDepths, fixed, self._fixed), tuple(caveats), surface_mm,
                          None if standing is None else PoseStanding.of(standing))
                   for mobile, fixed, caveats, surface_mm, standing in found]
        return answers[0] if is_one else answers

    @overload
    def contact_measures(self, pose: OnePoseLike, *, progress: Progress = None) -> ContactMeasures: ...

    @overload
    def contact_measures(self, pose: ManyPosesLike, *, progress: Progress = None) -> list[ContactMeasures]: ...

    def contact_measures(self, pose: PoseLike, *, progress: Progress = None
                         ) -> Union[ContactMeasures, list[ContactMeasures]]:
        """Areas, volume, nearest points and distances: :class:`ContactMeasures` of X_FM (4, 4); of (N, 4, 4) a list of N.

        Every vertex has its nearest distance, which takes most of the time: :meth:`contact_along` computes areas, depths and
        gaps of many poses far more quickly. Ctrl-C ends the call between two poses.

        C++: `condyle::measure_contact` in condyle/contact_measures.hpp.
        """
        joint, poses = self._asked_at(pose)
        is_one, found = _native.contact_measures(joint, poses, progress_of(progress))
        answers = [measures_of(each, self._fixed, self._mobile) for each in found]
        return answers[0] if is_one else answers

    @overload
    def normal_contact(self, pose: OnePoseLike, *, casting: Bodies = "both", rule: FaceRule = "cut_faces",
                       reach_mm: float = 20, progress: Progress = None) -> NormalContact: ...

    @overload
    def normal_contact(self, pose: ManyPosesLike, *, casting: Bodies = "both", rule: FaceRule = "cut_faces",
                       reach_mm: float = 20, progress: Progress = None) -> list[NormalContact]: ...

    def normal_contact(self, pose: PoseLike, *, casting: Bodies = "both", rule: FaceRule = "cut_faces",
                       reach_mm: float = 20, progress: Progress = None) -> Union[NormalContact, list[NormalContact]]:
        """Intersections of rays along the normals of one body's triangles with the other body; meshes may be open.

        `casting` says which body casts; `rule` "face_centre" counts whole faces by the ray from their centre,
        "cut_faces" the part of them where the depth is above 0; `reach_mm` is how far rays go. A
        :class:`NormalContact`; of N poses a list of N. MeshError where triangles are wound against each other, or a
        closed mesh is inverted.

        C++: `condyle::NormalDepth` in condyle/normal_depth.hpp; `condyle depth --method normal`.

        >>> import condyle
        >>> bones = condyle.sample_hip()
        >>> joint = condyle.Joint(bones.hip_bone, bones.femur)
        >>> joint.normal_contact({"flexion_deg": 140}, casting="mobile").fixed is None
        True
        """
        return normal_contact(self, pose, casting, rule, reach_mm, progress)

    def contact_along(self, poses: ArrayLike, surfaces: Optional[ElasticContact] = None, *, casting: Body = "mobile",
                      rule: FaceRule = "cut_faces", reach_mm: float = 20, screws: bool = False,
                      progress: Progress = None) -> ContactFrames:
        """Contact in each frame of a motion, (N, 4, 4) poses, on all threads; None for those of NaN, gaps.

        A list of :class:`FrameContact` whose `notes` say what looks wrong with layers and motion (docs/checks.md).

        With `surfaces` their pressure, and their own casting, rule and reach; else depths along normals as
        :meth:`normal_contact` has them, one body casting. With `screws` each frame has a :class:`ScrewStep`: depths along arcs
        about the screw axis of the step into it.

        C++: `condyle::contact_along` in condyle/motion_contact.hpp; `condyle motion`.

        >>> import condyle
        >>> bones = condyle.sample_hip(scenario=1)
        >>> joint = condyle.Joint(bones.hip_bone, bones.femur)
        >>> [frame.in_contact for frame in joint.contact_along(joint.pose(flexion_deg=[0, 145]))]
        [False, True]
        """
        return contact_along(self, poses, surfaces, casting, rule, reach_mm, screws, progress)

    def ligament_states(self, poses: PoseLike, *, time_s: Optional[ArrayLike] = None,
                        velocity_mm_s: Optional[ArrayLike] = None,
                        angular_velocity_rad_s: Optional[ArrayLike] = None) -> LigamentStates:
        """Length, strain, tension and load of each ligament in one pose or many; poses of NaN are gaps.

        Parameters
        ----------
        velocity_mm_s, angular_velocity_rad_s : (..., 3), optional
            Of the mobile body's origin, and its turn, in the fixed body's frame, in each pose: for damping, as
            :meth:`motion` has them of files with speeds. NaN where they are not known.
        time_s : (N,), optional
            In place of these: the poses are those of a motion at these times, whose velocities are those of the
            parabolas through three of them each.

        C++: `condyle::ligaments_along` in condyle/joint.hpp.

        >>> import condyle
        >>> bones = condyle.sample_hip()
        >>> condyle.Joint(bones.hip_bone, bones.femur).ligament_states({"flexion_deg": 90}).names
        ()
        """
        return ligament_states(*self._asked_at(poses), time_s, velocity_mm_s, angular_velocity_rad_s)

    def ligament_stiffness(self, poses: PoseLike) -> NDArray[np.float64]:
        """Minus the derivative of each ligament's wrench on the mobile body, (L, ..., 6, 6), about the origin of M.

        Rows are force (N) and moment (N mm), columns a translation (mm) and a rotation (rad) in F, as in the
        `stiffness` of :meth:`ElasticContact.forces`, to which it may be added. By differences, to some seven digits;
        NaN where a length is not known.

        C++: `condyle::ligament_stiffness` in condyle/joint.hpp.

        >>> import condyle
        >>> bones = condyle.sample_hip()
        >>> condyle.Joint(bones.hip_bone, bones.femur).ligament_stiffness({"flexion_deg": 90}).shape
        (0, 6, 6)
        """
        return ligament_stiffness(*self._asked_at(poses))

    def motion(self, path: Path) -> JointMotion:
        """The recorded motion of a file, by the joint file's [recorded_motion] or columns such as flexion_deg, x_mm.

        FileError for columns that are not there or whose unit is not known.

        C++: `condyle::motion_of` and `recorded_speeds` in condyle/io/joint_file.hpp.
        """
        found = _native.motion_of(self._native, path_of(path))
        found["processing"] = tuple(found["processing"])
        found["notes"] = reported(found["notes"])
        return JointMotion(**found)

    def recorded_contact(self, time_s: ArrayLike, poses: ArrayLike, *, resolution_s: float = 1e-5,
                         progress: Progress = None) -> RecordedContact:
        """When the bodies are in contact in a motion recorded as (N, 4, 4) poses at (N,) times, between samples too.

        Between two samples the mobile body follows one screw motion. About a held centre entry and exit are exact;
        where the centre moves they lie between two moments whose state is certain. UsageError for times that do not
        ascend, neighbours more than 179 degrees apart, gaps.

        C++: `condyle::contact_between` in condyle/motion_contact.hpp.

        >>> import condyle
        >>> bones = condyle.sample_hip()
        >>> joint = condyle.Joint(bones.hip_bone, bones.femur)
        >>> contact, = joint.recorded_contact([0, 1, 2], joint.pose(flexion_deg=[0, 100, 140])).contacts
        >>> contact
        ContactInterval(1.86878 s to 2 s, exact)
        """
        return recorded_contact(self, time_s, poses, resolution_s, progress)

    def range_of_motion(self, motions: Optional[Sequence[MotionLike]] = None, *, bearing: BearingRule = "leave_out",
                        bearing_margin_mm: Optional[float] = None, accept_reference_contact: bool = False,
                        exclude_reference_contacts: Union[bool, int] = False,
                        translation_mm: Optional[ArrayLike] = None, clock: ClockPlane = "sagittal",
                        **other: object) -> RangeOfMotion:
        """How far the joint turns before bone meets bone, or a ligament of the joint ends it: exact limits of these motions, of all known ones if not
        given.

        Parameters
        ----------
        motions : names or Motion objects, optional
            Built-in ones of the joint and those of its file; [] for none.
        bearing : "leave_out" or "count"
            Whether contact of head and socket, where they slide, ends a motion.
        bearing_margin_mm : float, optional
            How far outside the head's sphere the bearing surface reaches.
        accept_reference_contact : bool
            Answer although the bodies are in contact in the reference pose.
        exclude_reference_contacts : bool or int
            Leave out what is in contact in the reference pose, with so many rings of neighbours (True: 2).
        translation_mm : (3,), optional
            For a free joint: the translation that all motions keep; default: that of the reference pose.
        clock : "sagittal" or "rim"
            Plane of the clock on which contacts are read: the sagittal one, or that of the rim with 6 at the notch.

        ReferenceContactError, a MeshError, where the bodies are in contact in the reference pose and nothing was said; MeshError for the
        clock of a rim where none was found.

        >>> import condyle
        >>> bones = condyle.sample_hip()
        >>> joint = condyle.Joint(bones.hip_bone, bones.femur)
        >>> joint.range_of_motion(["flexion", "internal_rotation_at_90_flexion"])
        RangeOfMotion(flexion 134.8, internal_rotation_at_90_flexion 52.0)
        """
        if {"age", "sex"} & set(other):
            raise UsageError('range_of_motion: age and sex are of the joint: Joint(..., person={"age": 39})')
        if other:
            raise TypeError(f"range_of_motion() got an unexpected keyword argument '{next(iter(other))}'")
        rings: Optional[int] = None
        if exclude_reference_contacts is True:
            rings = 2
        elif exclude_reference_contacts is not False:
            rings = count(exclude_reference_contacts, "exclude_reference_contacts", high=1000)
        options = {
            "count_bearing": word(bearing, "bearing", BearingRule) == "count",
            "bearing_margin_mm": None if bearing_margin_mm is None else number(bearing_margin_mm, "bearing_margin_mm"),
            "accept_reference_contact": bool(accept_reference_contact), "leave_out_rings": rings}
        known = Motions(self._native)
        asked = known.known if motions is None else known.asked(motions)
        return RangeOfMotion(self, known, [known.tuple_of(each) for each in asked], translation_mm,
                             word(clock, "clock", ClockPlane) == "rim", options)

    def measures(self, *, pelvic_tilt_deg: float = 0, band_samples: int = 0, seed: Optional[int] = None,
                 progress: Progress = None) -> HipMeasures:
        """The shape of a hip in numbers: alpha angles, versions, centre-edge angles, coverage, distances.

        Each is None where the meshes do not show it, with the reason. `pelvic_tilt_deg` tilts the pelvis forwards before
        acetabular angles are measured, which are those of the joint's frame else. `band_samples` above 0: with bands over so many
        varied joints, as :meth:`RangeOfMotion.bands` displaces them. UsageError for joints other than hips.

        C++: `condyle::measure_hip` in condyle/hip_measures.hpp; `condyle measure`.

        >>> import condyle
        >>> bones = condyle.sample_hip()
        >>> shape = condyle.Joint(bones.hip_bone, bones.femur).measures()
        >>> round(shape["centre_edge_lateral_section_deg"].value)
        34
        >>> shape["femoral_version_deg"].why_none
        'the mesh ends above the knee, 138 mm from the head'
        """
        return HipMeasures(self, pelvic_tilt_deg, band_samples, seed, progress)

    def resection(self, reach: Reach, *, cut: CutFrom = "mobile", share: Optional[float] = None,
                  margin_mm: Optional[float] = None, confidence: Optional[float] = None, deepest_mm: Optional[float] = None,
                  within_mm: Optional[float] = None, burr_mm: Optional[float] = None, keep: Optional[ArrayLike] = None,
                  keep_fixed: Optional[ArrayLike] = None, edge_mm: float = 0.5, curve_points: int = 10, band_samples: int = 200, seed: Optional[int] = None,
                  bearing: BearingRule = "leave_out", bearing_margin_mm: Optional[float] = None,
                  progress: Progress = None) -> Resection[Joint]:
        """The bone that must go so that each motion reaches its target, and the joint without it.

        Osseous: labrum, cartilage, capsule and the strength of the remaining bone are not modelled.

        Parameters
        ----------
        reach : mapping of motions to degrees
            How far each shall go from its start, or as a text with a plus, "+10", how far beyond its limit now.
        cut : "mobile", "fixed" or "both"
            The body that is cut; with "both" the fixed one for `share` of the depth, half if not given.
        margin_mm : float, optional
            The remaining bone stays clear of the other bone's surface moved outwards by this. Without it the margin is the smallest
            with which `confidence`, half if not given, of the varied joints reaches each target.
        confidence : float, optional
            That share, above 0 and below 1.
        deepest_mm, within_mm : float, optional
            Bone deeper than that stays, and bone farther than that outside the ball of the bearing surface. What the bearing surface
            has stays always.
        burr_mm : float, optional
            Diameter of the ball of a burr: what is left is what a ball of that size can make, no groove is narrower.
        keep, keep_fixed : (V,) bool, optional
            Vertices of the mobile and of the fixed mesh that stay.
        edge_mm : float
            Triangles around the cut become so small.
        curve_points : int
            Points on each target's curve of degrees against mm3; each costs a cut.
        band_samples : int
            Joints, displaced as :meth:`RangeOfMotion.bands` does, by which the plan is made and judged; 0: by the joint as given only.
        bearing, bearing_margin_mm :
            As :meth:`range_of_motion` takes them.

        Raises
        ------
        UsageError
            For motions that are not known or in contact at their start, and values outside their ranges. MeshError for open meshes.

        C++: `condyle::answer_resection` in condyle/answer.hpp; `condyle resect`.

        >>> import condyle
        >>> bones = condyle.sample_hip(alpha_angle_deg=70)
        >>> joint = condyle.Joint(bones.hip_bone, bones.femur)
        >>> plan = joint.resection({"internal_rotation_at_90_flexion": 45}, curve_points=0, band_samples=20)
        >>> plan.targets[0].confidence_reached >= 0.5
        True
        >>> plan.after[8].limit_deg >= 45
        True
        """
        return resection(self, Joint._of_native, reach, cut, share, margin_mm, confidence, deepest_mm, within_mm, burr_mm, keep, keep_fixed,
                         edge_mm, curve_points, band_samples, seed, bearing, bearing_margin_mm, progress)

    def brushed(self, strokes: Sequence[BrushStroke], *, body: Body = "mobile", keep: Optional[ArrayLike] = None,
                bearing: BearingRule = "leave_out", bearing_margin_mm: Optional[float] = None) -> Brushed[Joint]:
        """The joint without what strokes of a brush take from a bone, as by hand on the page of a report: the same bits.

        The surface goes inwards along its normals, smoothed over 3 mm, at most as deep below the surface before as the strokes are; the bearing
        surface stays. The mesh keeps its triangles: a cut is no finer than they are. Osseous: soft tissue is not modelled.

        Parameters
        ----------
        strokes : sequence of BrushStroke
        body : "mobile" or "fixed"
            The bone that is brushed.
        keep : (V,) bool, optional
            Its vertices that stay beside the bearing surface.
        bearing, bearing_margin_mm :
            As :meth:`range_of_motion` takes them.

        Raises
        ------
        UsageError
            For vertices that the mesh does not have, and sizes outside their ranges. MeshError for a mesh that is open or inside out.

        C++: `condyle::brush_joint` in condyle/brush.hpp; on the page of a report under *Plan*.

        >>> import condyle
        >>> bones = condyle.sample_hip(alpha_angle_deg=70)
        >>> joint = condyle.Joint(bones.hip_bone, bones.femur)
        >>> end = joint.range_of_motion()["internal_rotation_at_90_flexion"]
        >>> there = np.linalg.norm(joint.mobile.vertices - end.contact.mobile_point, axis=1).argmin()
        >>> done = joint.brushed([BrushStroke(there, radius_mm=8, depth_mm=2)])
        >>> done.after[8].limit_deg > done.before[8].limit_deg
        True
        """
        return brushed(self, Joint._of_native, strokes, body, keep, bearing, bearing_margin_mm)

    def implant(self, *, definition: CupDefinition = "radiographic", centre: ImplantCentre = "head", as_rim: bool = False,
                facets: int = 360, **sizes: float) -> PlacedImplant[Joint]:
        """A total hip in the place of this hip, and the joint with it.

        Bones and implant only: soft tissue, fixation and the strength of the remaining bone are not modelled.

        Parameters
        ----------
        definition : "radiographic", "anatomic" or "operative"
            Murray's definition of the cup's inclination and anteversion.
        centre : "head" or "socket"
            Where the centre of cup and head comes: that of the head of the femur, or of the socket.
        as_rim : bool
            The cup is turned as the rim of the bone is, in place of its inclination and anteversion.
        facets : int
            Around liner and neck.
        sizes : float
            By the names in :data:`REPLACEMENT_SIZES`. `neck_shaft_deg`, `stem_version_deg`, `offset_mm` and `cup_radius_mm` are those
            of the bones if they are not given.

        Raises
        ------
        UsageError
            For joints other than hips, sizes that are out of their range, and if the bones do not show what a size is to be taken from.
            MeshError for a femur that is not closed, ReferenceContactError if the bodies are in contact at zero angles.

        C++: `condyle::answer_implant` in condyle/answer.hpp; `condyle implant`.

        >>> import condyle
        >>> bones = condyle.sample_hip(scenario=1)
        >>> placed = condyle.Joint(bones.hip_bone, bones.femur).implant(inclination_deg=45)
        >>> sorted(placed.of_bones), list(placed.mobile)
        (['cup_radius_mm', 'neck_shaft_deg', 'offset_mm', 'stem_version_deg'], ['mobile', 'head', 'neck', 'stem'])
        >>> placed.joint.parameters["cup.inclination"].value, placed.sizes["cup_radius_mm"]
        (45.0, 27.0)
        """
        return placed_implant(self, Joint._of_native, sizes, definition, centre, as_rim, facets)

    def sweep(self, vary: Mapping[str, Sequence[float]], targets: Union[Path, Sequence[TargetLike]], *, band_samples: int = 0,
              seed: Optional[int] = None, measures: Sequence[str] = (), load: Optional[str] = None,
              force_n: Optional[ArrayLike] = None, best: BestDesign = "largest_margin", bearing: BearingRule = "leave_out",
              bearing_margin_mm: Optional[float] = None, accept_reference_contact: bool = False, progress: Progress = None) -> Sweep:
        """Limits over values of one to four :attr:`parameters`, and the designs that leave every target motion free.

        Osseous and prosthetic: soft tissue is not modelled.

        Parameters
        ----------
        vary : mapping of parameters to (first, last, step)
            In deg or mm; the last one changes fastest.
        targets : path, or sequence of Target or of (name, motion, reach_deg[, pelvic_tilt_deg])
            The motions that must be free: a CSV table as the command reads it (docs/sweeps.md), or a list of them.
        band_samples : int
            Above 0: the probability that each design is safe, of so many displaced by the standard deviations of the parameters.
        seed : int, optional
            That of the joint file if not given.
        measures : sequence of str
            Keys of :meth:`measures`, such as "centre_edge_lateral_section_deg": the shape of each design's hip too.
        load : str, optional
            A pose such as "flexion=30" ("" is the reference pose): contact pressure of each design there, with the layers of the joint file.
        force_n : (3,), optional
            With `load`: anterior, superior and lateral components of the force on the mobile body that the contact is to carry, in N.
        best : {"largest_margin", "least_change"}
            Which design is called the best: the one with the largest of the least margins, or the safe one with the fewest steps from the joint
            as it is.
        bearing, bearing_margin_mm, accept_reference_contact :
            As :meth:`range_of_motion` takes them.

        Raises
        ------
        UsageError
            For parameters and motions that there are not, and values outside their ranges. FileError for a wrong table.

        Ctrl-C ends it; `progress` is called with (done, total).

        C++: `condyle::answer_sweep` in condyle/answer.hpp; `condyle sweep`.

        >>> import condyle
        >>> hip = condyle.sample_replacement(bones="none", facets=120).joint
        >>> zone = hip.sweep({"cup.inclination": (40, 50, 10), "cup.anteversion": (-20, 40, 10)},
        ...                  [("sitting", "flexion", 110), ("pivoting", "external_rotation", 40)])
        >>> zone.safe.astype(int)
        array([[0, 0, 1, 1, 1, 1, 0],
               [0, 0, 1, 1, 1, 0, 0]])
        >>> zone.safe_intervals[1].high_target
        'pivoting'
        """
        return sweep(self, vary, targets, band_samples, seed, measures, load, force_n, best, bearing, bearing_margin_mm, accept_reference_contact, progress)

    def with_mobile(self, mesh: MeshLike) -> Joint:
        """The joint with this mesh in the mobile body's place: the same bone after something was done to it, in the frame M of
        :attr:`mobile`. Its head is unchanged.

        C++: `condyle::with_mobile_mesh` in condyle/resection.hpp.
        """
        return Joint._of_native(_native.with_mobile(self._native, TriMesh.of(mesh)._native))

    def range_following(self, motions: Optional[Sequence[MotionLike]] = None, *, poses: Optional[ArrayLike] = None,
                        contact: Optional[ElasticContact] = None, force_n: Optional[ArrayLike] = None, frame: Body = "fixed",
                        free_directions: ArrayLike = (), step_deg: float = 1, bearing: BearingRule = "leave_out",
                        bearing_margin_mm: Optional[float] = None, progress: Progress = None) -> FollowedRange:
        """How far a free joint turns if its centre is not held: its translation follows a recorded motion, or a load.

        Parameters
        ----------
        motions : names or Motion objects, optional
            With `poses`, if not given, all that the recorded motion leads along: an angle that only grows, or only falls.
        poses : (N, 4, 4), optional
            A recorded motion, as :meth:`motion` reads it: along a motion that varies one angle, the translation is that of the
            frame with this angle, linear between two frames. The other angles are held.
        contact, force_n : ElasticContact and (3,), optional
            Every `step_deg` the body is where this contact carries the force on the mobile body, in N, in `frame`; linear in between.
            `free_directions` as :meth:`ElasticContact.balance` takes them; rotations are held.
        bearing, bearing_margin_mm :
            As :meth:`range_of_motion` takes them.

        Limits are bounded, not exact. Ctrl-C ends it; `progress` is called with (done, total).

        C++: `condyle::answer_range` with `RangeRequest::follow` in condyle/answer.hpp; `condyle rom --follow`.
        """
        return followed_range(self, motions, poses, contact, force_n, frame, free_directions, step_deg, bearing,
                              bearing_margin_mm, progress)

    def picture(self, pose: OnePoseLike, *, view: str = "anterior", colour: Colour = "depth",
                about: Optional[AboutLike] = None, fixed: BodyStyle = "solid", mobile: BodyStyle = "solid", width: int = 1200,
                height: int = 900, range_mm: Optional[float] = None, field_mm: Union[float, Literal["all"], None] = None,
                measures: bool = False, plain: bool = False) -> NDArray[np.uint8]:
        """Both bodies at one pose, drawn without a display: (height, width, 3) uint8, red, green, blue, from the top left.

        Parameters
        ----------
        view : text
            "anterior", "posterior", "left", "right", "superior", "inferior", "medial", "lateral", or several with hyphens.
        colour : "depth", "gap", "nearest" or "none"
            Quantity that colours the surfaces; the scale stands below.
        about : optional
            Depths are along arcs about this, as :meth:`penetration` takes it.
        fixed, mobile : "solid", "transparent" or "hidden"
        range_mm : float, optional
            End of the colours.
        field_mm : float or "all", optional
            Height of what is shown about the joint centre, or both bodies. Default: the contact and its surroundings, else the joint.
        measures : bool
            Draw what :meth:`measures` measures a hip by too, as far as it was found: axis of the neck, points and plane of
            the rim, where the head's contour ends.
        plain : bool
            Leave out the scale bar, the letters of the sides (A, P, S, I, R, L), the line of the pose and the key of `measures`.

        Where depths are shown and both bodies are solid, the outer one is drawn as glass: the depths would be hidden.

        MeshError where a depth or a gap is asked of an open mesh. `matplotlib.pyplot.imsave(path, pixels)` writes it.

        C++: `condyle::draw_joint` in condyle/io/picture.hpp; `condyle picture`.

        >>> import condyle
        >>> bones = condyle.sample_hip()
        >>> joint = condyle.Joint(bones.hip_bone, bones.femur)
        >>> joint.picture({"flexion_deg": 140}, view="lateral", width=320, height=240).shape
        (240, 320, 3)
        """
        return _native.picture(
            *self._asked_at(pose), text_of(view, "view"),
            word(colour, "colour", Colour), None if about is None else self._about(about),
            word(fixed, "fixed", BodyStyle), word(mobile, "mobile", BodyStyle),
            count(width, "width"), count(height, "height"),
            None if range_mm is None else number(range_mm, "range_mm"),
            None if field_mm is None else np.inf if isinstance(field_mm, str) and field_mm == "all" else number(field_mm, "field_mm"),
            bool(measures), bool(plain))

    def path_limit(self, waypoints: Sequence[Mapping[str, float]], *, tolerance_deg: float = 1e-3) -> PathLimit:
        """Where a path of straight segments in the joint's angles ends, several of which may change at once.

        `waypoints` are two or more mappings of angles in degrees by their names. The path is free up to the limit,
        whatever the surfaces do between two poses; it ends where a rotation by the tolerance might bring them together.

        C++: `condyle::PathFinder` in condyle/range_of_motion.hpp.
        """
        return path_limit(self, waypoints, tolerance_deg)

    def __repr__(self) -> str:
        return (f"Joint({self.name!r}: {self.kind} {self.joint}, {self.side}; {self.fixed_name} "
                f"{len(self._fixed.vertices)} vertices, {self.mobile_name} {len(self._mobile.vertices)} vertices)")

    def _repr_html_(self) -> str:
        return html_of(self.name, [("kind", f"{self.kind}, {self.joint}, {self.side}"),
                                   (self.fixed_name, repr(self._fixed)), (self.mobile_name, repr(self._mobile))])


def read_joint(path: Path) -> Joint:
    """Reads a joint file (docs/joint-file.md) and its meshes. FileError, and MeshError where a fit finds nothing.

    C++: `condyle::read_joint` in condyle/io/joint_file.hpp.
    """
    return Joint.from_file(path)
