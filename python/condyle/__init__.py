"""Where the bones of a joint run into each other: exact contact, depth and range of motion.

Arrays are numpy's, lengths are millimetres, angles degrees; names say so where they have a unit. Frames: F is that of
the fixed body, M that of the mobile one; a pose X_FM is a (4, 4) matrix with p_F = X_FM p_M. Every
error that the module raises on purpose is a :class:`CondyleError` of one line: :class:`FileError` (an OSError),
:class:`MeshError` and :class:`UsageError` (ValueErrors), and of the last one :class:`UnknownNameError` (a KeyError) and
:class:`OutOfRangeError` (an IndexError). What looks wrong with a joint is a :class:`JointWarning` at its first answer;
what an answer must be read with is a :class:`JointRemark`.
"""

from ._brush import Brushed, BrushStroke, StrokeOutcome
from ._clock_face import ClockFace, clock_face, find_neck_axis, find_rim_clock, neck_clock, sagittal_clock
from ._contact_checks import ContactNote
from ._contact_forces import ContactForces, ForcePatch, VertexForces, VertexStiffness
from ._depth_range import DeepestPlace, DepthLimit, DepthRange
from ._described_joint import BodyPart, JointNote, PartParameter, ZeroPose
from ._errors import CondyleError, FileError, JointRemark, JointWarning, MeshError, OutOfRangeError, ReferenceContactError
from ._errors import UnknownNameError, UsageError
from ._first_contact import FirstContact, RotationLimits
from ._fit import CylinderFit, SphereFit, find_cylinder, find_sphere, fit_cylinder, fit_sphere
from ._functional_centre import FunctionalAxis, FunctionalCentre, functional_axis, functional_centre
from ._gaps import DEPTH_KINDS, ContactMeasures, ContactPatch, Depths, Gaps, VertexDepths, VertexGaps
from ._impingement_zone import BodyZone, ImpingementZone
from ._implant import REVERSE_SHOULDER_SIZES, SampleImplant, sample_replacement
from ._implant import sample_reverse_shoulder
from ._inspect import Finding, MeshComponent, MeshReport, inspect
from ._joint import Joint, read_joint
from ._joint_contact import JointContact
from ._labels import Label, LabelMap, LabelNote, LabelPiece, LabelSurface, SurfaceCut, read_labels, surface
from ._ligaments import Ligament, LigamentStates, LigamentWrap
from ._limit_band import LimitBand, LimitBands
from ._followed_range import FollowedRange
from ._hip_measures import HipMeasure, HipMeasures
from ._limits import KINDS, REASONS, ContactWitness, FreeAngles, Limit, MotionLimit, PathLimit
from ._mesh import MeshLike, TriMesh, read_mesh, write_mesh
from ._model import Model, ModelCoordinate, ModelJoint, ModelMesh, ModelNote, read_model
from ._motion import Motion
from ._motion_contact import ContactFrames, FrameContact, ScrewStep
from ._motion_map import MapEnds, MotionMap
from ._native import version as __version__
from ._penetration import INSIDE, NO_INDEX, ON_SURFACE, OUTSIDE, Penetration, Penetrations, VerticesInside
from ._placed_implant import REPLACEMENT_SIZES, PlacedImplant
from ._pose_standing import NearestLimit, PoseStanding
from ._poses import Pose, Poses
from ._pressure import BalancedPose, BalanceOptions, ContactRamp, ElasticContact, ElasticContactResults, ElasticLayer
from ._propose_joint import JointProposal, propose_joint
from ._range_of_motion import Bearing, FittedSphere, ImplantPair, MotionArc, RangeOfMotion
from ._recorded_motion import ContactEnd, ContactInterval, JointMotion, MotionTable, RecordedContact
from ._recorded_motion import read_motion_table
from ._record import Record
from ._records import BoneReference, Caveat, ClosedForm, LivingLimit, MeasureBand, NormalRange, PeopleRange, SlideRecord, SoftTissueGap
from ._records import TouchRecord, TurnRecord
from ._resection import Blocked, CurvePoint, CutBone, OtherCentre, ReachedTarget, Resection, ResectionAlternative
from ._sample import HIP_PARAMETERS, SampleCartilages, SampleHip, sample_cartilages, sample_hip
from ._study import Study, StudyLoad, StudyResection, StudyTable, merge_study, read_study, run_study, sample_cohort
from ._surface_contact import ContactTotals, NormalContact, SurfaceContact, thickness_to
from ._sweep import KNOWN_BY, Design, EndingPair, SafeInterval, Sweep, Target
from ._tables import OccupiedArcs, RadialTable, RingTable
from ._touch import Answers, slide, touch, turn

