#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "condyle/contact.hpp"
#include "condyle/joint.hpp"
#include "condyle/make_joint.hpp"
#include "condyle/normal_depth.hpp"

/// Contact pressure of thin layers on rigid bones: the elastic foundation (Blankevoort et al., J Biomech 24, 1991).
/// docs/mathematics/07-contact-pressure.md. A layer of thickness h, modulus E and Poisson's ratio nu that cannot spread sideways
/// answers an overlap d by the pressure
///
///     linear        p = M d / h                  M = (1 - nu) E / ((1 + nu)(1 - 2 nu))
///     logarithmic   p = -M ln(1 - d / h)
///
/// each place for itself: no shear and no lateral spread, so peaks run above those of finite elements.
///
///     const ElasticLayer cartilage{.youngs_modulus_mpa = 10, .poisson_ratio = 0.45, .thickness_mm = 3.0};
///     const ElasticContact knee(femur, tibia, {.casting = Casting::mobile, .fixed = cartilage, .mobile = cartilage});
///     const double peak = knee.at(X_FM).mobile->totals.max_pressure_mpa;

namespace condyle::contact {

struct ElasticLayer {
  double youngs_modulus_mpa;  ///< > 0
  double poisson_ratio;       ///< > -1 and < 0.5
  /// One value for the whole layer, or one for each vertex of its mesh; > 0.
  std::variant<double, std::vector<double>> thickness_mm;
  /// Expected range of thicknesses, mm: check_layers() reports thicknesses beyond it. It changes no pressure.
  std::optional<std::array<double, 2>> thickness_bounds_mm = {};

  /// Modulus of a layer that cannot spread sideways, MPa.
  [[nodiscard]] double confined_modulus_mpa() const noexcept {
    return (1 - poisson_ratio) * youngs_modulus_mpa / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio));
  }
};

enum class PressureLaw { linear, logarithmic };

/// Which body's surface is cast. With `both` each is, and the load is the mean of the two: exchanging the bodies then
/// exchanges the signs of forces and nothing else.
enum class Casting { fixed, mobile, both };

struct ElasticContactOptions {
  Casting casting = Casting::both;
  NormalDepthOptions rays = {};
  PressureLaw law = PressureLaw::linear;
  /// At least one of the two; a body without one is rigid.
  std::optional<ElasticLayer> fixed = {}, mobile = {};
};

/// Force and moment about a point, N and N mm.
struct Wrench {
  Vec3 force_n = Vec3::Zero(), moment_nmm = Vec3::Zero();
};

/// Results at one pose.
struct ElasticContactResults {
  /// Results for the surfaces that were cast, each in its own body's frame; pressures and loads are filled in.
  std::optional<SurfaceContact> fixed, mobile;
  /// Wrench of the fixed body on the mobile one, in F, about the origin of M. With one casting, plus or minus its
  /// totals; with both, the mean.
  Wrench on_mobile;
  /// Stored in the layers, N mm.
  double energy_nmm = 0;
};

// Forces of an elastic contact as a simulator integrates them: wrench, stiffness, forces on vertices,
// patches; with friction, damping and a ramp. docs/contact.md.
//
//     const ElasticContact knee(femur, tibia, {.mobile = cartilage});
//     const ContactRamp ramp(knee, X_FM, 0.05);
//     ContactForces forces;  // kept from step to step, so that its memory is
//     for (double t = 0; t < 1; t += dt) {
//       knee.forces(X_FM, {.motion = {v, w}, .friction = 0.01, .factor = ramp.factor_at(t), .stiffness = true}, forces);
//       step(forces.on_mobile_body, forces.stiffness);
//     }

struct ForceOptions {
  RelativeMotion motion = {};
  /// Coefficient of friction mu, >= 0. The traction is mu p v / sqrt(v^2 + s^2) against the sliding velocity v, which is across the
  /// normal of the casting face, with the slip velocity s: Coulomb's friction, made smooth about v = 0. Nothing sticks.
  double friction = 0;
  double slip_velocity_mm_s = 1;  ///< > 0
  /// Hunt and Crossley's damping, >= 0: pressures are multiplied by max(0, 1 + damping * rate of depth).
  double damping_s_per_mm = 0;
  /// From 0 to 1: pressures, energy and stiffness are multiplied by it. ContactRamp gives one for each time.
  double factor = 1;

