#include <fmt/format.h>

#include <utility>

#include "io/file/in_quotes.hpp"
#include "io/file/plain_text.hpp"
#include "io/file/words.hpp"
#include "io/image/nrrd_header.hpp"
#include "io/mesh/parse.hpp"

namespace condyle::io {
namespace {

struct Segment {
  std::optional<std::uint32_t> label, layer;
  std::string name, id;
};

/// N of "SegmentN_Suffix" and the suffix; nothing for other keys, among them those of Segmentation_.
std::optional<std::pair<std::uint32_t, std::string_view>> segment_key(std::string_view key) {
  constexpr std::string_view prefix = "Segment";
  if (!key.starts_with(prefix)) return std::nullopt;
  key.remove_prefix(prefix.size());
  const auto end = key.find('_');
  std::uint32_t number = 0;
  if (end == std::string_view::npos || key.starts_with('+') || !parse_number(key.substr(0, end), number))
    return std::nullopt;
  return std::pair{number, key.substr(end + 1)};
}

}  // namespace

std::vector<LabelSegment> slicer_segments(const NrrdHeader& header, std::uint64_t layers) {
  std::map<std::uint32_t, Segment> by_number;
  for (const auto& [key, value] : header.pairs) {
    const auto parts = segment_key(key);
    if (!parts) continue;
    auto& [number, suffix] = *parts;
    const auto number_of_value = [&, &key = key, &value = value] {
      std::uint32_t read = 0;
      if (!parse_number(trimmed(value), read))
        header.fields.fail(in_quotes(key), fmt::format("{} is no whole number", in_quotes(value)));
      return read;
    };
    if (suffix == "Name") by_number[number].name = plain_text(value);
    if (suffix == "ID") by_number[number].id = plain_text(value);
    if (suffix == "LabelValue") by_number[number].label = number_of_value();
    if (suffix == "Layer") by_number[number].layer = number_of_value();
  }
  std::vector<LabelSegment> segments;
  for (auto& [number, segment] : by_number) {
    const bool is_old = !segment.label && !segment.layer;
    const std::uint32_t layer = is_old ? number : segment.layer.value_or(0);
    if (layer >= layers)
      header.fields.fail(fmt::format("Segment{}_Layer", number),
                         fmt::format("layer {} of an image with {}", layer, layers));
    segments.push_back({std::move(segment.name), std::move(segment.id), layer, segment.label.value_or(1)});
  }
  return segments;
}

}  // namespace condyle::io
