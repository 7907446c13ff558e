#include <algorithm>
#include <limits>
#include <string>
#include <type_traits>

#include "boundary.hpp"
#include "condyle/answer.hpp"
#include "joint_contact.hpp"

struct condyle_contact_results {
  bool has_answer = false;
  condyle::Pose X_FM = condyle::Pose::Identity();
  condyle::contact::Contact contact = {};
};

namespace condyle::c {
namespace {

static_assert(static_cast<int>(PointState::on_surface) == CONDYLE_ON_SURFACE &&
              static_cast<int>(PointState::inside) == CONDYLE_INSIDE);
static_assert(static_cast<int>(radial::RayDirection::towards_centre) == CONDYLE_TOWARDS_CENTRE &&
              static_cast<int>(radial::RayDirection::away_from_centre) == CONDYLE_AWAY_FROM_CENTRE);

/// The bytes of enumerators, which are unsigned chars.
template <class Enum>
const std::uint8_t* bytes_of(const std::vector<Enum>& values) noexcept {
  static_assert(std::is_same_v<std::underlying_type_t<Enum>, std::uint8_t>);
  return reinterpret_cast<const std::uint8_t*>(values.data());
}

condyle_touch touch_of(const TouchAnswer& answer) noexcept {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto role = [](BodyRole of) -> int { return of == BodyRole::fixed ? CONDYLE_FIXED : CONDYLE_MOBILE; };
  condyle_touch out = {};
  out.in_contact = answer.in_contact, out.intersecting_pairs = answer.pairs.size();
  out.inside = answer.inside ? role(*answer.inside) : -1;
  out.deepest_of = answer.deepest ? role(answer.deepest->of) : -1;
  const Vec3 nowhere = Vec3::Constant(none);
  out.nearest_distance_mm = answer.nearest ? answer.nearest->distance_mm : none;
  copy(answer.nearest ? answer.nearest->on_fixed : nowhere, out.nearest_fixed_mm);
  copy(answer.nearest ? answer.nearest->on_mobile : nowhere, out.nearest_mobile_mm);
  out.depth_mm = answer.deepest ? answer.deepest->depth_mm : none;
  out.depth_error_mm = answer.deepest ? answer.deepest->error_mm : none;
  out.depth_bound_mm = answer.depth_bound_mm.value_or(none);
  copy(answer.deepest ? answer.deepest->place : nowhere, out.place_mm);
  copy(answer.deepest ? answer.deepest->exit : nowhere, out.exit_mm);
  const TouchOverlap overlap = answer.overlap.value_or(TouchOverlap{});
  out.volume_mm3 = overlap.volume_mm3.value_or(none);
  out.volume_error_mm3 = overlap.volume_mm3 ? overlap.volume_error_mm3 : none;
  out.fixed_area_mm2 = overlap.fixed_area_mm2.value_or(none);
  out.mobile_area_mm2 = overlap.mobile_area_mm2.value_or(none);
  out.fixed_covered_again_mm3 = overlap.volume_mm3 ? overlap.fixed_covered_again_mm3 : none;
  out.mobile_covered_again_mm3 = overlap.volume_mm3 ? overlap.mobile_covered_again_mm3 : none;
  return out;
}

/// As JointContact::at(), into vertices that keep their capacity.
void answer(const contact::JointContact& joint, const Pose& X_FM, contact::Contact& out) {
  auto& [mobile, fixed, pairs, in_contact] = out;
  const auto vertices = [](bool other_is_closed, std::optional<radial::Penetrations>& kept) -> auto* {
    if (!other_is_closed)
      kept.reset();
    else if (!kept)
      kept.emplace();
    return kept ? &*kept : nullptr;
  };
  if (auto* inside = vertices(joint.fixed().is_closed(), mobile)) joint.mobile_in_fixed(X_FM, *inside);
  if (auto* inside = vertices(joint.mobile().is_closed(), fixed)) joint.fixed_in_mobile(X_FM, *inside);
  pairs = joint.pairs(X_FM);
  in_contact = !pairs.empty() || (mobile && mobile->size() > 0) || (fixed && fixed->size() > 0);
}

}  // namespace
}  // namespace condyle::c

using namespace condyle;

