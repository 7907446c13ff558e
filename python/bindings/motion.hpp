#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "condyle/joint.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/motion_map.hpp"
#include "condyle/range_of_motion.hpp"
#include "joint.hpp"

namespace condyle::python {

namespace py = pybind11;

/// A joint made ready for motions, with what that needs to live on.
struct RangeHandle {
  Joint joint;                              ///< held at its translation
  std::optional<Vec3> held_translation_mm;  ///< of a free joint
  motion::RangeOptions options;
  motion::RangeOfMotion range;

  RangeHandle(const Joint& moving, const std::optional<Vec3>& translation, motion::RangeOptions given)
      : joint(held_at(moving, translation.value_or(Vec3::Zero()))),
        held_translation_mm(translation),
        options(std::move(given)),
        range(joint, options) {}
};

/// (name, vary, sense, start_deg, range_deg) of a motion, vary a position among the joint's angles, and back.
py::tuple tuple_of(const motion::Motion& motion);
motion::Motion motion_in(const py::tuple& given);
std::vector<motion::Motion> motions_in(const py::list& given);

/// Three angles in degrees.
JointAngles angles_in(const py::object& given, std::string_view name);

/// Motions computed at once, between two looks whether it was stopped: some ten milliseconds.
inline constexpr std::size_t motions_at_once = 16;
/// Hands on range.limits(motions) one after the other, until it is stopped.
void each_limit(const motion::RangeOfMotion& range, std::span<const motion::Motion> motions,
                const std::stop_token& stop, const std::function<void(motion::MotionLimit&&)>& use);

py::dict dict_of(const motion::Limit& limit);
py::dict dict_of(const motion::MotionLimit& limit);
py::object dict_of(const std::optional<motion::ContactWitness>& contact);

}  // namespace condyle::python
