#pragma once

#include <cstddef>

#include "condyle/contact.hpp"
#include "condyle/io/joint_file.hpp"

namespace condyle::python {

/// A joint as Python holds it: what its file or its description said, and what is asked of it.
struct JointHandle {
  io::LoadedJoint loaded;
  contact::JointContact contact;

  explicit JointHandle(io::LoadedJoint from) : loaded(std::move(from)), contact(loaded.joint) {}
  const Joint& joint() const noexcept { return loaded.joint; }
};

/// One of the three angles, by its position.
JointAngle angle_numbered(std::size_t number);

}  // namespace condyle::python
