#include "motion/rom/overlap.hpp"

#include <algorithm>
#include <cmath>

#include "condyle/contact.hpp"
#include "condyle/error.hpp"
#include "core/formatted.hpp"

namespace condyle::motion {
namespace {

/// One entry per triangle; bytes, because threads never share them and vector<bool> is slow to scan.
using Marks = std::vector<unsigned char>;

/// Empty if no triangle is wanted.
std::optional<PartOfMesh> part_of(const Mesh& mesh, const Marks& wanted) {
  const TriMesh& whole = mesh;
  TriMesh part{whole.vertices, {}};
  std::vector<Index> triangle_in_whole;
  part.triangles.reserve(whole.triangles.size()), triangle_in_whole.reserve(whole.triangles.size());
  for (Index t = 0; t < whole.triangles.size(); ++t) {
    if (!wanted[t]) continue;
    part.triangles.push_back(whole.triangles[t]);
    triangle_in_whole.push_back(t);
  }
  if (part.triangles.size() == whole.triangles.size()) return PartOfMesh{mesh, std::move(triangle_in_whole)};
  if (part.triangles.empty()) return std::nullopt;
  return PartOfMesh{std::move(part), std::move(triangle_in_whole)};
}

PartOfMesh included_part(const Body& body, const Marks& wanted) {
  if (auto part = part_of(body.mesh, wanted)) return std::move(*part);
  throw MeshError(body.name + ": every triangle is left out: nothing remains that could meet the other body");
}

std::size_t left_out_by(const Marks& wanted) {
  return static_cast<std::size_t>(std::count(wanted.begin(), wanted.end(), 0));
}

void unmark_neighbours(const TriMesh& mesh, int rings, Marks& marks) {
  Marks vertex_marks(mesh.vertices.size());
  for (int ring = 0; ring < rings; ++ring) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      if (!marks[t])
        for (const Index v : mesh.triangles[t]) vertex_marks[v] = 1;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (const Index v : mesh.triangles[t])
        if (vertex_marks[v]) marks[t] = 0;
  }
}

std::string number(double value) {
  return core::formatted("%.3g", value);
}

/// Where one body's vertices are deepest in the other.
std::string deepest(const Body& body, const Body& other, const RadialBodySummary& summary) {
  const Vec3 p = body.mesh.vertices()[summary.deepest->vertex];
  return body.name + " vertex " + std::to_string(summary.deepest->vertex) + " at (" + number(p.x()) + ", " +
         number(p.y()) + ", " + number(p.z()) + ") mm is " + number(summary.deepest->depth_mm) +
         " mm inside " + other.name + " along its ray, " + number(summary.deepest->shortest_exit_mm) +
         " mm from its surface";
}

}  // namespace

PartsOfJoint parts_that_count(const Joint& joint, const OverlapOptions& options,
                              const std::optional<BearingSurface>& bearing, BearingRule rule) {
  const Mesh &fixed = joint.fixed.mesh, &mobile = joint.mobile.mesh;
  Marks of_fixed(fixed.triangles().size(), 1), of_mobile(mobile.triangles().size(), 1);
  if (options.leave_out_reference_contacts) {
    const int rings = options.leave_out_reference_contacts->rings;
    if (rings < 0) throw UsageError("contacts in the reference pose to leave out: rings must not be below 0");
    const auto pairs =
        JointContact(fixed, mobile).pairs(pose_at(joint.coordinates(), options.reference_pose));
    for (const TrianglePair& pair : pairs) of_fixed[pair.fixed] = of_mobile[pair.mobile] = 0;
    unmark_neighbours(fixed, rings, of_fixed);
    unmark_neighbours(mobile, rings, of_mobile);
  }
  const LeftOut left_out{left_out_by(of_fixed), left_out_by(of_mobile)};
  std::optional<PartOfMesh> of_bearing;
  if (bearing && rule == BearingRule::leave_out) {
    Marks slides(of_mobile.size());
    for (std::size_t t = 0; t < slides.size(); ++t) {
      slides[t] = of_mobile[t] && bearing->triangles[t];
      of_mobile[t] = of_mobile[t] && !bearing->triangles[t];
    }
    of_bearing = part_of(mobile, slides);
  }
  return {included_part(joint.fixed, of_fixed), included_part(joint.mobile, of_mobile), std::move(of_bearing),
          left_out};
}

std::string explain_overlap(const Joint& joint, const JointAngles& at) {
  const JointContact bodies(joint.fixed.mesh, joint.mobile.mesh);
  const Pose X_FM = pose_at(joint.coordinates(), at);
  const RadialContact contact = bodies.radial(X_FM);
  const RadialSummary summary = summarise(bodies, X_FM, contact);
  std::string text = joint.mobile.name + " and " + joint.fixed.name +
                     " are in contact in the reference pose: " + std::to_string(contact.pairs.size()) +
                     " pairs of triangles meet";
  const RadialBodySummary mobile = summary.mobile.value_or(RadialBodySummary{});
  const RadialBodySummary fixed = summary.fixed.value_or(RadialBodySummary{});
  const double mobile_depth = mobile.deepest ? mobile.deepest->depth_mm : 0;
  const double fixed_depth = fixed.deepest ? fixed.deepest->depth_mm : 0;
  if (mobile.deepest && mobile_depth >= fixed_depth) {
    text += "; " + deepest(joint.mobile, joint.fixed, mobile);
  } else if (fixed.deepest) {
    text += "; " + deepest(joint.fixed, joint.mobile, fixed);
  } else if (!contact.pairs.empty()) {
    const Vec3 p = joint.fixed.mesh.corner(contact.pairs.front().fixed, 0);
    const bool has_depths = contact.mobile_in_fixed && contact.fixed_in_mobile;
    text += (has_depths ? "; no vertex is inside, first at " : "; an open mesh has no depth, first at ") +
            joint.fixed.name + " triangle " + std::to_string(contact.pairs.front().fixed) + " at (" +
            number(p.x()) + ", " + number(p.y()) + ", " + number(p.z()) + ") mm";
  }
  return text +
         ". Allow a radial depth, leave out the contacts in the reference pose, state another reference "
         "pose, or accept "
         "contact at the start";
}

}  // namespace condyle::motion
