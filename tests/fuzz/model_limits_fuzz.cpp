#include <algorithm>
#include <cmath>
#include <vector>

#include "condyle/error.hpp"
#include "condyle/io/model_file.hpp"
#include "fuzz/one_line.hpp"
#include "fuzz/targets.hpp"
#include "io/model/model_limits.hpp"

namespace condyle::test {
namespace {

constexpr std::string_view limits_model = "some.osim", comment = "<!--\n# condyle_version: 0\n-->\n";

/// Every coordinate has its ends, and nothing else that is read has changed.
std::string fault_of(const io::Model& before, const io::Model& after, const io::ModelJoint& joint) {
  if (after.joints.size() != before.joints.size()) return "another number of joints";
  for (std::size_t i = 0; i < after.joints.size(); ++i) {
    const io::ModelJoint &was = before.joints[i], &is = after.joints[i];
    if (is.name != was.name || is.coordinates.size() != was.coordinates.size() ||
        (is.transform == nullptr) != (was.transform == nullptr))
      return "another joint";
    if (is.defaults() != was.defaults()) return "other defaults";
    if (is.name != joint.name) continue;
    for (const io::ModelCoordinate& coordinate : is.coordinates) {
      if (!coordinate.range || !coordinate.is_clamped)
        return "a coordinate without the range that was written";
      const auto [low, high] = *coordinate.range;
      if (std::abs(low + 10.5 * two_pi / 360) > 1e-12 || std::abs(high - 20.25 * two_pi / 360) > 1e-12)
        return "another range than was written";
    }
  }
  return {};
}

}  // namespace

std::string fuzz_model_limits(std::string_view bytes) {
  if (bytes.empty()) return {};
  const auto stop = bytes[0] % 2 == 0 ? io::StopForce::limit : io::StopForce::linear;
  const std::string_view text = bytes.substr(1);
  std::string written;
  try {
    const io::Model before = io::read_model(text, limits_model);
    const auto joint =
        std::find_if(before.joints.begin(), before.joints.end(), [](const io::ModelJoint& each) {
          return each.transform && !each.name.empty() && !each.coordinates.empty();
        });
    if (joint == before.joints.end()) return {};
    std::vector<io::CoordinateRange> ranges;
    for (const io::ModelCoordinate& coordinate : joint->coordinates)
      ranges.push_back({coordinate.name, -10.5, 20.25});
    written = io::with_limits(text, limits_model, joint->name, ranges, stop, comment);
    try {
      if (auto fault = fault_of(before, io::read_model(written, limits_model), *joint); !fault.empty())
        return fault;
      if (io::with_limits(written, limits_model, joint->name, ranges, stop, comment) != written)
        return "another text where the same limits are written again";
    } catch (const FileError& error) {
      return std::string("a model that is none any more: ") + error.what();
    }
  } catch (const FileError& error) {
    return fault_of_message(error.what(), std::string(limits_model) + ": ");
  }
  return {};
}

}  // namespace condyle::test
