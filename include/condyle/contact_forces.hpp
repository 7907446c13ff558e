#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "condyle/joint.hpp"
#include "condyle/pose.hpp"

/// Forces of an elastic contact (condyle/pressure.hpp) as a simulator integrates them: wrench, stiffness, forces on vertices,
/// patches; with friction, damping and a ramp. docs/forces.md.
///
///     const ElasticContact knee(femur, tibia, {.mobile = cartilage});
///     const ContactRamp ramp(knee, X_FM, 0.05);
///     ContactForces forces;  // kept from step to step, so that its memory is
///     for (double t = 0; t < 1; t += dt) {
///       knee.forces(X_FM, {.motion = {v, w}, .friction = 0.01, .factor = ramp.factor_at(t), .stiffness = true}, forces);
///       step(forces.on_mobile_body, forces.stiffness);
///     }

namespace condyle::contact {

class ElasticContact;

/// Force and moment about a point, N and N mm.
struct Wrench {
  Vec3 force_n = Vec3::Zero(), moment_nmm = Vec3::Zero();
};

/// Of the mobile body relative to the fixed one, in F.
struct RelativeMotion {
  Vec3 velocity_mm_s = Vec3::Zero();  ///< of the origin of M
  Vec3 angular_velocity_rad_s = Vec3::Zero();
};

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

  std::span<const Index> faces_of(const ForcePatch& patch) const noexcept {
    return {patch_faces.data() + patch.first_face, patch.faces};
  }
};

/// Brings a contact in smoothly that overlaps before the first step, as after loading meshes: from nothing to all of it.
class ContactRamp {
 public:
  /// UsageError if the duration is not above 0; MeshError as ElasticContact::at().
  ContactRamp(const ElasticContact& contact, const Pose& start, double duration_s);

  bool has_overlap() const noexcept { return max_depth_mm_ > 0; }
  double max_depth_mm() const noexcept { return max_depth_mm_; }  ///< at the start
  double energy_nmm() const noexcept { return energy_nmm_; }      ///< at the start
  double duration_s() const noexcept { return duration_s_; }
  /// 3 s^2 - 2 s^3 at the share s of the duration: 0 before it, 1 after it, and its rate is 0 at both ends. 1 throughout if
  /// nothing overlaps at the start.
  double factor_at(double time_s) const noexcept;

 private:
  double duration_s_, max_depth_mm_ = 0, energy_nmm_ = 0;
};

}  // namespace condyle::contact
