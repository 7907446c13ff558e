#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <span>

#include "condyle/answer/range.hpp"
#include "io/result/rom_result.hpp"
#include "joint.hpp"

/// Ranges of motion between Python and the layer that answers.

namespace condyle::python {

namespace py = pybind11;

/// A range of motion as Python holds it: what was asked, and the answer, whose tables answer further questions. What a translation follows
/// is not kept.
struct RangeHandle {
  Case asked;
  RangeRequest request;
  RangeAnswer answer;

  io::RomResult result() const { return io::rom_result_of(answer, {}, nullptr); }
};

/// Reads `count_bearing` and `bearing_margin_mm`, which Python has checked.
motion::BearingOptions bearing_in(const py::dict& given);

/// Reads what band_of() of Python gives: None, or samples, seed and three standard deviations, each None if it is left open.
std::optional<BandRequest> band_in(const py::object& given);

/// answer_range() of a joint, which Ctrl-C ends.
std::unique_ptr<RangeHandle> answered_range(const JointHandle& handle, RangeRequest request,
                                            const py::object& progress);
/// further_answer() of what `beside` requests, with the options of the range; likewise.
RangeAnswer further_answered(const RangeHandle& handle, RangeRequest beside, const py::object& progress);

/// What rom_json() says, its motions as limits_of() has them, under `limits`.
py::dict answer_dict(const io::RomResult& result);
/// dict_of() of each limit, and under `said` what rom_json() says of it.
py::list limits_of(const io::RomResult& result);
py::list limits_of(const Joint& joint, std::span<const motion::MotionLimit> limits);

}  // namespace condyle::python