__all__ = [
    "Answers", "BalanceOptions", "BalancedPose", "Bearing", "Blocked", "BoneReference", "BrushStroke", "Brushed", "CurvePoint", "CutBone", "OtherCentre", "ReachedTarget", "Resection", "ResectionAlternative", "BodyPart", "BodyZone", "Caveat", "ClockFace", "ClosedForm", "CondyleError",
    "ContactEnd", "ContactForces", "ContactFrames", "ContactInterval", "ContactMeasures", "ContactNote", "ContactPatch", "ContactRamp",
    "ContactTotals", "ContactWitness", "CylinderFit", "DeepestPlace", "DepthLimit", "DepthRange", "DEPTH_KINDS", "Depths", "Design",
    "ElasticContact", "ElasticContactResults", "ElasticLayer", "EndingPair", "FileError", "Finding", "FirstContact", "FrameContact",
    "FittedSphere", "FollowedRange", "HipMeasure", "HipMeasures", "MeasureBand", "NormalRange", "ForcePatch", "FreeAngles", "FunctionalAxis", "FunctionalCentre", "Gaps", "HIP_PARAMETERS", "INSIDE", "ImpingementZone", "ImplantPair", "Joint", "JointContact", "JointMotion", "Ligament", "LigamentStates", "LigamentWrap", "JointNote", "PartParameter", "ZeroPose",
    "JointProposal", "JointRemark", "JointWarning", "KINDS", "KNOWN_BY", "Label", "LabelMap", "LabelNote", "LabelPiece", "LabelSurface", "Limit",
    "LimitBand", "LimitBands", "LivingLimit", "MapEnds", "MeshComponent", "MeshError", "MeshLike", "MeshReport", "Model", "ModelCoordinate", "ModelJoint", "ModelMesh", "ModelNote", "Motion", "MotionArc", "MotionLimit",
    "MotionMap", "MotionTable", "NO_INDEX", "NearestLimit", "NormalContact", "ON_SURFACE", "OUTSIDE", "OccupiedArcs",
    "OutOfRangeError", "PathLimit", "PeopleRange", "Penetration", "Penetrations", "PlacedImplant", "Pose", "PoseStanding", "Poses", "REASONS", "REPLACEMENT_SIZES", "REVERSE_SHOULDER_SIZES", "RadialTable",
    "RangeOfMotion", "Record", "RecordedContact", "ReferenceContactError", "RingTable", "RotationLimits", "SampleCartilages",
    "SafeInterval", "SampleHip", "SampleImplant", "ScrewStep", "SlideRecord", "SoftTissueGap", "SphereFit", "Study", "StudyLoad", "StudyResection", "StrokeOutcome", "StudyTable", "SurfaceContact", "SurfaceCut", "Sweep", "Target", "TouchRecord", "TriMesh", "TurnRecord",
    "UnknownNameError", "UsageError", "VertexDepths", "VertexForces", "VertexGaps", "VertexStiffness", "VerticesInside", "__version__",
    "clock_face", "find_cylinder", "find_neck_axis", "find_rim_clock", "find_sphere", "fit_cylinder", "fit_sphere", "functional_axis", "functional_centre",
    "inspect", "merge_study", "neck_clock", "propose_joint", "read_joint", "read_labels", "read_mesh", "read_model",
    "read_motion_table", "read_study", "run_study", "sagittal_clock", "sample_cartilages", "sample_cohort",
    "sample_hip", "sample_replacement", "sample_reverse_shoulder", "slide", "surface", "thickness_to", "touch", "turn", "write_mesh",
]
