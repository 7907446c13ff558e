#include <cmath>

#include "condyle/answer/depth.hpp"
#include "condyle/error.hpp"
#include "fuzz/brute_contact.hpp"
#include "fuzz/fuzz_input.hpp"
#include "fuzz/one_line.hpp"
#include "fuzz/targets.hpp"

namespace condyle::test {
namespace {

std::string fault_of(const TouchOverlap& overlap) {
  for (const auto& measure : {overlap.volume_mm3, overlap.fixed_area_mm2, overlap.mobile_area_mm2})
    if (measure && !(*measure >= -overlap.volume_error_mm3)) return "a measure below zero";
  for (const double again :
       {overlap.volume_error_mm3, overlap.fixed_covered_again_mm3, overlap.mobile_covered_again_mm3})
    if (std::isnan(again)) return "a measure that is not a number";
  return {};
}

std::string fault_of(const TouchAnswer& answer, const Mesh& fixed, const Mesh& mobile) {
  const Pose& X = answer.request.X_FM;
  const TriMesh plain = mobile.arrays(), placed = posed(X, plain);
  const bool meet = surfaces_meet(fixed, plain, X);
  if (meet != !answer.pairs.empty()) return "pairs that brute force does not find";
  if (meet && !answer.in_contact) return "surfaces that meet, and no contact";
  if (meet && answer.nearest) return "a gap between surfaces that meet";
  if (answer.inside && !answer.in_contact) return "a body inside the other, and no contact";
  if (answer.nearest && !(answer.nearest->distance_mm >= 0)) return "a gap that is none";
  if (answer.deepest && !(answer.deepest->depth_mm >= 0)) return "a depth that is none";
  if (answer.deepest && answer.depth_bound_mm && *answer.depth_bound_mm < answer.deepest->depth_mm)
    return "a depth past its bound";
  for (const FreeTranslation& free : answer.free) {
    if (!(free.distance_mm >= 0 && free.error_bound_mm >= 0)) return "a way out that is none";
    if (!answer.in_contact && free.distance_mm > 0) return "a way out of nothing";
  }
  for (const JointNote& note : answer.notes)
    if (auto fault = fault_of_message(note.text); !fault.empty()) return fault;
  return answer.overlap ? fault_of(*answer.overlap) : "";
}

}  // namespace

std::string fuzz_touch(std::string_view bytes) {
  FuzzInput input(bytes);
  try {
    const Mesh fixed = input.mesh(), mobile = input.mesh();
    TouchRequest request{.X_FM = input.pose()};
    if (input.below(2) == 1) request.along = {input.point()};
    if (input.below(2) == 1) request.centre = input.point();
    return fault_of(answer_touch(fixed, mobile, request), fixed, mobile);
  } catch (const MeshError& error) {
    return fault_of_message(error.what());
  } catch (const UsageError& error) {
    return fault_of_message(error.what());
  }
}

}  // namespace condyle::test
