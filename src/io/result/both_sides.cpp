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
#include "io/result/parameters.hpp"
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

bool ends_on_cut(const motion::MotionLimit& limit) {
  return limit.end.reason == motion::LimitReason::contact && limit.end.kind() == motion::ContactKind::cut;
}

/// Where contact of bones ended the motion: neither a range that ends without it nor the cut of an image is a limit.
std::optional<double> limit_deg(const motion::MotionLimit& limit) {
  if (limit.translation_ends || limit.end.reason == motion::LimitReason::end_of_range || ends_on_cut(limit))
    return std::nullopt;
  return limit.end.turned.degrees();
}

std::optional<double> difference_deg(const RomResult& left, const RomResult& right, const Pair& pair) {
  const auto of_left = limit_deg(left.answer.limits[pair.left]),
             of_right = limit_deg(right.answer.limits[pair.right]);
  if (!of_left || !of_right) return std::nullopt;
  return *of_left - *of_right;
}

std::string side_words(const RangeAnswer& answer, std::size_t i) {
  return ends_on_cut(answer.limits[i]) ? "cut of image" : limit_words(answer, i);
}

/// Lines of provenance, each with whose it is.
std::string comments_of(const char* side, const RomResult& result) {
  std::string comments = provenance_comments(result.provenance, result.notes);
  for (std::size_t at = 0; at < comments.size(); at = comments.find('\n', at) + 1)
    if (comments[at] == '#') comments.replace(at, 1, std::string("# ") + side);
  return comments;
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
    columns[1].cells.push_back(side_words(left.answer, pair.left));
    columns[2].cells.push_back(side_words(right.answer, pair.right));
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
  std::string unknown;
  for (const RomResult* side : {&left, &right})
    if (!zero_pose(side->joint).is_neutral())
      unknown += fmt::format("{}{}", unknown.empty() ? "" : " and ", name_of(side->joint.side));
  std::string whose;
  for (const RomResult* side : {&left, &right})
    if (const std::string text = whose_text(side->joint); !text.empty())
      whose += std::string(name_of(side->joint.side)) + text + "\n";
  return whose + table_text(columns) +
         (arcs.empty() ? "" : wrapped(fmt::format("  total arcs (deg), left and right:{}\n", arcs))) +
         (unknown.empty()
              ? ""
              : wrapped(fmt::format("  zero is not known to be neutral, {}: how the leg lay is in "
                                    "differences of single motions, and not in those of arcs\n",
                                    unknown))) +
         wrapped(fmt::format("  {}\n", scope_text(left.joint)));
}

std::string both_sides_csv(const RomResult& left, const RomResult& right) {
  std::string text = comments_of("left", left) + comments_of("right", right) +
                     csv_line({"motion", "left_deg", "left_p5_deg", "left_p95_deg", "right_deg",
                               "right_p5_deg", "right_p95_deg", "difference_deg"});
  const auto number = [](std::optional<double> value) {
    return value ? fmt::format("{}", *value) : std::string();
  };
  for (const Pair& pair : pairs_of(left.answer, right.answer)) {
    std::vector<std::string> cells{left.answer.limits[pair.left].motion.name};
    const auto add = [&](const RangeAnswer& answer, std::size_t i) {
      cells.push_back(number(limit_deg(answer.limits[i])));
      const bool has_band = !answer.bands.empty() && limit_deg(answer.limits[i]);
      cells.push_back(has_band ? number(degrees_turned(answer.bands[i].p5, answer.limits[i].motion)) : "");
      cells.push_back(has_band ? number(degrees_turned(answer.bands[i].p95, answer.limits[i].motion)) : "");
    };
    add(left.answer, pair.left);
    add(right.answer, pair.right);
    cells.push_back(number(difference_deg(left, right, pair)));
    text += csv_line(cells);
  }
  return text;
}

}  // namespace condyle::io
