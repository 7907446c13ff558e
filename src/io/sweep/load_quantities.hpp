#pragma once

#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/study.hpp"

namespace condyle::io {

/// Pressure of each design at a pose, or at the pose that balances a force: the largest and the mean one, the area that carries it, of the
/// surface that is cast; of the mobile body's if both are. FileError if the joint has no layers.
SweepQuantities load_quantities(const LoadedJoint& loaded, const StudyLoad& load);

}  // namespace condyle::io
