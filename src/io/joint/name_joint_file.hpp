#pragma once

#include <string>

#include "condyle/error.hpp"
#include "condyle/range_of_motion.hpp"

namespace condyle::io {

/// Result of `answer` for a joint that was read. The library's errors name bodies, which many files may have: a
/// MeshError of `answer` leaves with `place` before it, the joint file or the line of a table.
template <class Answer>
auto name_joint_file(const std::string& place, const Answer& answer) {
  try {
    return answer();
  } catch (const motion::ReferenceContactError& error) {
    throw motion::ReferenceContactError(place + ": " + error.what());
  } catch (const MeshError& error) {
    throw MeshError(place + ": " + error.what());
  }
}

}  // namespace condyle::io
