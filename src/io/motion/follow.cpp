#include "io/motion/follow.hpp"

#include <fmt/format.h>

#include <utility>

#include "condyle/error.hpp"

namespace condyle::io {

void follow(RangeRequest& request, const LoadedJoint& joint, const JointMotion& recorded,
            MotionsAre motions) {
  FollowRecord record{coordinates_of(joint.joint, recorded), recorded.notes};
  if (motions == MotionsAre::all)
    // With none the request is refused, and says of the first motion why.
    if (std::vector<motion::Motion> led = motions_recorded(request.motions, record); !led.empty())
      request.motions = std::move(led);
  request.follow = std::move(record);
  try {
    check_range_request(joint, request);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{}: {}", recorded.path.string(), error.what()));
  }
}

FollowedLayers::FollowedLayers(const LoadedJoint& joint, const ContactEntry& entry)
    : surfaces_(surfaces_of(entry, joint.joint)),
      contact_(surfaces_.fixed.mesh, surfaces_.mobile.mesh, elastic_options(entry, surfaces_, joint)) {}

FollowLoad FollowedLayers::carrying(const contact::Load& load, const contact::BalanceOptions& balance) const {
  return {.layers = &contact_,
          .load = load,
          .balance = balance,
          .names = {surfaces_.fixed.name, surfaces_.mobile.name}};
}

}  // namespace condyle::io
