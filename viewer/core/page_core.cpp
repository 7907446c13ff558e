#include "page_core.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "condyle/answer.hpp"
#include "condyle/joint.hpp"
#include "condyle/motion_contact.hpp"
#include "contact/body_pair.hpp"
#include "io/report/shown_end.hpp"
#include "mesh/surface_to_surface.hpp"
#include "page_joint.hpp"

using namespace condyle;

namespace {

Mesh mesh_of(const double* vertices, int vertex_count, const std::uint32_t* triangles, int triangle_count) {
  TriMesh mesh{.vertices = points_of(vertices, static_cast<std::size_t>(vertex_count)), .triangles = {}};
  for (int t = 0; t < triangle_count; ++t)
    mesh.triangles.push_back({triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]});
  return Mesh(std::move(mesh));
}

/// The other body's surface, for vertices of this one.
const mesh::SurfaceDistance& other_surface(CondyleJoint& joint, bool of_fixed) {
  auto& surface = of_fixed ? joint.to_mobile : joint.to_fixed;
  if (!surface) surface.emplace(body_of(joint, !of_fixed).mesh.arrays());
  return *surface;
}

enum class Shown { radial_gap, depth, nearest_distance };
enum class Mark : std::uint8_t { nothing, value, bound };

/// The table of the other body, for vertices of this one.
const radial::RadialTable& other_table(const CondyleJoint& joint, bool of_fixed) {
  return of_fixed ? joint.bodies.mobile_table() : joint.bodies.fixed_table();
}

void find_inside(const CondyleJoint& joint, const Pose& X_FM, bool of_fixed, radial::Penetrations& found) {
  if (of_fixed)
    joint.bodies.fixed_in_mobile(X_FM, found);
  else
    joint.bodies.mobile_in_fixed(X_FM, found);
}

/// visit(DeepestVertex) for each vertex found inside the other body, which X brings it to.
template <class Visit>
void visit_inside(CondyleJoint& joint, const Pose& X, bool of_fixed, radial::Penetrations& found,
                  const Visit& visit) {
  const Points& vertices = body_of(joint, of_fixed).mesh.vertices();
  other_table(joint, of_fixed).add_ray_to_normal(vertices, X, found);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found.state[i] != PointState::inside) continue;
    const Index v = found.point[i];
    visit(contact::DeepestVertex{v, found.depth_mm[i], other_surface(joint, of_fixed)(X * vertices[v]),
                                 found.ray_to_normal[i]});
  }
}

/// Where the parts whose contact ends motions are nearest, in numbers of the whole meshes.
mesh::ClosestPoints nearest_counted(CondyleJoint& joint, const motion::RangeOfMotion& range,
                                    const Pose& X_FM) {
  if (!joint.counted) {
    motion::OverlapOptions options;
    options.reference_contact = motion::ReferenceContact::accept;
    joint.counted = motion::parts_that_count(joint.joint, options, range.bearing(), range.bearing_rule());
  }
  std::optional<mesh::ClosestPoints> nearest;
  for (const motion::PairOfParts& pair : joint.counted->impinging) {
    const auto& [fixed, fixed_in_whole] = joint.counted->fixed[pair.fixed];
    const auto& [mobile, mobile_in_whole] = joint.counted->mobile[pair.mobile];
    const double at_most = nearest ? nearest->distance_mm : std::numeric_limits<double>::infinity();
    if (auto found = mesh::closest_points(*mesh::tree_of(fixed), *mesh::tree_of(mobile), X_FM, at_most)) {
      found->a_triangle = fixed_in_whole[found->a_triangle];
      found->b_triangle = mobile_in_whole[found->b_triangle];
      nearest = found;
    }
  }
  return nearest.value();
}

/// About the axes in their order.
constexpr std::array ways_about{contact::DepthKind::flexion, contact::DepthKind::adduction,
                                contact::DepthKind::internal_rotation};

/// Values shown at each vertex of a body.
struct ShownValues {
  float* mm;
  std::uint8_t* marks;

