#include <type_traits>
#include <variant>

#include "condyle/hip_measures.hpp"
#include "condyle/make_joint.hpp"
#include "core/formatted.hpp"

namespace condyle::measure {
namespace {

/// A joint file without landmarks says how the scanner's axes lie, and nothing of how the pelvis lay in them.
constexpr const char* not_stated = "as scanned";

}  // namespace

std::string pelvis_frame_of(const FrameDescription& frame) {
  return std::visit(
      [](const auto& axes) -> std::string {
        using Axes = std::decay_t<decltype(axes)>;
        if constexpr (std::is_same_v<Axes, AnteriorPelvicPlane>) return "anterior pelvic plane";
        if constexpr (std::is_same_v<Axes, PelvisLandmarks>) return "plane of ASIS and PSIS";
        if constexpr (std::is_same_v<Axes, FemurLandmarks>) return "the femur's epicondyles, not the pelvis";
        return {};
      },
      frame.axes);
}

std::string stated_frame(const HipMeasures& measures) {
  const std::string frame = measures.pelvis_frame.empty() ? not_stated : measures.pelvis_frame;
  if (measures.pelvic_tilt == Angle()) return frame;
  return frame + core::formatted(", tilt %g deg given", measures.pelvic_tilt.degrees());
}

}  // namespace condyle::measure