  // What is computed besides wrench, energy and power.
  bool vertex_forces = false;
  bool stiffness = false;
  bool vertex_stiffness = false;  ///< with it vertex_forces too
  bool patches = false;
};

/// UsageError, naming the option, if one is outside its domain or not finite.
void check_force_options(const ForceOptions& options);

struct VertexForce {
  Index vertex;
  Vec3 force_n;  ///< in the frame that the vertex is stored in
};

/// How the force on one vertex falls when another is moved, N / mm.
struct VertexStiffness {
  Index row, column;      ///< places in on_fixed, and after these in on_mobile
  Eigen::Matrix3d block;  ///< rows in the frame of the row's body, columns in that of the column's
};

/// Faces in contact that hang together by common vertices.
struct ForcePatch {
  BodyRole casting;                        ///< whose faces they are
  std::size_t first_face, faces;           ///< in ContactForces::patch_faces
  double area_mm2;                         ///< in contact
  double max_pressure_mpa;                 ///< elastic, times the factor: without damping
  double load_n;                           ///< integral of the pressure
  Wrench on_mobile_body;                   ///< what it adds to that of the contact
  Vec3 centre_of_pressure = Vec3::Zero();  ///< in F; that of the area if the load is 0
  Vec3 centre_of_area = Vec3::Zero();      ///< in F
};

struct ContactForces {
  /// On the mobile body, in F, about the origin of M. Without friction and damping, times the factor, that of
  /// ElasticContact::at().
  Wrench on_mobile_body;
  double energy_nmm = 0;  ///< stored in the layers
  /// Taken out of the motion by friction and by damping, N mm / s: >= 0.
  double friction_power = 0, damping_power = 0;
  /// The largest depth over the thickness of both layers at that place, whatever the factor. Above 1 no layer is compressed so far, and the
  /// forces are none: motion::check_contact() has a note.
  double max_strain = 0;
  /// The factor asked for: below 1 a ramp is in force, and nothing here is the answer of the layers themselves.
  double factor = 1;
  /// Minus the derivative of the wrench: rows are force and moment, columns a translation of the mobile body (mm) and a
  /// rotation (rad) about the origin of M, both in F, which carry the origin of M along. Of the elastic part: friction and
  /// damping are left out. Not symmetric.
  Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();
  /// Vertices with a share in the contact, ascending, each body's in its own frame. Forces of either body add up to the wrench,
  /// those of the fixed body to its reverse.
  std::vector<VertexForce> on_fixed, on_mobile;
  /// Ascending by row, then by column; what is not there is 0. Minus the derivative of the elastic vertex forces, with areas,
  /// normals, directions of rays, triangles met and shares of vertices held.
  std::vector<VertexStiffness> vertex_stiffness;
  /// Those of the fixed body's faces, then of the mobile one's, each by their first face; and their faces, ascending.
  std::vector<ForcePatch> patches;
  std::vector<Index> patch_faces;

  [[nodiscard]] std::span<const Index> faces_of(const ForcePatch& patch) const noexcept {
    return {patch_faces.data() + patch.first_face, patch.faces};
  }
};

/// Two surfaces with their layers, queried at any pose. Any number of threads may query.
class ElasticContact {
 public:
  /// UsageError if an option is outside its domain or thicknesses are not as many as vertices.
  ElasticContact(Mesh fixed, Mesh mobile, ElasticContactOptions options);
  ~ElasticContact();
  ElasticContact(ElasticContact&&) noexcept;
  ElasticContact& operator=(ElasticContact&&) noexcept;

  /// A body has deformed: new positions of all its vertices, or of some, each named once. Thicknesses stay with their vertices.
  /// Answers are those of an ElasticContact made anew, to the bit. UsageError if numbers of vertices differ, a number is no
  /// vertex's or is there twice; MeshError as Mesh::moved_to(). A refused update changes nothing. Not while another thread queries.
  /// After std::bad_alloc it may have ended halfway: queries and updates then raise UsageError, and the contact has to be made anew.
  void update(BodyRole body, PointsView vertices);
  void update(BodyRole body, std::span<const Index> moved, PointsView positions);

