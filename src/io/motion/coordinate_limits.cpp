#include "io/motion/coordinate_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/file/in_quotes.hpp"

namespace condyle::io {
namespace {

/// Degrees or mm. Models and motion files round their numbers, to seven digits at worst: 120 degrees are no more than 2.0943951.
constexpr double rounding_of_files = 1e-3;

/// How many frames depart from what is allowed, and by how much.
struct Departures {
  std::size_t frames = 0;
  double largest = 0;

  void add(double beyond) {
    if (!(beyond > rounding_of_files)) return;
    ++frames;
    largest = std::max(largest, beyond);
  }
  std::string text(std::size_t of) const {
    return fmt::format("in {} of {} frames by up to {:.4g}", frames, of, largest);
  }
};

void add_item(std::string& list, const std::string& item) {
  list += (list.empty() ? "" : "; ") + item;
}

}  // namespace

void BeyondLimits::check(const CoordinateLimits& limits, std::span<const double> values) {
  const char* unit = limits.kind == CoordinateKind::angle ? "degrees" : "mm";
  Departures from_range, from_lock;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    if (limits.range) from_range.add(std::max(limits.range->front() - value, value - limits.range->back()));
    if (limits.locked_at) from_lock.add(std::abs(value - *limits.locked_at));
  }
  if (from_range.frames > 0)
    add_item(beyond_,
             fmt::format("{}, {:.6g} to {:.6g} {}, {}", in_quotes(limits.name), limits.range->front(),
                         limits.range->back(), unit, from_range.text(values.size())));
  if (from_lock.frames > 0)
    add_item(unlocked_, fmt::format("{}, at {:.6g} {}, {}", in_quotes(limits.name), *limits.locked_at + 0.0,
                                    unit, from_lock.text(values.size())));
}

std::vector<motion::ContactNote> BeyondLimits::notes() const {
  std::vector<motion::ContactNote> notes;
  if (!beyond_.empty())
    notes.push_back(
        {motion::ContactNoteCode::beyond_range,
         fmt::format("coordinates leave the ranges that the model gives them, and are used as they are: {}",
                     beyond_)});
  if (!unlocked_.empty())
    notes.push_back(
        {motion::ContactNoteCode::locked_coordinate,
         fmt::format("coordinates that the model locks have other values, and are used as they are: {}",
                     unlocked_)});
  return notes;
}

}  // namespace condyle::io