  void set(Index v, double value, Mark mark = Mark::value) const {
    mm[v] = static_cast<float>(value);
    marks[v] = static_cast<std::uint8_t>(mark);
  }
};

}  // namespace

JointAngles angles_of(const double* deg) {
  return {Angle::degrees(deg[0]), Angle::degrees(deg[1]), Angle::degrees(deg[2])};
}

Pose pose_of(const double* rows) {
  Pose pose = Pose::Identity();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) pose.matrix()(r, c) = rows[4 * r + c];
  return pose;
}

Points points_of(const double* xyz, std::size_t count) {
  Points points;
  for (std::size_t v = 0; v < count; ++v) points.push_back({xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]});
  return points;
}

void put_points(const Points& points, double* xyz) {
  for (std::size_t v = 0; v < points.size(); ++v)
    for (int i = 0; i < 3; ++i) *xyz++ = points[v][i];
}

const motion::RangeOfMotion& range_of(CondyleJoint& joint, const Vec3& held_mm) {
  if (!joint.range || joint.range_held_at != held_mm) {
    motion::RangeOptions options{.bearing = joint.bearing};
    options.overlap.reference_contact = motion::ReferenceContact::accept;
    joint.range = std::make_shared<const motion::RangeOfMotion>(held_at(joint.joint, held_mm), options);
    joint.range_held_at = held_mm;
  }
  return *joint.range;
}

std::string& last_error() {
  static std::string error;
  return error;
}

const char* condyle_error() {
  return last_error().c_str();
}

CondyleJoint* condyle_joint(int kind, int anatomy, int side, int translation_frame,
                            const double* fixed_vertices, int fixed_vertex_count,
                            const std::uint32_t* fixed_triangles, int fixed_triangle_count,
                            const double* mobile_vertices, int mobile_vertex_count,
                            const std::uint32_t* mobile_triangles, int mobile_triangle_count) {
  return guarded(static_cast<CondyleJoint*>(nullptr), [&] {
    constexpr std::array kinds{JointKind::ball, JointKind::hinge, JointKind::free};
    constexpr std::array anatomies{Anatomy::hip, Anatomy::knee, Anatomy::ankle, Anatomy::elbow,
                                   Anatomy::shoulder};
    Joint joint{
        .name = {},
        .kind = kinds.at(static_cast<std::size_t>(kind)),
        .side = side == 0 ? Side::right : Side::left,
        .fixed = {"fixed body",
                  mesh_of(fixed_vertices, fixed_vertex_count, fixed_triangles, fixed_triangle_count)},
        .mobile = {"mobile body",
                   mesh_of(mobile_vertices, mobile_vertex_count, mobile_triangles, mobile_triangle_count)},
        .anatomy = anatomies.at(static_cast<std::size_t>(anatomy)),
        .translation_frame = translation_frame == 0 ? TranslationFrame::fixed : TranslationFrame::joint_axes};
    contact::JointContact bodies(joint);
    return new CondyleJoint{std::move(joint), std::move(bodies)};
  });
}

void condyle_free(CondyleJoint* joint) {
  delete joint;
}

int condyle_pose(const CondyleJoint* joint, const double* angles_deg, const double* translation_mm,
                 double* pose) {
  return guarded(-1, [&] {
    const JointCoordinates at{angles_of(angles_deg),
                              Vec3(translation_mm[0], translation_mm[1], translation_mm[2])};
    const Pose X_FM = pose_at(joint->joint.coordinates(), at, joint->joint.translation_frame);
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) pose[4 * r + c] = X_FM.matrix()(r, c);
    return 0;
  });
}

int condyle_can_penetrate(const CondyleJoint* joint, int of_fixed) {
  return body_of(*joint, !of_fixed).mesh.is_closed();
}

int condyle_penetrations(CondyleJoint* joint, const double* pose, int of_fixed) {
  return guarded(-1, [&] {
    find_inside(*joint, pose_of(pose), of_fixed, joint->penetrations);
    return static_cast<int>(joint->penetrations.size());
  });
}

