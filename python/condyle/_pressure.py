"""Pressure of surfaces with layers, and the poses in which it carries loads."""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import Any, Iterable, Optional, Sequence, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._contact_checks import ContactNote, contact_notes, warn_of
from ._contact_forces import ContactForces, forces_of
from ._deforming import DeformingContact
from ._described_joint import DescribedJoint
from ._errors import UsageError
from ._mesh import MeshLike, TriMesh
from ._poses import Pose
from ._shared_use import SharedUse
from ._surface_contact import SurfaceContact, surface_of
from ._words import BalanceOutcome, Bodies, Body, FaceRule, PressureLaw, Progress, array, count, number, progress_of
from ._words import word

OneMatrix = Union[np.ndarray[tuple[int, int], np.dtype[np.generic]], Sequence[Sequence[float]]]
ManyMatrices = Union[np.ndarray[tuple[int, int, int], np.dtype[np.generic]], Sequence[Pose],
                     Sequence[Sequence[Sequence[float]]]]


@dataclass(frozen=True)
class ElasticLayer:
    """A layer on a body: Young's modulus above 0, Poisson's ratio above -1 and below 0.5, thickness above 0.

    `thickness_mm` is one number, or one for each vertex of the layer's mesh, (V,).
    """

    youngs_modulus_mpa: float
    poisson_ratio: float
    thickness_mm: Union[float, NDArray[np.float64]]

    def _checked(self, mesh: TriMesh) -> dict[str, Any]:
        thickness: Any = self.thickness_mm
        if not isinstance(thickness, (list, tuple)) and getattr(thickness, "ndim", 0) == 0:
            thickness = number(thickness, "thickness_mm")
        elif mesh._first is not None:
            thickness = array(thickness, "thickness_mm", "a number for each vertex")
            if thickness.shape != mesh.vertices.shape[:1]:
                raise UsageError(f"thickness_mm: an array of shape ({len(mesh.vertices)},) is needed")
            thickness = thickness[mesh._first]
        return {"youngs_modulus_mpa": number(self.youngs_modulus_mpa, "youngs_modulus_mpa"),
                "poisson_ratio": number(self.poisson_ratio, "poisson_ratio"), "thickness_mm": thickness}


@dataclass(frozen=True, eq=False, repr=False)
class ElasticContactResults:
    """Results of one pose.

    `fixed` and `mobile` are the :class:`SurfaceContact` of those that cast; `force_n` and `moment_nmm` (3,) what the
    fixed body exerts on the mobile one, in F, about the origin of M; `energy_nmm` stored in the layers; `notes` what looks
    wrong with the contact, a :class:`ContactNote` each (docs/checks.md).
    """

    fixed: Optional[SurfaceContact]
    mobile: Optional[SurfaceContact]
    force_n: NDArray[np.float64]
    moment_nmm: NDArray[np.float64]
    energy_nmm: float
    notes: tuple[ContactNote, ...]

    def __repr__(self) -> str:
        return (f"ElasticContactResults(force {np.linalg.norm(self.force_n):.6g} N, energy {self.energy_nmm:.6g} N mm; "
                f"fixed={self.fixed!r}, mobile={self.mobile!r})")


@dataclass(frozen=True)
class BalanceOptions:
    """How a balance is searched for.

    Attributes
    ----------
    force_tolerance_n, moment_tolerance_nmm : float
        Largest residual force and moment in a balanced pose.
    farthest_mm : float
        How far the mobile body may go from where it starts.
    most_steps : int
    most_left_at_jump : float
        Share of the load that may remain just before the force jumps, or if no step leaves less: outcome
        "at_jump".
    """

    force_tolerance_n: float = 1e-6
    moment_tolerance_nmm: float = 1e-4
    farthest_mm: float = 20
    most_steps: int = 100
    most_left_at_jump: float = 0.02

    def _checked(self) -> dict[str, Any]:
        return {"force_tolerance_n": number(self.force_tolerance_n, "force_tolerance_n", low=0),
                "moment_tolerance_nmm": number(self.moment_tolerance_nmm, "moment_tolerance_nmm", low=0),
                "farthest_mm": number(self.farthest_mm, "farthest_mm", low=0),
                "most_steps": count(self.most_steps, "most_steps", high=1_000_000),
                "most_left_at_jump": number(self.most_left_at_jump, "most_left_at_jump", 0, 1)}


