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
std::string deepest(const Body& body, const Body& other, const contact::RadialBodySummary& summary) {
  const Vec3 p = body.mesh.vertices()[summary.deepest->vertex];
  return body.name + " vertex " + std::to_string(summary.deepest->vertex) + " at (" + number(p.x()) + ", " +
         number(p.y()) + ", " + number(p.z()) + ") mm is " + number(summary.deepest->depth_mm) +
         " mm inside " + other.name + " along its ray, " + number(summary.deepest->shortest_exit_mm) +
         " mm from its surface";
}

/// The roles of one body's triangles, and which of them are not left out.
struct RolesOfBody {
  const Body& body;
  const std::vector<ContactRole>& roles;
  Marks included;

  ContactRole role(std::size_t triangle) const noexcept {
    return roles.empty() ? ContactRole::ends : roles[triangle];
  }
  Marks where(const auto& wanted) const {
    Marks marks(included.size());
    for (std::size_t t = 0; t < marks.size(); ++t) marks[t] = included[t] && wanted(role(t));
    return marks;
  }
};

/// The parts of one body, each once.
class Parts {
 public:
  Parts(const RolesOfBody& body, std::vector<PartOfMesh>& parts) : body_(body), parts_(parts) {}

  /// The place of this part; empty if no triangle is in it.
  std::optional<std::size_t> place_of(const auto& wanted) {
    Marks marks = body_.where(wanted);
    const auto known = std::find(marks_.begin(), marks_.end(), marks);
    if (known != marks_.end()) return known - marks_.begin();
    std::optional<PartOfMesh> part = part_of(body_.body.mesh, marks);
    if (!part) return std::nullopt;
    parts_.push_back(std::move(*part));
    marks_.push_back(std::move(marks));
    return parts_.size() - 1;
  }

 private:
  const RolesOfBody& body_;
  std::vector<PartOfMesh>& parts_;
  std::vector<Marks> marks_;
};

Marks included_triangles(const Mesh& mesh) {
  return Marks(mesh.triangles().size(), 1);
}

[[noreturn]] void fail_without(const RolesOfBody& body) {
  const bool any = std::find(body.included.begin(), body.included.end(), 1) != body.included.end();
  throw MeshError(body.body.name +
                  (any ? ": no contact of its meshes ends a motion"
                       : ": every triangle is left out: nothing remains that could meet the other body"));
}

void leave_out_contacts(const Joint& joint, const OverlapOptions& options, const BearingFinding& bearing,
                        Marks& of_fixed, Marks& of_mobile) {
  const int rings = options.leave_out_reference_contacts->rings;
  if (rings < 0) throw UsageError("contacts in the reference pose to leave out: rings must not be below 0");
  const Mesh &fixed = joint.fixed.mesh, &mobile = joint.mobile.mesh;
  const auto pairs =
      contact::JointContact(fixed, mobile).pairs(pose_at(joint.coordinates(), options.reference_pose));
  for (const contact::TrianglePair& pair : pairs)
    // Soft meshes end no motion: the bone under them stays.
    if (bearing.kind_of(pair.fixed, pair.mobile) != ContactKind::soft)
      of_fixed[pair.fixed] = of_mobile[pair.mobile] = 0;
  unmark_neighbours(fixed, rings, of_fixed);
  unmark_neighbours(mobile, rings, of_mobile);
}

}  // namespace

PartsOfJoint parts_that_count(const Joint& joint, const OverlapOptions& options,
                              const BearingFinding& bearing, BearingRule rule) {
  RolesOfBody of_fixed{joint.fixed, bearing.roles.fixed, included_triangles(joint.fixed.mesh)},
      of_mobile{joint.mobile, bearing.roles.mobile, included_triangles(joint.mobile.mesh)};
  if (options.leave_out_reference_contacts)
    leave_out_contacts(joint, options, bearing, of_fixed.included, of_mobile.included);
  PartsOfJoint parts;
  parts.left_out = {left_out_by(of_fixed.included), left_out_by(of_mobile.included)};
  Parts fixed(of_fixed, parts.fixed), mobile(of_mobile, parts.mobile);
  const auto pair = [&](const auto& fixed_roles, const auto& mobile_roles, ContactKind kind,
                        std::vector<PairOfParts>& pairs) {
    const auto f = fixed.place_of(fixed_roles), m = mobile.place_of(mobile_roles);
    if (f && m) pairs.push_back({*f, *m, kind});
  };
  const auto any = [](ContactRole) { return true; };
  const auto hard = [](ContactRole role) { return role != ContactRole::soft; };
  const auto is = [](ContactRole wanted) { return [wanted](ContactRole role) { return role == wanted; }; };
  if (rule == BearingRule::count) {
    pair(hard, hard, ContactKind::unknown, parts.impinging);
  } else {
    constexpr ContactKind ends = ContactKind::impingement, slides = ContactKind::bearing;
    const auto on_bearing = is(ContactRole::bearing_on_bearing);
    pair(hard, is(ContactRole::ends), ends, parts.impinging);
    pair(is(ContactRole::ends), on_bearing, ends, parts.impinging);
    pair(hard, is(ContactRole::bearing), slides, parts.earlier);
    pair(is(ContactRole::bearing), on_bearing, slides, parts.earlier);
  }
  if (parts.impinging.empty()) fail_without(fixed.place_of(hard) ? of_mobile : of_fixed);
  pair(is(ContactRole::soft), any, ContactKind::soft, parts.earlier);
  pair(hard, is(ContactRole::soft), ContactKind::soft, parts.earlier);
  return parts;
}

std::string explain_overlap(const Joint& joint, const JointAngles& at) {
  const contact::JointContact bodies(joint.fixed.mesh, joint.mobile.mesh);
  const Pose X_FM = pose_at(joint.coordinates(), at);
  const contact::RadialContact contact = bodies.radial(X_FM);
  const contact::RadialSummary summary = contact::summarise(bodies, X_FM, contact);
  std::string text = joint.mobile.name + " and " + joint.fixed.name +
                     " are in contact in the reference pose: " + std::to_string(contact.pairs.size()) +
                     " pairs of triangles meet";
  const contact::RadialBodySummary mobile = summary.mobile.value_or(contact::RadialBodySummary{});
  const contact::RadialBodySummary fixed = summary.fixed.value_or(contact::RadialBodySummary{});
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
         "pose, or accept contact at the start";
}

}  // namespace condyle::motion
