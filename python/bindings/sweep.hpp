#pragma once

#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"

namespace condyle::python {

/// A sweep as Python holds it, for its files and for a report.
struct SweepHandle {
  io::LoadedJoint loaded;
  SweepRequest request;
  SweepAnswer answer;
};

}  // namespace condyle::python
