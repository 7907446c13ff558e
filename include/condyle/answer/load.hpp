#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "condyle/answer/case.hpp"
#include "condyle/answer/depth.hpp"
#include "condyle/motion_contact.hpp"
#include "condyle/pressure.hpp"

/// The pressure of layers in one pose, and the pose in which they carry a load.

namespace condyle {

/// Options of a request for the pressure of layers, with their defaults.
struct LoadRequest {
  Pose X_FM = Pose::Identity();
  /// The mobile body is moved from X_FM to the pose in which the contact carries this; default: it stays.
  std::optional<contact::Load> load = {};
  contact::BalanceOptions balance = {};
  motion::BodyNames names = {};  ///< as notes call the bodies
  const motion::RangeOfMotion* limits =
      nullptr;  ///< limits_of_poses(), by which the pose is judged; null: it is not
  /// Depths of the surfaces along arcs too, at the pose of the answer.
  std::optional<contact::ArcsAbout> about = {};
  CoordinateSystem system = {};  ///< of the joint, for an angle's axis
};

/// The pose requested, or the balanced one.
struct LoadAnswer {
  Pose X_FM = Pose::Identity();
  contact::ElasticContactResults contact = {};
  std::optional<contact::BalancedPose> balanced = {};  ///< if a load was requested
  std::size_t cut_off_by_reach = 0;                    ///< rays
  std::optional<Vec3> refined_force_n = {};            ///< ElasticContact::refined_force_n() at X_FM
  std::vector<LigamentAlong> ligaments = {};           ///< those of the request's balance, at X_FM
  std::vector<motion::ContactNote> notes = {};         ///< what looks wrong with layers, load and contact
  std::vector<std::string> caveats = {};               ///< what an elastic foundation leaves out
  std::optional<PoseStanding> standing = {};           ///< of X_FM
  std::optional<ArcDepths> arcs = {};                  ///< if requested

  /// False if a load was requested and no contact carries it: `balanced` has the reason, X_FM and the contact are
  /// those at which the search stopped, and the numbers mean nothing.
  [[nodiscard]] bool carries_load() const noexcept { return !balanced || balanced->carries_load(); }
};

/// Throws UsageError for a moment without free rotations, which nothing would balance.
void check_load_request(const LoadRequest& request);

/// Pressure at a pose, or at the pose that balances a load. Throws UsageError as check_load_request() and balance(), MeshError
/// as ElasticContact::at(). Costs two evaluations of the contact and sixteen rays for each triangle, and a balance ten more.
[[nodiscard]] LoadAnswer answer_load(const contact::ElasticContact& surfaces, const LoadRequest& request);

}  // namespace condyle