  /// MeshError with the logarithmic law if the overlap reaches the thickness, naming the triangle.
  [[nodiscard]] ElasticContactResults at(const Pose& X_FM) const;

  /// What a simulator integrates: forces, stiffness, friction, damping (ContactForces). UsageError if an option is
  /// outside its domain; MeshError as at(). The second keeps the memory of an earlier result.
  ///
  ///     const ContactForces now = knee.forces(X_FM, {.vertex_forces = true, .stiffness = true});
  [[nodiscard]] ContactForces forces(const Pose& X_FM, const ForceOptions& options = {}) const;
  void forces(const Pose& X_FM, const ForceOptions& options, ContactForces& out) const;

  /// The force on the mobile body, in F, with the depth evaluated at 16 points of each face in contact: it shows the
  /// effect of mesh edges on `at(X_FM).on_mobile`, whose depths are linear from corner to corner. Sixteen times the
  /// rays. Empty with the rule face_centre, whose depths have no such effect, and if the logarithmic law has no
  /// answer at one of these points.
  [[nodiscard]] std::optional<Vec3> refined_force_n(const Pose& X_FM) const;

  /// Rays of this pose that a longer reach would find in contact: NormalDepth::cut_off_by_reach().
  [[nodiscard]] std::size_t cut_off_by_reach(const Pose& X_FM) const;

  [[nodiscard]] const Mesh& fixed() const noexcept;
  [[nodiscard]] const Mesh& mobile() const noexcept;
  [[nodiscard]] const ElasticContactOptions& options() const noexcept;