condyle_status condyle_joint_contact_create(const condyle_mesh* fixed, const condyle_mesh* mobile,
                                            condyle_joint_contact** contact) {
  return c::guarded([&] {
    condyle_joint_contact*& out = c::required(contact, "contact");
    out = new condyle_joint_contact{
        contact::JointContact(c::required(fixed, "fixed").mesh, c::required(mobile, "mobile").mesh)};
  });
}

void condyle_joint_contact_destroy(condyle_joint_contact* contact) {
  delete contact;
}

condyle_status condyle_joint_contact_update(condyle_joint_contact* contact, condyle_body body,
                                            const double* xyz_mm, size_t vertex_count) {
  return c::guarded([&] {
    contact::JointContact& joint = c::required(contact, "contact").joint;
    const BodyRole role = c::role_of(body);
    joint.update(role, c::all_points_of(c::mesh_of(joint, role), xyz_mm, vertex_count));
  });
}

condyle_status condyle_joint_contact_update_some(condyle_joint_contact* contact, condyle_body body,
                                                 const uint32_t* vertices, size_t count,
                                                 const double* xyz_mm) {
  return c::guarded([&] {
    contact::JointContact& joint = c::required(contact, "contact").joint;
    const BodyRole role = c::role_of(body);
    const c::SomePoints some = c::some_points_of(c::mesh_of(joint, role), vertices, count, xyz_mm);
    joint.update(role, some.vertices, some.points);
  });
}

condyle_status condyle_contact_results_create(condyle_contact_results** results) {
  return c::make(results, "results");
}

void condyle_contact_results_destroy(condyle_contact_results* results) {
  delete results;
}

condyle_status condyle_joint_contact_at(const condyle_joint_contact* contact, const condyle_pose* X_FM,
                                        condyle_contact_results* results) {
  return c::guarded([&] {
    condyle_contact_results& out = c::required(results, "results");
    out.has_answer = false;
    const contact::JointContact& joint = c::required(contact, "contact").joint;
    out.X_FM = c::pose_of(X_FM, "X_FM");
    c::answer(joint, out.X_FM, out.contact);
    out.has_answer = true;
  });
}

condyle_status condyle_joint_contact_touch(const condyle_joint_contact* contact, const condyle_pose* X_FM,
                                           int with_measures, condyle_touch* touch) {
  return c::guarded([&] {
    const contact::JointContact& joint = c::required(contact, "contact").joint;
    condyle_touch& out = c::required(touch, "touch");
    const TouchMeasures measures = with_measures != 0 ? TouchMeasures::all : TouchMeasures::depth;
    out = c::touch_of(answer_touch(joint, {.X_FM = c::pose_of(X_FM, "X_FM"), .measures = measures}));
  });
}

condyle_status condyle_joint_contact_in_contact(const condyle_joint_contact* contact,
                                                const condyle_pose* X_FM, int* in_contact) {
  return c::guarded([&] {
    int& out = c::required(in_contact, "in_contact");
    out = c::required(contact, "contact").joint.in_contact(c::pose_of(X_FM, "X_FM"));
  });
}

condyle_status condyle_joint_contact_radial_gaps(const condyle_joint_contact* contact,
                                                 const condyle_pose* X_FM, condyle_body body, double* gaps_mm,
                                                 size_t count) {
  return c::guarded([&] {
    const contact::JointContact& joint = c::required(contact, "contact").joint;
    const bool of_mobile = c::role_of(body) == BodyRole::mobile;
    const Points& vertices = (of_mobile ? joint.mobile() : joint.fixed()).vertices();
    if (count != vertices.size())
      throw UsageError("count is " + std::to_string(count) + ", and the body has " +
                       std::to_string(vertices.size()) + " vertices");
    if (count > 0) c::require(gaps_mm, "gaps_mm");
    const Pose X_FM_in = c::pose_of(X_FM, "X_FM");
    const std::vector<double> gaps =
        of_mobile ? joint.fixed_table().radial_gaps(posed(X_FM_in, vertices))
                  : joint.mobile_table().radial_gaps(posed(inverted(X_FM_in), vertices));
    std::copy(gaps.begin(), gaps.end(), gaps_mm);
  });
}

