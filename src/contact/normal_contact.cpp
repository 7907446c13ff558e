#include "condyle/normal_depth.hpp"
#include "condyle/pressure.hpp"

namespace condyle::contact {
namespace {

NormalCast cast(const Mesh& from, const Mesh& to, const Pose& X_CT, const NormalDepthOptions& rays) {
  const NormalDepth depth(from, to, rays);
  return {depth.at(X_CT), depth.cut_off_by_reach(X_CT)};
}

}  // namespace

NormalContact normal_contact(const JointContact& joint, const Pose& X_FM, Casting casting,
                             const NormalDepthOptions& rays) {
  NormalContact contact;
  contact.pairs = joint.pairs(X_FM);
  contact.in_contact = !contact.pairs.empty() || joint.in_contact(X_FM);
  if (casting != Casting::mobile) contact.fixed = cast(joint.fixed(), joint.mobile(), X_FM, rays);
  if (casting != Casting::fixed) contact.mobile = cast(joint.mobile(), joint.fixed(), inverted(X_FM), rays);
  return contact;
}

}  // namespace condyle::contact
