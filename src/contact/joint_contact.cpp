#include "contact/joint_contact.hpp"

#include <algorithm>
#include <string>

#include "condyle/error.hpp"

namespace condyle {
namespace {

RadialTable table_of(const char* body, const Mesh& mesh, const RadialOptions& options) {
  try {
    return RadialTable(mesh, options);
  } catch (const MeshError& error) {
    throw MeshError(std::string(body) + ": " + error.what());
  }
}

bool any_not_outside(const std::optional<RadialResults>& hits) {
  return hits && std::any_of(hits->state.begin(), hits->state.end(),
                             [](PointState state) { return state != PointState::outside; });
}

}  // namespace

JointContact::JointContact(const Mesh& fixed, const Mesh& mobile, RadialOptions options)
    : fixed_mesh_(fixed),
      mobile_mesh_(mobile),
      fixed_(table_of("fixed body", fixed, options)),
      mobile_(table_of("mobile body", mobile, options)),
      bodies_(fixed, mobile) {}

std::vector<TrianglePair> JointContact::pairs(const Pose& X_FM) const {
  return bodies_.pairs(X_FM);
}

RadialContact JointContact::radial(const Pose& X_FM) const {
  RadialContact contact;
  if (fixed().is_closed()) contact.mobile_in_fixed = fixed_.query(posed(X_FM, mobile().vertices()));
  if (mobile().is_closed())
    contact.fixed_in_mobile = mobile_.query(posed(X_FM.inverse(), fixed().vertices()));
  contact.pairs = pairs(X_FM);
  contact.in_contact = !contact.pairs.empty() || any_not_outside(contact.mobile_in_fixed) ||
                       any_not_outside(contact.fixed_in_mobile);
  return contact;
}

}  // namespace condyle