@dataclass(frozen=True, eq=False)
class BalancedPose:
    """The pose in which the contact carries a load, or why there is none.

    `outcome` is "balanced", "at_jump" (all but a little of the load is carried, and the force jumps just beyond, or no
    step leaves less), "pulled_apart", "over_the_rim", "too_large", "unstable" or "free_direction"; `reason` one line where
    there is no balance; `X_FM` (4, 4) the pose found, or the last one looked at; `residual_force_n` and
    `residual_moment_nmm` (3,) what contact and load add up to along the free directions; `contact` at that pose; `notes` what looks
    wrong with the load or the contact.
    """

    outcome: BalanceOutcome
    reason: str
    X_FM: Pose
    residual_force_n: NDArray[np.float64]
    residual_moment_nmm: NDArray[np.float64]
    steps: int
    contact: ElasticContactResults
    notes: tuple[ContactNote, ...]

    @property
    def carries_load(self) -> bool:
        """Whether the contact carries the load at `X_FM`: balanced, unstable, or at a jump up to the residual."""
        return self.outcome in ("balanced", "unstable", "at_jump")


class ElasticContact(DeformingContact):
    """Two surfaces with their layers, ready to be asked at any pose. Any number of threads may ask; an update waits for them.

    Parameters
    ----------
    fixed, mobile : mesh
        Surfaces in their bodies' frames, mm; open ones too.
    fixed_layer, mobile_layer : ElasticLayer, optional
        At least one; a body without one is rigid.
    casting : "both", "fixed" or "mobile"
        The body whose surface is cast along its normals; with "both" the load is the mean of the two.
    rule : "cut_faces" or "face_centre"
    reach_mm : float
        How far rays go.
    law : "linear" or "logarithmic"

    C++: `condyle::ElasticContact` in condyle/pressure.hpp; `condyle load`.

    >>> import condyle
    >>> layers = condyle.sample_cartilages(clearance_mm=0)
    >>> contact = condyle.ElasticContact(layers.acetabular, layers.femoral,
    ...                                  mobile_layer=condyle.ElasticLayer(12, 0.42, 1.65))
    >>> pressed = contact.balance([0, 800, 0])
    >>> pressed.outcome, (pressed.contact.force_n.round(3) + 0.0).tolist()
    ('balanced', [0.0, -800.0, 0.0])
    """

    __slots__ = ("_has_warned", "__weakref__")

    _native: _native.ElasticContact

    def __init__(self, fixed: MeshLike, mobile: MeshLike, *, fixed_layer: Optional[ElasticLayer] = None,
                 mobile_layer: Optional[ElasticLayer] = None, casting: Bodies = "both",
                 rule: FaceRule = "cut_faces", reach_mm: float = 20, law: PressureLaw = "linear") -> None:
        self._fixed, self._mobile = TriMesh.of(fixed), TriMesh.of(mobile)
        self._has_warned, self._shared = False, SharedUse()
        for layer, what in ((fixed_layer, "fixed_layer"), (mobile_layer, "mobile_layer")):
            if layer is not None and not isinstance(layer, ElasticLayer):
                raise UsageError(f"{what}: an ElasticLayer is needed, not {type(layer).__name__}")
        self._native = _native.ElasticContact(
            self._fixed._native, self._mobile._native,
            None if fixed_layer is None else fixed_layer._checked(self._fixed),
            None if mobile_layer is None else mobile_layer._checked(self._mobile),
            word(casting, "casting", Bodies), word(rule, "rule", FaceRule),
            number(reach_mm, "reach_mm"), word(law, "law", PressureLaw) == "logarithmic")

    @classmethod
    def of_file(cls, joint: DescribedJoint) -> ElasticContact:
        """With the surfaces, layers and rays that the table [contact] of the joint's file says."""
        native = _native.elastic_of_file(joint._asked)
        if native is None:
            raise UsageError("joint: its file has no table [contact]")
        contact = cls.__new__(cls)
        contact._native = native
        contact._fixed, contact._mobile = TriMesh._of_native(native.fixed), TriMesh._of_native(native.mobile)
        contact._has_warned, contact._shared = False, SharedUse()
        return contact

    @overload
    def at(self, pose: OneMatrix, *, progress: Progress = None) -> ElasticContactResults: ...

    @overload
    def at(self, pose: ManyMatrices, *, progress: Progress = None) -> list[ElasticContactResults]: ...

    def at(self, pose: ArrayLike, *, progress: Progress = None
           ) -> Union[ElasticContactResults, list[ElasticContactResults]]:
        """:class:`ElasticContactResults` of X_FM, (4, 4); of (N, 4, 4) a list of N.

        MeshError with the logarithmic law where the overlap reaches the thickness.
        """
        with self._shared.use():
            is_one, found = self._native.at(pose, progress_of(progress))
        results = [results_of(each) for each in found]
        self._warn(results)
        return results[0] if is_one else results

    def forces(self, pose: ArrayLike, *, velocity_mm_s: Optional[ArrayLike] = None,
               angular_velocity_rad_s: Optional[ArrayLike] = None, friction: float = 0, slip_velocity_mm_s: float = 1,
               damping_s_per_mm: float = 0, factor: float = 1, vertex_forces: bool = False, stiffness: bool = False,
               vertex_stiffness: bool = False, patches: bool = False) -> ContactForces:
        """:class:`ContactForces` of X_FM, (4, 4), for a simulator to integrate (docs/contact.md).

        Parameters
        ----------
        velocity_mm_s, angular_velocity_rad_s : (3,)
            Of the origin of M, mm/s, and of the mobile body, rad/s, relative to the fixed body, in F; at rest if not given.
        friction : float
            Coefficient mu: the traction is mu p v / sqrt(v^2 + s^2) against the sliding velocity v.
        slip_velocity_mm_s : float
            s, mm/s, above 0.
        damping_s_per_mm : float
            c, s/mm: pressures are multiplied by max(0, 1 + c * rate of depth).
        factor : float
            From 0 to 1: pressures, energy and stiffness are multiplied by it, as :class:`ContactRamp` gives it.
        vertex_forces, stiffness, vertex_stiffness, patches : bool
            What is computed too; with `vertex_stiffness` also `vertex_forces`.

        UsageError for numbers outside their domain; MeshError as :meth:`at`.

        C++: `condyle::ElasticContact::forces` in condyle/pressure.hpp.

        >>> import condyle, numpy as np
        >>> layers = condyle.sample_cartilages(clearance_mm=-0.05)
        >>> contact = condyle.ElasticContact(layers.acetabular, layers.femoral,
        ...                                  mobile_layer=condyle.ElasticLayer(12, 0.42, 1.65))
        >>> found = contact.forces(np.eye(4), velocity_mm_s=[0, 5, 0], friction=0.01, vertex_forces=True)
        >>> bool(np.allclose(found.on_mobile.force_n.sum(axis=0), found.force_n))
        True
        """
        with self._shared.use():
            found = _native.forces_at(self._native, pose, {
                "velocity_mm_s": velocity_mm_s, "angular_velocity_rad_s": angular_velocity_rad_s,
                "friction": number(friction, "friction"), "slip_velocity": number(slip_velocity_mm_s, "slip_velocity_mm_s"),
                "damping": number(damping_s_per_mm, "damping_s_per_mm"), "factor": number(factor, "factor"),
                "vertex_forces": bool(vertex_forces), "stiffness": bool(stiffness),
                "vertex_stiffness": bool(vertex_stiffness), "patches": bool(patches)})
        forces = forces_of(found, self._fixed, self._mobile)
        self._warn([forces])
        return forces

    @property
    def notes(self) -> tuple[ContactNote, ...]:
        """Warnings on the layers: moduli, Poisson's ratios, thicknesses, a layer on a bone.

        C++: `condyle::check_layers` in condyle/motion_contact.hpp.

        >>> import condyle
        >>> layers = condyle.sample_cartilages(clearance_mm=0)
        >>> in_pascal = condyle.ElasticLayer(12e6, 0.42, 1.65)
        >>> contact = condyle.ElasticContact(layers.acetabular, layers.femoral, mobile_layer=in_pascal)
        >>> [note.code for note in contact.notes]
        ['unlikely_modulus']
        """
        with self._shared.use():
            return contact_notes(self._native.notes())

    def refined_force_n(self, pose: ArrayLike) -> Optional[NDArray[np.float64]]:
        """(3,) the force on the mobile body, in F, with the depth asked at 16 places of each face in contact.

        How far it is from `at(pose).force_n` is what the triangles' size leaves open. None with the rule "face_centre".

        C++: `condyle::ElasticContact::refined_force_n` in condyle/pressure.hpp.
        """
        with self._shared.use():
            return self._native.refined_force_n(pose)

    def cut_off_by_reach(self, pose: ArrayLike) -> int:
        """How many rays of this pose meet the other surface only beyond the reach, up to twice of it."""
        with self._shared.use():
            return self._native.cut_off_by_reach(pose)

    def balance(self, force_n: ArrayLike, *, moment_nmm: ArrayLike = (0, 0, 0), start: Optional[ArrayLike] = None,
                frame: Body = "fixed", free_directions: ArrayLike = (), free_rotations: bool = False,
                ligaments: Optional[DescribedJoint] = None, options: BalanceOptions = BalanceOptions()) -> BalancedPose:
        """The pose near `start` (the identity if not given) in which the contact carries a load on the mobile body.

        `force_n` and `moment_nmm` about the origin of M are held in F, or with `frame="mobile"` go along with M.
        Directions (K, 3) in F along which the body may be translated, all if none are given; with `free_rotations` its
        rotations are unknowns too; without it a moment has nothing to balance it and is refused. With a joint as
        `ligaments` its ligaments pull beside the contact, and the load may be zero. UsageError where the load
        is zero along the free directions otherwise. Not ended by Ctrl-C.

        C++: `condyle::balance` in condyle/pressure.hpp.
        """
        _refuse_moment(moment_nmm, free_rotations)
        with self._shared.use():
            pose = balanced(_native.balance(self._native, np.eye(4) if start is None else start, force_n, moment_nmm,
                                            _terms(options, frame, free_directions, free_rotations, ligaments)))
        self._warn([pose])
        return pose

    def balance_along(self, poses: ArrayLike, force_n: ArrayLike, *, moment_nmm: ArrayLike = (0, 0, 0),
                      frame: Body = "fixed", free_directions: ArrayLike = (), free_rotations: bool = False,
                      ligaments: Optional[DescribedJoint] = None, options: BalanceOptions = BalanceOptions(), progress: Progress = None
                      ) -> list[Optional[BalancedPose]]:
        """The poses that balance a load, frame after frame of a motion, (N, 4, 4); None for those of NaN, gaps.

        Rotations are the given ones; each frame starts from its translation as the last frame that carries its load has
        moved its own, and on as that changed between two balanced frames next to each other. `force_n` and `moment_nmm`
        are each (3,) for all frames, or (N, 3); the rest as :meth:`balance` takes it. UsageError where there are neither
        one nor N loads.

        C++: `condyle::balance_along` in condyle/motion_contact.hpp.
        """
        _refuse_moment(moment_nmm, free_rotations)
        forces, moments = _loads(force_n, moment_nmm)
        with self._shared.use():
            found = _native.balance_along(self._native, poses, forces, moments,
                                          _terms(options, frame, free_directions, free_rotations, ligaments), progress_of(progress))
        frames = [None if pose is None else balanced(pose) for pose in found]
        self._warn(frames)
        return frames

    def _warn(self, answers: Iterable[Union[ElasticContactResults, ContactForces, BalancedPose, None]]) -> None:
        """Warns of what looks wrong with answers, and with the layers at the first one."""
        of_answers = [note for each in answers if each is not None for note in each.notes]
        of_layers = () if self._has_warned else self.notes
        warn_of([*of_layers, *of_answers])
        self._has_warned = True  # a warning that is an error is one again at the next answer

    def __repr__(self) -> str:
        return f"ElasticContact(fixed={self._fixed!r}, mobile={self._mobile!r})"


