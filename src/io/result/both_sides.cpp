#include "io/result/both_sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "condyle/joint_checks.hpp"
#include "io/file/csv_fields.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/rom_parts.hpp"
#include "io/result/scope_text.hpp"
#include "io/result/text_table.hpp"

namespace condyle::io {
namespace {

/// A motion of both joints, as indices of their limits.
struct Pair {
  std::size_t left, right;
};

std::vector<Pair> pairs_of(const RangeAnswer& left, const RangeAnswer& right) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < left.limits.size(); ++i)
    for (std::size_t j = 0; j < right.limits.size(); ++j)
      if (left.limits[i].motion.name == right.limits[j].motion.name) pairs.push_back({i, j});
  return pairs;
}

/// Where contact ended the motion; a range that ends without it is no limit.
std::optional<double> limit_deg(const motion::MotionLimit& limit) {
  if (limit.translation_ends || limit.end.reason == motion::LimitReason::end_of_range) return std::nullopt;
  return limit.end.turned.degrees();
}

std::optional<double> difference_deg(const RomResult& left, const RomResult& right, const Pair& pair) {
  const auto of_left = limit_deg(left.answer.limits[pair.left]),
             of_right = limit_deg(right.answer.limits[pair.right]);
  if (!of_left || !of_right) return std::nullopt;
  return *of_left - *of_right;
}

/// "+5.3", and "+0.0" of less than a twentieth.
std::string difference_words(double degrees) {
  return fmt::format("{:+.1f}", std::round(10 * degrees) / 10 + 0.0);
}

}  // namespace

std::string both_sides_text(const RomResult& left, const RomResult& right) {
  std::array columns{TextColumn{Align::left, {"motion"}}, TextColumn{Align::right, {"left (deg)"}},
                     TextColumn{Align::right, {"right (deg)"}}, TextColumn{Align::right, {"left - right"}}};
  for (const Pair& pair : pairs_of(left.answer, right.answer)) {
    const auto difference = difference_deg(left, right, pair);
    columns[0].cells.push_back(left.answer.limits[pair.left].motion.name);
    columns[1].cells.push_back(limit_words(left.answer, pair.left));
    columns[2].cells.push_back(limit_words(right.answer, pair.right));
    columns[3].cells.push_back(difference ? difference_words(*difference) : "-");
  }
  std::string arcs;
  for (const OppositeLimits& of_left : opposite_limits(left.answer.limits))
    for (const OppositeLimits& of_right : opposite_limits(right.answer.limits))
      if (of_left.one->motion.name == of_right.one->motion.name &&
          of_left.other->motion.name == of_right.other->motion.name)
        arcs += fmt::format("{} {} to {} {:.1f} and {:.1f} ({})", arcs.empty() ? "" : ",",
                            of_left.one->motion.name, of_left.other->motion.name, of_left.arc().degrees(),
                            of_right.arc().degrees(),
                            difference_words(of_left.arc().degrees() - of_right.arc().degrees()));
  const bool are_neutral = zero_pose(left.joint).is_neutral() && zero_pose(right.joint).is_neutral();
  return table_text(columns) +
         (arcs.empty() ? "" : wrapped(fmt::format("  total arcs (deg), left and right:{}\n", arcs))) +
         (are_neutral ? ""
                      : wrapped("  zero is not known to be neutral on both sides: how the legs lay is in the "
                                "differences of single motions, and not in those of arcs\n")) +
         wrapped(fmt::format("  {}\n", scope_text(left.joint)));
}

std::string both_sides_csv(const RomResult& left, const RomResult& right) {
  std::string text = provenance_comments(left.provenance) + provenance_comments(right.provenance) +
                     csv_line({"motion", "left_deg", "left_p5_deg", "left_p95_deg", "right_deg",
                               "right_p5_deg", "right_p95_deg", "difference_deg"});
  const auto number = [](std::optional<double> value) {
    return value ? fmt::format("{}", *value) : std::string();
  };
  for (const Pair& pair : pairs_of(left.answer, right.answer)) {
    std::vector<std::string> cells{left.answer.limits[pair.left].motion.name};
    const auto add = [&](const RangeAnswer& answer, std::size_t i) {
      cells.push_back(number(limit_deg(answer.limits[i])));
      const bool has_band = !answer.bands.empty();
      cells.push_back(has_band ? fmt::format("{}", answer.bands[i].p5.degrees()) : "");
      cells.push_back(has_band ? fmt::format("{}", answer.bands[i].p95.degrees()) : "");
    };
    add(left.answer, pair.left);
    add(right.answer, pair.right);
    cells.push_back(number(difference_deg(left, right, pair)));
    text += csv_line(cells);
  }
  return text;
}

}  // namespace condyle::io