const std::uint32_t* condyle_penetrating_vertices(const CondyleJoint* joint) {
  return joint->penetrations.point.data();
}

const double* condyle_depths(const CondyleJoint* joint) {
  return joint->penetrations.depth_mm.data();
}

int condyle_depth(CondyleJoint* joint, const double* pose, const double* angles_deg, double answer[16]) {
  return guarded(-1, [&] {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const Pose X_FM = pose_of(pose);
    const DepthAnswer depth =
        answer_depth(joint->bodies, joint->joint, {.X_FM = X_FM, .pose = angles_of(angles_deg)});
    const contact::ContactMeasures& measures = depth.measures;
    const contact::ReliableContact& reliable = std::get<RayDepths>(depth.depths).reliable;
    std::fill_n(answer, 16, none);
    answer[0] = depth.in_contact() ? 1 : 0;
    answer[1] = 0;
    if (const auto deepest = contact::deepest_of(reliable)) {
      const contact::DeepestReliable& vertex = deepest->vertex;
      const Vec3 own = body_of(*joint, !deepest->is_mobile).mesh.vertices()[vertex.vertex];
      const Vec3 point = deepest->is_mobile ? posed(X_FM, own) : own;
      answer[1] = static_cast<double>(vertex.kind);
      answer[2] = vertex.depth_mm;
      answer[3] = deepest->is_mobile ? 0 : 1;
      answer[4] = vertex.vertex;
      for (int i = 0; i < 3; ++i) answer[5 + i] = point[i];
      answer[8] = vertex.nearest_distance_mm;
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (vertex.kind == ways_about[axis]) answer[9] = vertex.rotations[axis]->angle.degrees();
    }
    answer[10] = static_cast<double>(contact::without_depth(reliable));
    if (measures.mobile) answer[11] = measures.mobile->area_mm2;
    if (measures.fixed) answer[12] = measures.fixed->area_mm2;
    if (measures.volume_mm3) {
      answer[13] = *measures.volume_mm3;
      answer[14] = measures.volume_error_mm3;
      answer[15] = measures.mobile_covered_again_mm3 + measures.fixed_covered_again_mm3;
    }
    return 0;
  });
}

int condyle_screw(const CondyleJoint* joint, const double* before, const double* pose, double answer[9]) {
  return guarded(-1, [&] {
    const std::array<std::optional<motion::FrameContact>, 2> frames{
        motion::FrameContact{.X_FM = pose_of(before)},
        motion::FrameContact{.X_FM = pose_of(pose), .in_contact = joint->bodies.in_contact(pose_of(pose))}};
    const motion::ScrewStep step = *motion::screws_along(joint->bodies, frames)->back();
    std::fill_n(answer, 9, std::numeric_limits<double>::quiet_NaN());
    answer[0] = step.is_slide();
    for (int i = 0; step.axis && i < 3; ++i) {
      answer[1 + i] = step.axis->direction[i];
      answer[4 + i] = step.axis->point[i];
    }
    if (step.depth) answer[7] = step.depth->degrees();
    if (step.depth_mm) answer[8] = *step.depth_mm;
    return 0;
  });
}