condyle_status condyle_joint_contact_arc_gaps(const condyle_joint_contact* contact, const condyle_pose* X_FM,
                                              const double axis_point_mm[3], const double axis_direction[3],
                                              condyle_body body, double* gaps_deg, double* gaps_mm,
                                              size_t count) {
  return c::guarded([&] {
    const contact::JointContact& joint = c::required(contact, "contact").joint;
    const contact::AxisLine axis{c::vector_of(axis_direction, "axis_direction"),
                                 c::vector_of(axis_point_mm, "axis_point_mm")};
    const contact::TangentialContact found = joint.tangential(c::pose_of(X_FM, "X_FM"), axis);
    const auto& gaps = c::role_of(body) == BodyRole::mobile ? found.mobile_in_fixed : found.fixed_in_mobile;
    if (!gaps) throw MeshError("arcs: the other body's mesh is open");
    if (count != gaps->size())
      throw UsageError("count is " + std::to_string(count) + ", and the body has " +
                       std::to_string(gaps->size()) + " vertices");
    if (gaps_mm) std::copy(gaps->arc_gap_mm.begin(), gaps->arc_gap_mm.end(), gaps_mm);
    if (gaps_deg)
      std::transform(gaps->angular_gap.begin(), gaps->angular_gap.end(), gaps_deg,
                     [](Angle gap) { return gap.degrees(); });
  });
}

condyle_status condyle_joint_contact_ray_angles(const condyle_joint_contact* contact,
                                                condyle_contact_results* results, condyle_body body,
                                                double* angles_deg, size_t count) {
  return c::guarded([&] {
    const contact::JointContact& joint = c::required(contact, "contact").joint;
    const Pose X_FM = c::answered(results).X_FM;
    const bool of_mobile = c::role_of(body) == BodyRole::mobile;
    auto& inside = of_mobile ? results->contact.mobile_in_fixed : results->contact.fixed_in_mobile;
    const std::size_t found = inside ? inside->size() : 0;
    if (count != found)
      throw UsageError("count is " + std::to_string(count) + ", and " + std::to_string(found) +
                       " vertices are not outside");
    if (count == 0) return;
    c::require(angles_deg, "angles_deg");
    const Mesh &body_mesh = of_mobile ? joint.mobile() : joint.fixed(),
               &other = of_mobile ? joint.fixed() : joint.mobile();
    const auto all_below = [](const std::vector<Index>& numbers, std::size_t end) {
      return std::all_of(numbers.begin(), numbers.end(), [&](Index i) { return i < end || i == no_index; });
    };
    if (!all_below(inside->point, body_mesh.vertices().size()) ||
        !all_below(inside->triangle, other.triangles().size()))
      throw UsageError("the results are those of another contact");
    const radial::RadialTable& table = of_mobile ? joint.fixed_table() : joint.mobile_table();
    table.add_ray_to_normal(body_mesh.vertices(), of_mobile ? X_FM : inverted(X_FM), *inside);
    std::transform(inside->ray_to_normal.begin(), inside->ray_to_normal.end(), angles_deg,
                   [](Angle angle) { return angle.degrees(); });
  });
}

condyle_status condyle_contact_results_vertices(const condyle_contact_results* results, condyle_body body,
                                                condyle_vertices_inside* out) {
  return c::guarded([&] {
    const contact::Contact& contact = c::answered(results).contact;
    condyle_vertices_inside& view = c::required(out, "out");
    const auto& inside =
        c::role_of(body) == BodyRole::mobile ? contact.mobile_in_fixed : contact.fixed_in_mobile;
    view = {};
    if (inside)
      view = {1,
              inside->size(),
              inside->point.data(),
              c::bytes_of(inside->state),
              inside->depth_mm.data(),
              inside->triangle.data(),
              c::bytes_of(inside->direction)};
  });
}

condyle_status condyle_contact_results_pairs(const condyle_contact_results* results, const uint32_t** pairs,
                                             size_t* pair_count) {
  return c::guarded([&] {
    // Two numbers side by side, which C reads as one array.
    static_assert(sizeof(contact::TrianglePair) == 2 * sizeof(std::uint32_t));
    const auto& found = c::answered(results).contact.pairs;
    const std::uint32_t*& first = c::required(pairs, "pairs");
    c::required(pair_count, "pair_count") = found.size();
    first = found.empty() ? nullptr : &found.front().fixed;
  });
}

condyle_status condyle_contact_results_in_contact(const condyle_contact_results* results, int* in_contact) {
  return c::guarded([&] {
    const contact::Contact& contact = c::answered(results).contact;
    c::required(in_contact, "in_contact") = contact.in_contact;
  });
}