  /// Internal data of balance(); not for use outside the library.
  struct Parts;
  [[nodiscard]] const Parts& parts() const noexcept { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

/// Brings a contact in smoothly that overlaps before the first step, as after loading meshes: from nothing to all of it.
class ContactRamp {
 public:
  /// UsageError if the duration is not above 0; MeshError as ElasticContact::at().
  ContactRamp(const ElasticContact& contact, const Pose& start, double duration_s);

  [[nodiscard]] bool has_overlap() const noexcept { return max_depth_mm_ > 0; }
  [[nodiscard]] double max_depth_mm() const noexcept { return max_depth_mm_; }  ///< at the start
  [[nodiscard]] double energy_nmm() const noexcept { return energy_nmm_; }      ///< at the start
  [[nodiscard]] double duration_s() const noexcept { return duration_s_; }
  /// 3 s^2 - 2 s^3 at the share s of the duration: 0 before it, 1 after it, and its rate is 0 at both ends. 1 throughout if
  /// nothing overlaps at the start.
  [[nodiscard]] double factor_at(double time_s) const noexcept;

 private:
  double duration_s_, max_depth_mm_ = 0, energy_nmm_ = 0;
};

// The position in which the contact carries a load: docs/mathematics/07-contact-pressure.md.
//
//     const Load stance{.on_mobile = {.force_n = {-150, 1900, 300}}};
//     const BalancedPose hip = balance(cartilages, X_FM, stance);
//     if (hip.outcome == BalanceOutcome::balanced) use(hip.X_FM, hip.contact);

/// The external loads on the mobile body.
struct Load {
  /// Force and moment about the origin of M. Moments count with free rotations only.
  Wrench on_mobile;
  /// The frame of both: held in F, or going along with M.
  BodyRole frame = BodyRole::fixed;
};

struct BalanceOptions {
  /// Directions in F that the mobile body may be translated in, of any length but zero and independent: all where empty. The
  /// load counts along them only.
  std::vector<Vec3> free_directions = {};
  /// Rotations about the origin of M are unknowns too, and moments are balanced.
  bool free_rotations = false;
  /// Largest residual of the force, N, and of the moment, N mm, in a balanced pose.
  double force_tolerance_n = 1e-6, moment_tolerance_nmm = 1e-4;
  /// How far the mobile body may go from where it starts.
  double farthest_mm = 20;
  int most_steps = 100;
  /// Largest residual, as a fraction of the load, 0 to 1, if no step reduces it: BalanceOutcome::at_jump.
  double most_left_at_jump = 0.02;
  /// Strings that pull beside the contact: then the load may be zero.
  std::vector<Ligament> ligaments = {};
};

/// Whether nothing of a load acts along what the balance leaves free: no pose is the one that carries it.
[[nodiscard]] bool is_zero_along(const Load& load, const Pose& X_FM, const BalanceOptions& options);

enum class BalanceOutcome {
  balanced,
  at_jump,  ///< all but a little of the load is carried, and the force jumps just beyond, or no step was found that leaves less
  pulled_apart,  ///< along the load the bodies do not meet, or they part
  over_the_rim,  ///< in contact, and nowhere near was a pose found in which the contact carries the load
  too_large,  ///< compressed by nine tenths of their thickness or more, the layers carry less than the load
  unstable,   ///< in balance, but pushed on if moved along some direction: contact by itself does not hold it
  free_direction,  ///< the contact holds the mobile body in no place along a direction: prescribe it
};

/// "balanced", "at_jump", "pulled_apart", "over_the_rim", "too_large", "unstable", "free_direction".
[[nodiscard]] std::string_view name_of(BalanceOutcome outcome) noexcept;

struct BalancedPose {
  BalanceOutcome outcome;
  /// The pose found; else the last one evaluated, or one where the bodies are apart if less of the load is left there, or, of loads
  /// that are too large, one that carries most.
  Pose X_FM;
  Wrench residual;  ///< what contact and load add up to along what is free, in F, about the origin of M
  int steps = 0;    ///< of Newton's method
  Vec3 direction = Vec3::Zero();  ///< the direction of outcomes that have one, of length 1, in F
  ElasticContactResults contact;  ///< at X_FM

  /// The contact carries the load at X_FM: balanced, unstable, or at a jump up to the residual. Else X_FM is only where the
  /// search ended.
  [[nodiscard]] bool carries_load() const noexcept;
};

/// One line that says why there is no balance, or what is wrong with it; empty if nothing is.
[[nodiscard]] std::string reason_of(const BalancedPose& pose);

/// From a start nearby, with its rotation held unless rotations are free: Newton's method on the load of the contact, of each
/// step as much as leaves less of the load and stores no more energy than the load gives. A start without contact is moved along the load to
/// where the contact carries that part of it. What is called balanced is stable: the contact pushes back whichever way the
/// body is moved. The contact's force jumps where a ray begins or ceases to meet the other surface, at a rim or a side wall: a
/// load of which little is left just before a jump, or of which no step leaves less, is taken to lie within it, and reported with
/// what is left. Of a refused load no more is left than was applied, unless the contact pushes along it as far as is searched.
///
/// UsageError if a share is not from 0 to 1, the load is zero or not finite along what is free, or directions depend on each other. Some ten times
/// the cost of a pose.
[[nodiscard]] BalancedPose balance(const ElasticContact& contact, const Pose& start, const Load& load,
                                   const BalanceOptions& options = {});

// Depths along normals of both bodies in one pose.

/// Results of the rays along the normals of one body's surface.
struct NormalCast {
  SurfaceContact surface;            ///< in the frame of the body that casts
  std::size_t cut_off_by_reach = 0;  ///< rays that a longer reach would find in contact
};

/// Results for each body that casts its depths; and whether the surfaces meet, which needs no normals.
struct NormalContact {
  std::vector<TrianglePair> pairs;  ///< ascending
  bool in_contact = false;          ///< as ContactResults has it
  std::optional<NormalCast> fixed, mobile;
};

/// Both meshes may be open. For one pose: rays are prepared at each call, and a NormalDepth keeps them for many.
/// UsageError if the reach is not above 0.
[[nodiscard]] NormalContact normal_contact(const JointContact& joint, const Pose& X_FM,
                                           Casting casting = Casting::both,
                                           const NormalDepthOptions& rays = {});

}  // namespace condyle::contact
