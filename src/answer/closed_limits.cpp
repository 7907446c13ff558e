#include "answer/closed_limits.hpp"

#include <string>

#include "condyle/implant.hpp"
#include "core/formatted.hpp"

namespace condyle::answer {
namespace {

/// Coordinates in single precision, as in files of floats, move a limit by some 1e-5 degrees where a neck comes over its rim at a usual angle.
constexpr Angle rounding_of_meshes = Angle::degrees(1e-3);

/// Whether a contact is of the two meshes that the closed form is of.
bool is_of_pair(const Joint& joint, const motion::ContactWitness& contact) {
  const auto is_on = [](const Body& body, const motion::Feature& feature, const std::string& mesh) {
    if (mesh.empty()) return true;
    const BodyPart* part = feature.kind == motion::FeatureKind::face ? part_of_triangle(body, feature.id)
                                                                     : part_of_vertex(body, feature.id);
    return part && part->name == mesh;
  };
  return is_on(joint.fixed, contact.fixed_feature, joint.implant->fixed_mesh) &&
         is_on(joint.mobile, contact.mobile_feature, joint.implant->mobile_mesh);
}

/// Whether meshes that lie between the two bodies of revolution can end the motion here: other contact may come before, none after.
bool agrees(const Joint& joint, const motion::MotionLimit& limit, const plan::ClosedLimit& closed) {
  const Angle turned = limit.end.turned;
  if (turned > closed.of_facets_high + rounding_of_meshes) return false;
  const bool is_by_pair = limit.end.contact && is_of_pair(joint, *limit.end.contact);
  return !is_by_pair || turned > closed.of_facets_low - rounding_of_meshes;
}

}  // namespace

void add_closed_limits(RangeAnswer& answer) {
  const plan::ClosedForm form = plan::closed_form(answer.joint);
  if (!form.pair) return;
  std::string differing;
  for (const motion::MotionLimit& limit : answer.limits) {
    const plan::ClosedLimit closed = plan::closed_limit(*form.pair, answer.joint.coordinates(), limit.motion);
    answer.closed.push_back(closed);
    if (agrees(answer.joint, limit, closed)) continue;
    differing +=
        (differing.empty() ? "" : ", ") + limit.motion.name +
        core::formatted(" %.3f, closed form %.3f", limit.end.turned.degrees(), closed.turned.degrees());
  }
  if (!differing.empty())
    answer.notes.push_back(
        {RangeNoteCode::differs_from_closed_form,
         "the meshes of the implant end motions elsewhere than bodies of the sizes in the joint file: " +
             differing});
}

}  // namespace condyle::answer
