#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/fit.hpp"
#include "condyle/joint_coordinates.hpp"
#include "condyle/mesh.hpp"

namespace condyle {

enum class BodyRole { fixed, mobile };

/// Meaning for a motion of contact with one of several meshes of a body. With bone as `ends`, cartilage as `bearing` and a labrum
/// as `soft`:
///
///     mobile \ fixed   ends          bearing       soft
///     ends             ends          ends          noted         noted: where they first touch stands beside the limit
///     bearing          ends *        slides        noted         slides: the same, as bearing contact
///     soft             noted         noted         noted
///
/// * slides if no mesh of the fixed body is called bearing, and on the head of a hip or shoulder: BearingSurface.
enum class PartContact : std::uint8_t {
  ends,     ///< It ends a motion.
  bearing,  ///< It slides on bearing meshes of the other body, as cartilage does.
  soft,     ///< It gives way, as a labrum or a meniscus does.
};

/// As in files: "bearing".
[[nodiscard]] std::string_view name_of(PartContact contact) noexcept;

/// Which vertices and triangles of a body's mesh came from one of several meshes.
struct BodyPart {
  std::string name;
  std::size_t first_vertex, vertices;
  std::size_t first_triangle, triangles;
  PartContact contact = PartContact::ends;
  /// The last of its triangles: flat faces in which a part was cut from it, or it from the other. Artificial, but surface as any other.
  std::size_t cut_triangles = 0;
};

/// A flat face that closes a bone where its image ends: the plane normal . p = offset, the normal unit and outwards.
struct ImageCut {
  Vec3 normal = Vec3::UnitX();
  double offset_mm = 0;
};

enum class JointNoteCode : std::uint8_t;  // joint_checks.hpp
struct JointNote {
  JointNoteCode code;
  std::string text;  ///< one sentence
};

/// The image that the surface of a bone was extracted from, in the frame of the bone's mesh.
struct BodyImage {
  Eigen::Matrix3d voxel = Eigen::Matrix3d::Zero();  ///< columns: the edges of a voxel, mm
  std::vector<ImageCut> cuts = {};
  /// What the surface leaves out of the image, or the image makes doubtful: check_joint() repeats it.
  std::vector<JointNote> notes = {};