int condyle_shown(CondyleJoint* joint, const double* pose, int quantity, int of_fixed, float* values,
                  std::uint8_t* marks) {
  return guarded(-1, [&] {
    const Pose X_FM = pose_of(pose), X = of_fixed ? inverted(X_FM) : X_FM;
    const Points& vertices = body_of(*joint, of_fixed).mesh.vertices();
    const ShownValues shown{values, marks};
    for (Index v = 0; v < vertices.size(); ++v) shown.set(v, 0, Mark::nothing);
    // An open mesh has no inside: of it distances are shown alone.
    const bool has_inside = condyle_can_penetrate(joint, of_fixed);
    const auto what = static_cast<Shown>(quantity);
    radial::Penetrations inside;
    if (has_inside && what != Shown::radial_gap) find_inside(*joint, X_FM, of_fixed, inside);
    switch (what) {
      case Shown::radial_gap: {
        if (!has_inside) break;
        const std::vector<double> gaps = other_table(*joint, of_fixed).radial_gaps(posed(X, vertices));
        for (Index v = 0; v < gaps.size(); ++v)
          if (std::isfinite(gaps[v])) shown.set(v, gaps[v]);
        break;
      }
      case Shown::depth:
        if (!has_inside) break;
        visit_inside(*joint, X, of_fixed, inside, [&](const contact::DeepestVertex& vertex) {
          if (vertex.radial_is_depth())
            shown.set(vertex.vertex, vertex.depth_mm);
          else
            shown.set(vertex.vertex, vertex.shortest_exit_mm, Mark::bound);
        });
        break;
      case Shown::nearest_distance:
        for (Index v = 0; v < vertices.size(); ++v)
          shown.set(v, other_surface(*joint, of_fixed)(X * vertices[v]));
        for (std::size_t i = 0; i < inside.size(); ++i)
          if (const Index v = inside.point[i]; inside.state[i] == PointState::inside) values[v] = -values[v];
        break;
    }
    return 0;
  });
}

int condyle_nearest(CondyleJoint* joint, const double* pose, int counted, double answer[7]) {
  return guarded(-1, [&] {
    const Pose X_FM = pose_of(pose);
    const motion::RangeOfMotion& range = range_of(*joint, joint->range_held_at);
    const contact::BodyPair& bodies = contact::body_pair_of(joint->bodies);
    const mesh::ClosestPoints nearest =
        counted ? nearest_counted(*joint, range, X_FM)
                : mesh::closest_points(bodies.fixed_tree(), bodies.mobile_tree(), X_FM).value();
    const motion::ContactKind kind = range.bearing().kind_of(nearest.a_triangle, nearest.b_triangle);
    answer[0] = nearest.distance_mm;
    answer[1] = nearest.a_triangle;
    answer[2] = nearest.b_triangle;
    answer[3] = kind == motion::ContactKind::bearing ? 1 : 0;
    for (int i = 0; i < 3; ++i) answer[4 + i] = nearest.a_point[i];
    return 0;
  });
}

int condyle_in_contact(CondyleJoint* joint, const double* pose) {
  return guarded(-1, [&] { return joint->bodies.in_contact(pose_of(pose)) ? 1 : 0; });
}

int condyle_pairs(CondyleJoint* joint, const double* pose) {
  return guarded(-1, [&] {
    joint->pair_triangles.clear();
    for (const contact::TrianglePair& pair : joint->bodies.pairs(pose_of(pose)))
      joint->pair_triangles.insert(joint->pair_triangles.end(), {pair.fixed, pair.mobile});
    return static_cast<int>(joint->pair_triangles.size() / 2);
  });
}

const std::uint32_t* condyle_pair_triangles(const CondyleJoint* joint) {
  return joint->pair_triangles.data();
}

void put_limit(const motion::RangeOfMotion& range, const PageMotion& motion, const Vec3& origin,
               double limit[8]) {
  const Angle most = Angle::degrees(motion.range_deg);
  const motion::RotationLimits ends = range.both_limits(
      all_joint_angles.at(static_cast<std::size_t>(motion.vary)), angles_of(motion.start_deg),
      {motion.is_positive ? Angle() : -most, motion.is_positive ? most : Angle()});
  const motion::Limit& end = motion.is_positive ? ends.positive : ends.negative;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Vec3 point = end.contact ? Vec3(end.contact->fixed_point + origin) : Vec3(none, none, none);
  // At the end of its range a motion went as far as was asked, which radians are a rounding off.
  limit[0] = end.turned == most ? motion.range_deg : end.turned.degrees();
  limit[1] = static_cast<double>(end.reason);
  limit[2] = static_cast<double>(end.kind());
  limit[3] = end.bearing_contact ? end.bearing_contact->turned.degrees() : -1;
  for (int i = 0; i < 3; ++i) limit[4 + i] = point[i];
  limit[7] = end.ligament ? static_cast<double>(*end.ligament) : -1;
}

