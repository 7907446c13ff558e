#include "kinematics/ligament_checks.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "condyle/joint_checks.hpp"
#include "core/formatted.hpp"
#include "kinematics/ligament_path.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/surface_distance.hpp"
#include "mesh/vertical_ray.hpp"

namespace condyle {
namespace kinematics {
namespace {

using core::formatted;

// Bounds and what sound ligaments keep: docs/decisions/0030-bounds-of-checks.md. mm.
constexpr double farthest_end_mm = 5, certain_end_mm = 2.5;
/// Points on the way to the other body, as round muscles and fat, off both.
constexpr double farthest_point_mm = 50;
constexpr double deepest_run_mm = 3;
constexpr double largest_slack_share = 1.5;

/// How far along a segment it enters a surface (+1) or leaves it (-1), in order. Its direction is made vertical, vertex by vertex, so that no triangle is
/// missed or crossed twice.
std::vector<std::pair<double, int>> crossings_of(const Mesh& mesh, const Vec3& from, const Vec3& to) {
  const double length = (to - from).norm();
  if (!(length > 0)) return {};
  const Vec3 z = (to - from) / length, x = z.unitOrthogonal(), y = z.cross(x);
  std::vector<Vec3> upright;
  for (std::size_t v = 0; v < mesh.vertices().size(); ++v) {
    const Vec3 p = mesh.vertices()[v] - from;
    upright.emplace_back(p.dot(x), p.dot(y), p.dot(z));
  }
  const int outwards = mesh.is_closed() && mesh::is_inside_out(mesh) ? -1 : 1;
  std::vector<std::pair<double, int>> crossings;
  for (const Triangle& t : mesh.triangles()) {
    const Vec3 &a = upright[t[0]], &b = upright[t[1]], &c = upright[t[2]];
    const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    if (low.head<2>().maxCoeff() > 0 || high.head<2>().minCoeff() < 0) continue;
    const int up = mesh::vertical_crossing({a, b, c}, Vec3::Zero());
    if (up == 0) continue;
    const Vec3 normal = (b - a).cross(c - a);
    if (const double at = normal.dot(a) / normal.z(); at >= 0 && at <= length)
      crossings.emplace_back(at, -outwards * up);
  }
  std::sort(crossings.begin(), crossings.end());
  return crossings;
}

double distance(const Mesh& mesh, const Vec3& point) {
  return mesh::distance_to_surface(*mesh::tree_of(mesh), point);
}

/// What of a segment lies in a mesh, by points a millimetre apart. An end lies as often inside as the surface is left without having been entered: open
/// meshes do as well.
RunThrough run_in(const Mesh& mesh, const Vec3& from, const Vec3& to) {
  const auto crossings = crossings_of(mesh, from, to);
  int so_far = 0, least = 0;
  for (const auto& [at, sense] : crossings) least = std::min(least, so_far += sense);
  RunThrough run;
  if (crossings.empty()) return run;
  const double length = (to - from).norm();
  const int points = static_cast<int>(std::ceil(std::min(length, 1000.0)));
  for (int i = 0; i < points; ++i) {
    const double share = (i + 0.5) / points;
    int inside = -least;
    for (const auto& [at, sense] : crossings) inside += at < share * length ? sense : 0;
    if (inside <= 0) continue;
    run.length_mm += length / points;
    run.depth_mm = std::max(run.depth_mm, distance(mesh, from + share * (to - from)));
  }
  return run;
}

/// Whether three of 48 vertices of a mesh lie deep inside another: segments away from its middle leave it there.
bool reaches_into(const Mesh& mesh, const Mesh& other, const Pose& X_other) {
  constexpr std::size_t asked = 48;
  const BoundingBox bounds = mesh::bounds_of_surface(other);
  int deep = 0;
  for (std::size_t k = 0; k < asked; ++k) {
    const Vec3 p = posed(X_other, mesh.vertices()[k * mesh.vertices().size() / asked]);
    const Vec3 away = (p - (bounds.low + bounds.high) / 2).normalized();
    int sum = 0;
    for (const auto& [at, sense] : crossings_of(other, p, p + bounds.diagonal() * away)) sum += sense;
    deep += sum < 0 && distance(other, p) > deepest_run_mm;
  }
  return deep > 2;
}

/// What is wrong with where the points of a ligament on one body lie; empty if nothing.
std::string off_bone(const Joint& joint, const Ligament& ligament, BodyRole role, const Pose& X_FM,
                     bool is_posed) {
  const bool is_fixed = role == BodyRole::fixed;
  const Body &own = is_fixed ? joint.fixed : joint.mobile, &other = is_fixed ? joint.mobile : joint.fixed;
  const Pose X_other = is_fixed ? inverted(X_FM) : X_FM;
  const char* whose = is_fixed ? "fixed" : "mobile";
  const std::vector<Vec3>& points = is_fixed ? ligament.fixed : ligament.mobile;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double off = distance(own.mesh, points[i]),
                 from_other = distance(other.mesh, posed(X_other, points[i]));
    const bool is_nearer = is_posed && from_other < off;
    if (i == 0 && (off > farthest_end_mm || (off > certain_end_mm && is_nearer)))
      return formatted("its %s end is %.3g mm from the surface of ", whose, off) + own.name +
             (is_nearer ? formatted(" and %.2g mm from that of ", from_other) + other.name : "");
    if (std::min(off, from_other) > farthest_point_mm)
      return formatted("point %zu of %s is %.3g mm from either body", i + 1, whose,
                       std::min(off, from_other));
  }
  return {};
}

std::string wrong_strain(const Ligament& ligament, const std::optional<LigamentState>& state) {
  const std::tuple<double, double, const char*> found[] = {
      {ligament.ends_at_strain.value_or(0), largest_strain,
       "it ends motions at a strain of %g: 10 %% is 0.1"},
      {ligament.stiffness_n > 0 ? ligament.transition_strain : 0, largest_strain,
       "its transition strain is %g: 10 %% is 0.1"},
      {ligament.slack_sigma_mm / ligament.slack_length_mm, largest_strain,
       "the deviation of its slack length is %.3g times that length"},
      {state ? ligament.slack_length_mm / state->length_mm : 0, largest_slack_share,
       "its slack length is %.4g times its length in the reference pose"},
      {state ? state->strain : 0, largest_strain,
       "its strain is %.4g in the reference pose: is its slack length in the unit of its points?"}};
  for (const auto& [value, largest, text] : found)
    if (value > largest) return formatted(text, value);
  return {};
}

/// One note for all ligaments that have a finding: it describes three and counts the others.
struct Found {
  JointNoteCode code;
  std::size_t count = 0;
  std::string text = {};