  /// Width of a voxel along a unit direction, mm.
  [[nodiscard]] double voxel_width_mm(const Vec3& direction) const noexcept {
    return (voxel.transpose() * direction).norm();
  }
};

/// One bone (or cartilage) of a joint, by the name its user gave it.
struct Body {
  std::string name;
  Mesh mesh;                            ///< of all parts together
  std::vector<BodyPart> parts = {};     ///< in their order, covering the mesh; empty if it is one mesh
  std::optional<BodyImage> image = {};  ///< of a surface from a label map
  /// The sphere that slides on it, in the body's frame, mm, where it is known, as that of a bone that was cut: of the mobile body its head, of
  /// the fixed one its socket. Else it is searched for.
  std::optional<Sphere> head = {};
  /// How far the bearing surface reaches outside a known head of the mobile body. Default: BearingOptions::margin_mm.
  std::optional<double> bearing_margin_mm = {};
};

/// How far from a cut a point still lies on it: meshes in floats are off by less.
inline constexpr double on_cut_mm = 0.01;

/// Whether a point of the body's surface, in its frame, lies on a face that closes it where its image ends.
[[nodiscard]] bool is_on_cut(const Body& body, const Vec3& point) noexcept;
[[nodiscard]] bool is_on_cut(const std::vector<ImageCut>& cuts, const Vec3& point) noexcept;

/// Area of the triangles that lie in the body's cuts, mm^2. Linear in the mesh.
[[nodiscard]] double cut_area_mm2(const Body& body);

/// The mesh of the part of this name. Throws UsageError with the names there are. Linear in the part.
[[nodiscard]] Mesh mesh_of_part(const Body& body, std::string_view part);

/// Whether a mesh of this body has that word.
[[nodiscard]] bool has_part(const Body& body, PartContact contact) noexcept;

/// Whether a part was cut from a mesh of this body, and whether a triangle is of a face in which one was.
[[nodiscard]] bool is_cut(const Body& body) noexcept;
[[nodiscard]] bool is_cut_face(const Body& body, std::size_t triangle) noexcept;

/// The part that a vertex or a triangle of the body's mesh is of; null if the body is one mesh.
[[nodiscard]] const BodyPart* part_of_vertex(const Body& body, std::size_t vertex) noexcept;
[[nodiscard]] const BodyPart* part_of_triangle(const Body& body, std::size_t triangle) noexcept;

/// Murray's three pairs of angles of the axis of a cup (1993).
enum class CupDefinition : std::uint8_t {
  radiographic,  ///< inclination in the frontal plane; anteversion from that plane
  anatomic,      ///< inclination from the vertical; anteversion in the transverse plane
  operative,     ///< inclination from the sagittal plane; anteversion in that plane
};
inline constexpr CupDefinition all_cup_definitions[] = {CupDefinition::radiographic, CupDefinition::anatomic,
                                                        CupDefinition::operative};

/// As in files: "radiographic".
[[nodiscard]] std::string_view name_of(CupDefinition definition) noexcept;
/// Throws UsageError that lists the valid words.
[[nodiscard]] CupDefinition cup_definition_named(std::string_view word);

/// How a parameter moves its part, from its value v and the value v0 at which the meshes stand as they are given. With s = 1 of a
/// right joint and -1 of a left one, about axes of the body's frame:
///
///     frontal       R_x(s (v - v0))     of a socket: more of it lies laterally
///     inclination   R_x(-s (v - v0))    the same turned the other way: as a cup's inclination grows
///     sagittal      R_z(v - v0)         top backwards
///     tilt          R_z(-(v - v0))      top forwards, as an anterior tilt of the pelvis
///     version       R_y(s (v - v0))     of the fixed body: its socket opens more to the front
///                   R_y(-s (v - v0))    of the mobile body: its neck points more to the front
///     translation   v - v0 along a direction
///     size          v / v0, a factor of all lengths from the centre
///
/// and two kinds that a part has together, of a cup that is fixed: the angles of its opening's axis by a CupDefinition, from those at which
/// its meshes stand as they are given, R(v) R(v0)^T with R(i, a) of inclination i and anteversion a
///
///     radiographic  R_x(-s i) R_z(a)      anatomic  R_y(s a) R_x(-s i)      operative  R_z(a) R_x(-s i)
enum class ParameterKind : std::uint8_t {
  frontal,
  inclination,
  sagittal,
  tilt,
  version,
  translation,
  size,
  cup_inclination,
  cup_anteversion,
};
inline constexpr ParameterKind all_parameter_kinds[] = {
    ParameterKind::frontal, ParameterKind::inclination,     ParameterKind::sagittal,
    ParameterKind::tilt,    ParameterKind::version,         ParameterKind::translation,
    ParameterKind::size,    ParameterKind::cup_inclination, ParameterKind::cup_anteversion};

/// As in files: "inclination".
[[nodiscard]] std::string_view name_of(ParameterKind kind) noexcept;
/// "deg", "mm", or "1" of a size, whose values have the unit of `as_given`.
[[nodiscard]] std::string_view unit_of(ParameterKind kind) noexcept;

/// A number by which a part is moved. Rotations are in degrees, translations in mm.
struct PartParameter {
  std::string name;
  ParameterKind kind = ParameterKind::frontal;
  double low = 0, high = 0;       ///< the values that it may have
  double value = 0;               ///< the value that it has
  double described = 0;           ///< the value that the description of the joint, such as its file, gives it
  double as_given = 0;            ///< at which the meshes stand as they are given
  double sigma = 0;               ///< standard deviation, for bands
  Vec3 direction = Vec3::Zero();  ///< of a translation: unit vector in the body's frame
};

/// A plane that a part is cut from a mesh by: the part lies on the side that the unit normal points away from.
struct CutPlane {
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitX();
};

/// Meshes of one body that move together against the rest of it, or a whole body that moves against its frame:
///
///     p' = c + t + R_x R_z R_y S (p - c)
///
/// turns them by version first, then in the sagittal, then in the frontal plane. docs/parts.md.
struct PosedPart {
  std::string name;
  BodyRole body = BodyRole::fixed;
  std::vector<std::string> meshes = {};  ///< names of its BodyParts; empty: the whole body
  Vec3 centre = Vec3::Zero();            ///< c, in the body's frame, mm
  /// Definition of the angles of a part with ParameterKind::cup_inclination and cup_anteversion.
  CupDefinition definition = CupDefinition::radiographic;
  std::vector<PartParameter> parameters = {};
  /// Planes behind all of which it was cut from the mesh of this name, in the body's frame as it is given, mm. The first of its meshes is what was
  /// cut off, with the part's own name.
  std::vector<CutPlane> cut = {};
  std::string cut_from = {};
};

/// A body before its parts are moved.
struct UnposedBody {
  Mesh mesh = Mesh(TriMesh{});
  std::optional<BodyImage> image = {};
  std::optional<Sphere> head = {};
};

/// The parts of a joint, and the bodies that they move.
struct PosedParts {
  std::vector<PosedPart> parts;
  UnposedBody fixed, mobile;
};

/// Two bodies of revolution whose axes go through the joint centre: contact depends on the angle between the axes only.
struct RevolvedPair {
  Vec3 fixed_axis, mobile_axis;  ///< out of the liner's opening, and along the neck; unit, at zero angles
  Angle half_angle;              ///< contact where the axes are farther apart
  /// Between these is the half-angle of meshes with the implant's facets: chords of the rim stand into the opening, chords
  /// of the neck lie within it.
  Angle of_facets_low, of_facets_high;
};

/// An implant in a joint, described by its sizes: which meshes are its liner and its neck, and their axes.
struct JointImplant {
  std::string fixed_mesh, mobile_mesh;  ///< names of BodyParts; empty of a body that is one mesh
  std::optional<Vec3> cup_axis = {};    ///< of a total hip: out of the opening, unit, of the meshes as given
  std::optional<RevolvedPair> pair = {};  ///< of the meshes as given
  std::string why_no_pair = {};           ///< what is no body of revolution
};

/// Whether a mesh of an implant has this name as a part of a body.
[[nodiscard]] constexpr bool is_implant_mesh(std::string_view name) noexcept {
  return name == "liner" || name == "head" || name == "neck" || name == "stem" || name == "pillar";
}

/// What the zero of a joint's angles is known by.
enum class ZeroFrom : std::uint8_t {
  as_given,  ///< It is the pose in which the mobile mesh is given, as that of a scan: nothing says how the body lay.
  stated,     ///< A reference pose was stated, zero or not.
  landmarks,  ///< Landmarks of both bodies give it.
  anatomy,    ///< The mobile body's anatomy does: of a hip the condyles of its femur.
};

enum class Sex : std::uint8_t { female, male };
inline constexpr Sex all_sexes[] = {Sex::female, Sex::male};
/// As in files: "female".
[[nodiscard]] constexpr std::string_view name_of(Sex sex) noexcept {
  return sex == Sex::female ? "female" : "male";
}

[[nodiscard]] constexpr bool is_age(double years) noexcept {
  return years >= 0 && years <= 120;
}

/// Whose joint it is, as far as that is known: limits stand beside those of people of this age and sex.
struct Person {
  std::optional<double> age_years = {};  ///< is_age()
  std::optional<Sex> sex = {};
  /// "cat", "Australopithecus afarensis". Of another than human nothing is held against human sizes and ranges.
  std::string species = {};

