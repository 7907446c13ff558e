#pragma once

#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"

/// Requests for a range of motion whose translation follows a recorded motion, or a load through layers: the command, reports and
/// studies make them here.

namespace condyle::io {

/// Which motions a request holds.
enum class MotionsAre : std::uint8_t {
  chosen,  ///< by name: each of them is wanted
  all,     ///< all that the joint has: those along which a record leads are meant
};

/// Makes the request follow the recorded motion. Throws UsageError that begins with its file if it leads along no motion wanted, and
/// for what check_range_request() refuses.
void follow(RangeRequest& request, const LoadedJoint& joint, const JointMotion& recorded, MotionsAre motions);

/// The layers of a joint, which outlive the request that follows a load through them.
class FollowedLayers {
 public:
  /// Throws as surfaces_of() and elastic_options() do.
  FollowedLayers(const LoadedJoint& joint, const ContactEntry& entry);

  FollowLoad carrying(const contact::Load& load, const contact::BalanceOptions& balance) const;

 private:
  ContactSurfaces surfaces_;
  contact::ElasticContact contact_;
};

}  // namespace condyle::io