class ContactRamp:
    """Brings a contact in smoothly that overlaps before the first step: from nothing to all of it.

    `start` is the pose (4, 4) of the first step, `duration_s` is above 0.

    C++: `condyle::ContactRamp` in condyle/pressure.hpp.

    >>> import condyle, numpy as np
    >>> layers = condyle.sample_cartilages(clearance_mm=-0.3)
    >>> contact = condyle.ElasticContact(layers.acetabular, layers.femoral,
    ...                                  mobile_layer=condyle.ElasticLayer(12, 0.42, 1.65))
    >>> ramp = condyle.ContactRamp(contact, np.eye(4), 0.1)
    >>> ramp.has_overlap, [ramp.factor_at(t) for t in (0, 0.05, 0.1)]
    (True, [0.0, 0.5, 1.0])
    """

    __slots__ = ("_native",)

    def __init__(self, contact: ElasticContact, start: ArrayLike, duration_s: float) -> None:
        if not isinstance(contact, ElasticContact):
            raise UsageError(f"contact: an ElasticContact is needed, not {type(contact).__name__}")
        with contact._shared.use():
            self._native = _native.ContactRamp(contact._native, start, number(duration_s, "duration_s"))

    @property
    def has_overlap(self) -> bool:
        return self.max_depth_mm > 0

    @property
    def max_depth_mm(self) -> float:
        """The largest overlap at the start."""
        return self._native.max_depth_mm

    @property
    def energy_nmm(self) -> float:
        """Stored in the layers at the start."""
        return self._native.energy_nmm

    @property
    def duration_s(self) -> float:
        return self._native.duration_s

    def factor_at(self, time_s: float) -> float:
        """3 s^2 - 2 s^3 at the share s of the duration, 0 before it and 1 after it; 1 throughout without overlap."""
        return self._native.factor_at(number(time_s, "time_s"))

    def __repr__(self) -> str:
        return (f"ContactRamp({self.duration_s:g} s, overlap {self.max_depth_mm:.3g} mm, "
                f"energy {self.energy_nmm:.6g} N mm)")


