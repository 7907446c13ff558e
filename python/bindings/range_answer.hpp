#pragma once

#include <pybind11/pybind11.h>

#include <span>

#include "condyle/answer.hpp"
#include "io/result/rom_result.hpp"
#include "joint.hpp"

/// Ranges of motion between Python and the layer that answers.

namespace condyle::python {

namespace py = pybind11;

/// A range of motion as Python holds it: what was asked, and the answer, whose tables answer further questions.
struct RangeHandle {
  RangeRequest request;
  RangeAnswer answer;

  /// The options with the bearing surface that was found, for what is asked beyond the limits.
  motion::RangeOptions options() const {
    motion::RangeOptions options = request.range;
    options.bearing.surface = answer.bearing.surface;
    return options;
  }
  io::RomResult result() const { return io::rom_result_of(answer, {}, nullptr); }
};

/// Reads `count_bearing` and `bearing_margin_mm`, which Python has checked.
motion::BearingOptions bearing_in(const py::dict& given);

/// answer_range() of a joint, which Ctrl-C ends.
RangeAnswer answered_range(const JointHandle& handle, const RangeRequest& request,
                           const py::object& progress);

/// What rom_json() says, its motions as limits_of() has them, under `limits`.
py::dict answer_dict(const io::RomResult& result);
/// dict_of() of each limit, and under `said` what rom_json() says of it.
py::list limits_of(const io::RomResult& result);
py::list limits_of(const Joint& joint, std::span<const motion::MotionLimit> limits);

}  // namespace condyle::python