int condyle_limit(CondyleJoint* joint, int vary, int positive, const double* start_deg, const double* held_mm,
                  double range_deg, double limit[8]) {
  return guarded(-1, [&] {
    const Vec3 held(held_mm[0], held_mm[1], held_mm[2]);
    put_limit(range_of(*joint, held), {vary, positive != 0, start_deg, range_deg}, held, limit);
    return 0;
  });
}

int condyle_free_angles(CondyleJoint* joint, int vary, const double* start_deg, const double* held_mm,
                        double back_deg, double forth_deg) {
  return guarded(-1, [&] {
    const motion::FreeAngles free =
        range_of(*joint, Vec3(held_mm[0], held_mm[1], held_mm[2]))
            .free_angles(all_joint_angles.at(static_cast<std::size_t>(vary)), angles_of(start_deg),
                         {Angle::degrees(-back_deg), Angle::degrees(forth_deg)});
    joint->intervals.clear();
    for (const motion::FreeInterval& interval : free.intervals)
      joint->intervals.insert(joint->intervals.end(), {interval.low.degrees(), interval.high.degrees(),
                                                       double(io::shown_end(interval.at_low)),
                                                       double(io::shown_end(interval.at_high))});
    return static_cast<int>(free.intervals.size());
  });
}

const double* condyle_intervals(const CondyleJoint* joint) {
  return joint->intervals.data();
}

int condyle_standing(CondyleJoint* joint, const double* angles_deg, const double* held_mm, double answer[4]) {
  return guarded(-1, [&] {
    const JointAngles at = angles_of(angles_deg);
    const Vec3 held(held_mm[0], held_mm[1], held_mm[2]);
    Pose X_FM = pose_at(joint->joint.coordinates(), at);
    X_FM.translation() = held;
    const PoseStanding standing =
        pose_standing(range_of(*joint, held), at, Vec3::Zero(), joint->bodies.in_contact(X_FM),
                      PoseStanding::FindNearest::at_limits);
    const bool is_at_limit = standing.state == PoseState::at_limit;
    answer[0] = static_cast<double>(standing.state);
    answer[1] = is_at_limit ? static_cast<double>(standing.nearest->vary) : -1;
    answer[2] = is_at_limit && standing.nearest->sense == RotationSense::positive;
    answer[3] = is_at_limit && standing.nearest->end.reason == motion::LimitReason::ligament;
    return 0;
  });
}

int condyle_set_roles(CondyleJoint* joint, int count_bearing, const std::uint8_t* fixed,
                      const std::uint8_t* mobile) {
  return guarded(-1, [&] {
    joint->range.reset();
    joint->counted.reset();
    const auto roles_of = [](const Body& body, const std::uint8_t* numbers) {
      std::vector<motion::ContactRole> roles;
      for (std::size_t t = 0; numbers && t < body.mesh.triangles().size(); ++t)
        roles.push_back(static_cast<motion::ContactRole>(numbers[t]));
      return roles;
    };
    joint->bearing = {.rule = count_bearing ? motion::BearingRule::count : motion::BearingRule::leave_out,
                      .roles = motion::ContactRoles{roles_of(joint->joint.fixed, fixed),
                                                    roles_of(joint->joint.mobile, mobile)}};
    return 0;
  });
}

int condyle_bearing(CondyleJoint* joint, std::uint8_t* triangles) {
  return guarded(-1, [&] {
    int count = 0;
    for (const motion::ContactRole role : range_of(*joint).bearing().roles.mobile) {
      const bool slides =
          role == motion::ContactRole::bearing || role == motion::ContactRole::bearing_on_bearing;
      *triangles++ = slides;
      count += slides;
    }
    return count;
  });
}