def _loads(force_n: ArrayLike, moment_nmm: ArrayLike) -> tuple[NDArray[Any], NDArray[Any]]:
    """A row of both for all frames, or one for each."""
    wanted = "an array of shape (3,) or (N, 3)"
    forces = np.atleast_2d(array(force_n, "force_n", wanted))
    moments = np.atleast_2d(array(moment_nmm, "moment_nmm", wanted))
    if forces.ndim == moments.ndim == 2 and len(forces) != len(moments):
        if 1 not in (len(forces), len(moments)):
            raise UsageError(f"moment_nmm: {len(moments)} moments for {len(forces)} forces")
        frames = max(len(forces), len(moments)) if min(len(forces), len(moments)) else 0
        forces, moments = (np.broadcast_to(each, (frames, *each.shape[1:])) for each in (forces, moments))
    return forces, moments


def _refuse_moment(moment_nmm: ArrayLike, free_rotations: bool) -> None:
    moments = array(moment_nmm, "moment_nmm", "an array of shape (3,) or (N, 3)")
    if not free_rotations and moments.dtype.kind in "fiu" and moments.any():
        raise UsageError("moment_nmm: needs free_rotations")


def _terms(options: BalanceOptions, frame: Body, free_directions: ArrayLike, free_rotations: bool,
           ligaments: Optional[DescribedJoint]) -> dict[str, Any]:
    if ligaments is not None and not isinstance(ligaments, DescribedJoint):
        raise UsageError(f"ligaments: a Joint is needed, not {type(ligaments).__name__}")
    if not isinstance(options, BalanceOptions):
        raise UsageError(f"options: BalanceOptions are needed, not {type(options).__name__}")
    is_empty = isinstance(free_directions, (tuple, list)) and not free_directions
    return {**options._checked(), "goes_along": word(frame, "frame", Body) == "mobile",
            "free_directions": np.empty((0, 3)) if is_empty else free_directions,
            "free_rotations": bool(free_rotations), "ligaments": None if ligaments is None else ligaments._native}


def balanced(found: dict[str, Any]) -> BalancedPose:
    found["residual_force_n"], found["residual_moment_nmm"] = found.pop("residual")
    found["contact"] = results_of(found["contact"])
    found["notes"] = contact_notes(found["notes"])
    return BalancedPose(**found)


def results_of(found: dict[str, Any]) -> ElasticContactResults:
    found["fixed"], found["mobile"] = surface_of(found["fixed"]), surface_of(found["mobile"])
    found["notes"] = contact_notes(found["notes"])
    return ElasticContactResults(**found)


def used(contact: Optional[ElasticContact]) -> AbstractContextManager[None]:
    """Holds updates off while a question that takes the contact along is answered."""
    return nullcontext() if contact is None else contact._shared.use()