  /// Whether it is "human", "Homo sapiens" or not given; capitals do not count.
  [[nodiscard]] bool is_human() const;
};

// Ligaments as strings: docs/ligaments.md, docs/mathematics/14-ligaments.md.

enum class WrapShape : std::uint8_t {
  sphere,
  cylinder,  ///< without ends
  ellipsoid,  ///< Geodesics on it are not computed: where the straight line meets it, the ligament's length is not known.
};
/// As in files: "sphere".
[[nodiscard]] std::string_view name_of(WrapShape shape) noexcept;

/// A surface that a ligament lies on where the straight line would go through it.
struct LigamentWrap {
  WrapShape shape = WrapShape::sphere;
  BodyRole body = BodyRole::mobile;  ///< that it is fixed to
  Vec3 centre = Vec3::Zero();        ///< in that body's frame, mm; of a cylinder any point of its axis
  Vec3 axis = Vec3::UnitZ();         ///< of a cylinder, unit
  double radius_mm = 0;              ///< of a sphere or a cylinder
  /// An ellipsoid has its unit axes as columns, in the body's frame, and half its size along each.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Vec3 radii_mm = Vec3::Zero();
};

/// A string of no mass and no width from one body to the other, along the shortest path that its points and its wrap leave it:
///
///     fixed.front() --- fixed.back() ~ ~ ~ mobile.back() --- mobile.front()
///       insertion        crosses from one body to the other      insertion
///
/// Only the part between the two last points changes its length with the pose, and only that part wraps.
struct Ligament {
  std::string name = {};
  std::vector<Vec3> fixed = {},
                    mobile = {};  ///< one or more of each, from the insertion on, in the body's frame, mm
  std::optional<LigamentWrap> wrap = {};
  double slack_length_mm = 0;  ///< above 0: longer it is taut
  double stiffness_n =
      0;  ///< k, the slope of tension over strain once all fibres carry; 0: it has no tension
  double transition_strain = 0.06;  ///< above which they do, 0 or more
  double damping_n_s = 0;           ///< force over the rate of strain, 0 or more: damping_n()
  double slack_sigma_mm = 0;        ///< standard deviation of the slack length, for bands
  double point_sigma_mm = 0;        ///< and of each of its points along each axis of their bodies
  /// Above 0: a motion ends where the strain reaches this.
  std::optional<double> ends_at_strain = {};
};

/// The tension at a strain e, after Blankevoort et al. 1991, and the work that stretched it so far: with the transition strain c
///
///     0  for e <= 0,   k e^2 / (2 c)  up to c,   k (e - c / 2)  beyond.
[[nodiscard]] double tension_n(const Ligament& ligament, double strain) noexcept;
[[nodiscard]] double energy_nmm(const Ligament& ligament, double strain) noexcept;

/// A ligament in a pose.
struct LigamentState {
  double length_mm = 0;
  double strain = 0;  ///< (length - slack length) / slack length, negative while it is slack
  double tension_n = 0, energy_nmm = 0;
  bool wraps = false;
  /// On the mobile body, in the fixed body's frame; the moment about that frame's origin. The fixed body has the opposite.
  Vec3 force_n = Vec3::Zero(), moment_nmm = Vec3::Zero();
};
/// Closed form; the path has the length of the shortest one. Empty where its length is not known: an end of the part that crosses the joint lies
/// inside its wrap, or the straight line meets an ellipsoid. No allocation.
[[nodiscard]] std::optional<LigamentState> ligament_state(const Ligament& ligament,
                                                          const Pose& X_FM) noexcept;

/// Minus the derivative of its wrench on the mobile body, N and N mm, about the origin of M: columns are a translation (mm) and a rotation (rad)
/// in F, which carry that origin along, as of contact::ContactForces::stiffness. By differences, to some seven digits; where the slope of
/// the tension jumps, their mean. Empty where its length is not known there or a ten-thousandth of a mm beside.
[[nodiscard]] std::optional<Eigen::Matrix<double, 6, 6>> ligament_stiffness(const Ligament& ligament,
                                                                            const Pose& X_FM) noexcept;

/// How fast it becomes longer while the mobile body moves so. Closed form: its path is the shortest, so that moving the place where it leaves a wrap
/// changes no length. Empty as ligament_state(). No allocation.
[[nodiscard]] std::optional<double> lengthening_mm_s(const Ligament& ligament, const Pose& X_FM,
                                                     const RelativeMotion& motion) noexcept;

/// The force that damping adds to the tension, as OpenSim's Blankevoort1991Ligament has it: damping_n_s times the rate of strain, only while it is
/// taut and becomes longer, and for strains e below 0.01 less, by the smooth step 10 x^3 - 15 x^4 + 6 x^5 of x = e / 0.01.
[[nodiscard]] double damping_n(const Ligament& ligament, double strain, double strain_rate_per_s) noexcept;

/// Whether any of them has damping.
[[nodiscard]] bool has_damping(const std::vector<Ligament>& ligaments) noexcept;

/// What a ligament that moves has beside its state.
struct LigamentDamping {
  double lengthening_mm_s = 0, damping_n = 0;
  double total_n = 0;  ///< tension and damping
};

/// A ligament in every frame; empty for gaps, and where its length is not known.
struct LigamentAlong {
  std::string name;
  double slack_length_mm = 0;
  std::vector<std::optional<LigamentState>> frames = {};
  /// With motions: empty too where a frame has none. Else no entries.
  std::vector<std::optional<LigamentDamping>> damping = {};
};
/// `motions` are one per pose, or none.
[[nodiscard]] std::vector<LigamentAlong> ligaments_along(
    const std::vector<Ligament>& ligaments, const std::vector<std::optional<Pose>>& X_FM,
    const std::vector<std::optional<RelativeMotion>>& motions = {});

/// How the mobile body moves in each frame, from the poses at these times alone: by the parabola through a frame and those before and after it, at the
/// ends of a run of frames without a gap that through three of its frames; of two frames by the line through them. Of a rotation these are of rotation
/// vectors from the frame, so that a steady turn is exact. Empty for gaps and for a frame by itself.
///
/// One time per pose, which increase.
[[nodiscard]] std::vector<std::optional<RelativeMotion>> motions_along(
    const std::vector<std::optional<Pose>>& X_FM, const std::vector<double>& time_s);

/// Two bodies and how one rotates in the other. Both meshes are in the joint frame of joint_coordinates.hpp:
/// millimetres, origin at the joint centre, X anterior, Y superior, Z to the subject's right. The mobile mesh
/// is the one of zero angles: pose_at(coordinates(), angles) brings it to any other.
struct Joint {
  std::string name;
  JointKind kind;
  Side side;
  Body fixed;
  Body mobile;
  Anatomy anatomy = Anatomy::hip;  ///< of a hinge: the hip stands for any joint that flexes forwards
  TranslationFrame translation_frame = TranslationFrame::fixed;  ///< of a free joint
  std::optional<PosedParts> posed = {};  ///< parts with a pose of their own; the bodies above have them moved
  std::optional<JointImplant> implant = {};
  ZeroFrom zero_from = ZeroFrom::as_given;
  /// What a plan did to the bones: "without 164.1 mm3 of femur". Empty: they are as they were measured.
  std::string planned = {};
  Person person = {};
  std::vector<Ligament> ligaments = {};
  LengthUnit units = LengthUnit::millimetres;  ///< in which the meshes were given; here they are mm

