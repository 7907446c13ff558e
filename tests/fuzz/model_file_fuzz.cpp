#include <algorithm>

#include "condyle/error.hpp"
#include "condyle/io/model_file.hpp"
#include "fuzz/one_line.hpp"
#include "fuzz/targets.hpp"
#include "io/joint/load_joint.hpp"

namespace condyle::test {
namespace {

constexpr std::string_view model_name = "some.osim";
constexpr std::size_t most_joints = 8;

/// A pose of a joint's defaults is a rotation and a place, whatever its functions are; numbers beyond a double's are not
/// held to anything.
std::string fault_of_pose(const io::ModelJoint& joint) {
  const Pose X = io::pose_of(joint, joint.defaults());
  if (!X.matrix().allFinite()) return {};
  const Eigen::Matrix3d R = X.linear();
  const double skew = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return skew < 1e-9 ? "" : "a pose that is no rotation";
}

/// Every proposal is a joint file.
std::string fault_of_proposal(const io::Model& model, const io::ModelJoint& joint) {
  io::ModelJointProposal proposed;
  try {
    proposed = io::propose_joint(
        model,
        {.joint = joint.name, .joint_file = "joint.toml", .anatomy = Anatomy::knee, .side = Side::right});
  } catch (const FileError& error) {
    return fault_of_message(error.what(), std::string(model_name) + ": ");
  } catch (const UsageError& error) {
    return fault_of_message(error.what());
  }
  for (const io::ModelNote& note : proposed.notes)
    if (auto fault = fault_of_message(io::to_text(note)); !fault.empty()) return fault;
  if (!proposed.proposal.to_fill_in.empty()) return {};
  try {
    io::joint_file_of(proposed.proposal.toml, "joint.toml");
  } catch (const FileError& error) {
    return std::string("a proposal that is no joint file: ") + error.what();
  }
  return {};
}

std::string fault_of(const io::Model& model) {
  for (std::size_t i = 0; i < std::min(model.joints.size(), most_joints); ++i) {
    const io::ModelJoint& joint = model.joints[i];
    if (!joint.transform) {
      if (auto fault = fault_of_message(joint.why_not, std::string(model_name) + ": "); !fault.empty())
        return fault;
      continue;
    }
    if (auto fault = fault_of_pose(joint); !fault.empty()) return fault;
    if (auto fault = fault_of_proposal(model, joint); !fault.empty()) return fault;
  }
  return {};
}

}  // namespace

std::string fuzz_model_file(std::string_view bytes) {
  try {
    return fault_of(io::read_model(bytes, model_name));
  } catch (const FileError& error) {
    return fault_of_message(error.what(), std::string(model_name) + ": ");
  }
}

}  // namespace condyle::test