  void add(const Ligament& ligament, const std::string& what) {
    if (what.empty() || ++count > 3) return;
    text += (count == 1 ? "ligament " : "; ligament ") + ligament.name + ": " + what;
  }
};

/// All findings; those that hang on the pose only if it `is_posed`.
std::vector<JointNote> notes_at(const Joint& joint, const Pose& X_FM, bool is_posed) {
  Found off{JointNoteCode::ligament_off_bone}, through{JointNoteCode::ligament_through_bone},
      strains{JointNoteCode::unlikely_strain};
  for (const Ligament& ligament : joint.ligaments) {
    const std::string fixed = off_bone(joint, ligament, BodyRole::fixed, X_FM, is_posed);
    off.add(ligament, fixed.empty() ? off_bone(joint, ligament, BodyRole::mobile, X_FM, is_posed) : fixed);
    strains.add(ligament, wrong_strain(ligament, is_posed ? ligament_state(ligament, X_FM) : std::nullopt));
    if (const auto run = is_posed ? run_through(joint, ligament, X_FM) : std::nullopt)
      through.add(ligament, "its straight part " + text_of(*run, joint) + ", in the reference pose");
  }
  std::vector<JointNote> notes;
  for (const Found& each : {off, through, strains})
    if (each.count > 0)
      notes.push_back(
          {each.code, each.text + (each.count > 3 ? formatted("; and %zu others", each.count - 3) : "")});
  return notes;
}

}  // namespace

std::string text_of(const RunThrough& run, const Joint& joint) {
  return "runs through " + (run.body == BodyRole::fixed ? joint.fixed : joint.mobile).name +
         formatted(" for %.0f mm, up to %.0f mm deep", run.length_mm, run.depth_mm);
}

std::optional<RunThrough> run_through(const Joint& joint, const Ligament& ligament, const Pose& X_FM) {
  if (!ligament_state(ligament, X_FM)) return std::nullopt;
  const std::vector<Vec3> path = ligament_points(ligament, X_FM);
  RunThrough deepest;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (i >= ligament.fixed.size() && i + 1 < path.size() - ligament.mobile.size()) continue;  // on its wrap
    for (const BodyRole role : {BodyRole::fixed, BodyRole::mobile}) {
      const bool is_fixed = role == BodyRole::fixed;
      const Pose X = is_fixed ? Pose::Identity() : inverted(X_FM);
      RunThrough run =
          run_in((is_fixed ? joint.fixed : joint.mobile).mesh, posed(X, path[i]), posed(X, path[i + 1]));
      run.body = role;
      if (run.depth_mm > deepest.depth_mm) deepest = run;
    }
  }
  return deepest.depth_mm > deepest_run_mm ? std::optional(deepest) : std::nullopt;
}

}  // namespace kinematics

std::vector<JointNote> check_ligaments(const Joint& joint, const JointPlacement& placement) {
  const Mesh &fixed = joint.fixed.mesh, &mobile = joint.mobile.mesh;
  if (joint.ligaments.empty() || fixed.triangles().empty() || mobile.triangles().empty()) return {};
  const Pose X_FM = pose_at(joint.coordinates(), placement.reference_pose, joint.translation_frame);
  std::vector<JointNote> notes = kinematics::notes_at(joint, X_FM, true);
  if (!notes.empty() && (kinematics::reaches_into(mobile, fixed, X_FM) ||
                         kinematics::reaches_into(fixed, mobile, inverted(X_FM))))
    notes = kinematics::notes_at(joint, X_FM, false);
  return notes;
}

}  // namespace condyle