  [[nodiscard]] CoordinateSystem coordinates() const noexcept { return {anatomy, side}; }
  /// False of a hinge that flexes forwards and is no joint in particular.
  [[nodiscard]] bool names_its_joint() const noexcept {
    return anatomy != Anatomy::hip || kind != JointKind::hinge;
  }
  /// Whether a head slides in a socket: only there bearing contact is distinguished from impingement.
  [[nodiscard]] bool has_head() const noexcept {
    return kind != JointKind::hinge && (anatomy == Anatomy::hip || anatomy == Anatomy::shoulder);
  }
  /// Whether its socket is a hip's, for everything inferred from that: clock faces, normal ranges, the checks of its axes.
  [[nodiscard]] bool is_hip() const noexcept { return anatomy == Anatomy::hip && names_its_joint(); }
};

/// A value of a parameter, by the names of its part and of itself: "cup.inclination".
struct ParameterValue {
  std::string name;
  double value = 0;
};

/// Values from "cup.inclination=42 cup.version=15", separated by blanks or commas. Throws UsageError for other text.
[[nodiscard]] std::vector<ParameterValue> parse_parameters(std::string_view text);

/// The joint at these values; parameters that are not named keep theirs. Coordinates of a part that is moved are rounded once more; where
/// all its parameters are as given, they keep every bit. Throws UsageError for a name that there is not, with the names there are, a
/// value outside of its range, and one that is given twice. Linear in the meshes.
[[nodiscard]] Joint with_parameters(const Joint& joint, std::span<const ParameterValue> values);

/// "cup.inclination 42 deg instead of 40": the parameters whose values differ from those of the description; empty if none does.
[[nodiscard]] std::string changed_parameters(const Joint& joint);

/// Whether a parameter has a standard deviation.
[[nodiscard]] bool has_uncertain_parameters(const Joint& joint) noexcept;

/// A joint whose mobile body keeps this translation, of the fixed body's axes in mm: the same joint seen from where the
/// mobile body's origin is. With R_FM p_M + t = p_F and t held, p_F - t = R_FM p_M is a rotation about the origin, and all that
/// turns a ball about its centre turns this joint exactly. Vertices of the fixed body are moved by -t, rounded once; points
/// of answers in its frame are t short of those of the joint given.
///
/// Linear in the fixed mesh; with t = 0 the joint as it is.
[[nodiscard]] Joint held_at(const Joint& joint, const Vec3& translation_mm);

}  // namespace condyle
