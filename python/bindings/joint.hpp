#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "condyle/answer/case.hpp"
#include "condyle/contact.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/make_joint.hpp"
#include "core/lazy.hpp"

namespace condyle::python {

/// A joint as Python holds it: what its file or its description said, and what is asked of it.
struct JointHandle {
  io::LoadedJoint loaded;
  contact::JointContact contact;
  core::Lazy<std::shared_ptr<const motion::RangeOfMotion>> kept_limits = {};

  explicit JointHandle(io::LoadedJoint from) : loaded(std::move(from)), contact(loaded.joint) {}
  const Joint& joint() const noexcept { return loaded.joint; }
  /// By which poses are judged.
  const motion::RangeOfMotion* limits() const {
    return kept_limits.get([&](auto& made) { made = limits_of_poses(joint()); }).get();
  }
};

/// One of the three angles, by its position.
JointAngle angle_numbered(std::size_t number);
/// The number of an angle, or the three numbers of an axis and, if there are more, three of a point.
contact::ArcsAbout about_in(const pybind11::object& given);

/// The description of a joint from the arguments of condyle.Joint, whose words were checked in Python. Lengths of the
/// dictionary are in mm.
JointDescription description_in(const pybind11::dict& given);

/// All of a joint as bytes, every number to the last bit, for pickle. They are read by the same version only.
std::string state_of(const io::LoadedJoint& joint);

/// The joint of such bytes. UsageError where they are of another version, or cut off.
io::LoadedJoint joint_of_state(std::string_view state);

}  // namespace condyle::python
