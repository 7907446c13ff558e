#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <span>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/io/label_file.hpp"
#include "core/near_name.hpp"
#include "io/file/in_quotes.hpp"
#include "io/image/label_name.hpp"
#include "io/mesh/parse.hpp"

namespace condyle::io {
namespace {

struct TableEntry {
  std::uint32_t label;
  std::string_view name;
};

/// The bones of the hip in the class maps of TotalSegmentator (totalsegmentator/map_to_binary.py), and three structures of
/// version 2 that have the numbers of version 1's bones: those make a closed, plausible, wrong body.
constexpr TableEntry total_table[] = {{25, "sacrum"},          {75, "femur_left"}, {76, "femur_right"},
                                      {77, "hip_left"},        {78, "hip_right"},  {88, "iliopsoas_left"},
                                      {89, "iliopsoas_right"}, {90, "brain"}};
constexpr TableEntry total_v1_table[] = {
    {88, "femur_left"}, {89, "femur_right"}, {90, "hip_left"}, {91, "hip_right"}, {92, "sacrum"}};
constexpr TableEntry total_mr_table[] = {
    {18, "sacrum"}, {36, "femur_left"}, {37, "femur_right"}, {38, "hip_left"}, {39, "hip_right"}};

std::span<const TableEntry> table_of(LabelTask task) noexcept {
  switch (task) {
    case LabelTask::total_v1:
      return total_v1_table;
    case LabelTask::total_mr:
      return total_mr_table;
    case LabelTask::total:
      break;
  }
  return total_table;
}

constexpr std::array all_tasks = {LabelTask::total, LabelTask::total_v1, LabelTask::total_mr};

/// In lower case, blanks as '_'.
std::string plain_name(std::string_view name) {
  std::string out = io::lower_case(name);
  std::replace_if(out.begin(), out.end(), io::is_space, '_');
  return out;
}

std::string_view table_name(LabelTask task, std::uint32_t label) noexcept {
  for (const auto& entry : table_of(task))
    if (entry.label == label) return entry.name;
  return {};
}

const LabelSegment* segment_at(const LabelMap& map, std::size_t layer, std::uint32_t label) noexcept {
  for (const auto& segment : map.segments)
    if (segment.layer == layer && segment.label == label) return &segment;
  return nullptr;
}

std::string name_in_file(const LabelMap& map, std::size_t layer, std::uint32_t label) {
  const LabelSegment* segment = segment_at(map, layer, label);
  return segment ? segment->name : std::string();
}

/// Words of a list for a message: the first ones, and how many more there are.
std::string listed(const std::vector<std::string>& words) {
  constexpr std::size_t most = 12;
  std::string out;
  for (std::size_t i = 0; i < std::min(words.size(), most); ++i) out += (i ? ", " : "") + words[i];
  return words.size() > most ? fmt::format("{} and {} more", out, words.size() - most) : out;
}

/// Layers in which some voxel has the label.
std::vector<std::size_t> layers_with(const LabelMap& map, std::uint32_t label) {
  std::vector<std::size_t> layers;
  const auto found = std::lower_bound(map.labels.begin(), map.labels.end(), label);
  if (found == map.labels.end() || *found != label) return layers;
  const auto index = static_cast<std::uint16_t>(found - map.labels.begin());
  for (std::size_t layer = 0; layer < map.layers.size(); ++layer)
    if (std::find(map.layers[layer].begin(), map.layers[layer].end(), index) != map.layers[layer].end())
      layers.push_back(layer);
  return layers;
}

/// The names that the file and every table give to a number.
LabelNote tables_note(const LabelMap& map, std::size_t layer, std::uint32_t label) {
  std::vector<std::string> words;
  if (const auto name = name_in_file(map, layer, label); !name.empty())
    words.push_back(fmt::format("{} in the file", io::in_quotes(name)));
  for (const auto task : all_tasks)
    if (const auto name = table_name(task, label); !name.empty())
      words.push_back(fmt::format("{} in TotalSegmentator's {}", name, name_of(task)));
  return {LabelNoteCode::label_tables,
          words.empty()
              ? fmt::format("Label {} is taken as given: neither the file nor a known table names it.", label)
              : fmt::format("Label {} is taken as given: it is {}.", label, listed(words))};
}

/// "75" or "1:75".
struct NumberedLabel {
  std::optional<std::size_t> layer;
  std::uint32_t label = 0;
};

std::optional<NumberedLabel> numbered(std::string_view text) {
  NumberedLabel number;
  const auto is_number = [](std::string_view word, auto& value) {
    return !word.starts_with('+') && io::parse_number(word, value);
  };
  const auto colon = text.find(':');
  if (colon != std::string_view::npos && !is_number(text.substr(0, colon), number.layer.emplace()))
    return std::nullopt;
  const auto label = colon == std::string_view::npos ? text : text.substr(colon + 1);
  if (!is_number(label, number.label)) return std::nullopt;
  return number;
}

ChosenLabel choose_number(const LabelMap& map, const NumberedLabel& number,
                          std::optional<LabelTask> task = {}) {
  const auto layers = layers_with(map, number.label);
  if (layers.empty())
    throw UsageError(fmt::format("no voxel has the label {}: {}", number.label, labels_there(map)));
  std::size_t layer = layers.front();
  if (number.layer) {
    layer = *number.layer;
    if (layer >= map.layers.size())
      throw UsageError(
          fmt::format("no layer {}: the image has {}, counted from 0", layer, map.layers.size()));
    if (std::find(layers.begin(), layers.end(), layer) == layers.end())
      throw UsageError(fmt::format("no voxel of layer {} has the label {}", layer, number.label));
  } else if (layers.size() > 1) {
    std::vector<std::string> words;
    for (const auto each : layers) words.push_back(fmt::format("{}:{}", each, number.label));
    throw UsageError(
        fmt::format("the label {} is in several layers: choose one of {}", number.label, listed(words)));
  }
  std::string name = name_of_label(map, layer, number.label, task);
  if (task && !name.empty()) return {layer, number.label, std::move(name), {}};
  return {layer, number.label, std::move(name), {tables_note(map, layer, number.label)}};
}

/// The segments whose name or id is this, by a comparison. A segment in the list twice counts once.
template <class Same>
std::vector<const LabelSegment*> segments_called(const LabelMap& map, Same&& same) {
  std::vector<const LabelSegment*> found;
  std::set<std::pair<std::size_t, std::uint32_t>> known;
  for (const auto& segment : map.segments)
    if ((same(segment.name) || same(segment.id)) && known.emplace(segment.layer, segment.label).second)
      found.push_back(&segment);
  return found;
}

/// The one segment of the name, nothing if there is none.
const LabelSegment* named_segment(const LabelMap& map, std::string_view text) {
  auto found = segments_called(map, [&](const std::string& name) { return !name.empty() && name == text; });
  if (found.empty())
    found = segments_called(map, [&, plain = plain_name(text)](const std::string& name) {
      return !name.empty() && plain_name(name) == plain;
    });
  if (found.size() > 1) {
    std::vector<std::string> words;
    for (const auto* segment : found) words.push_back(fmt::format("{}:{}", segment->layer, segment->label));
    throw UsageError(fmt::format("{} is the name of several labels: choose one of {}", io::in_quotes(text),
                                 listed(words)));
  }
  return found.empty() ? nullptr : found.front();
}

const TableEntry* table_entry(std::optional<LabelTask> task, std::string_view text) {
  if (!task) return nullptr;
  const auto table = table_of(*task);
  const std::string plain = plain_name(text);
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const TableEntry& entry) { return entry.name == plain; });
  return found == table.end() ? nullptr : &*found;
}

ChosenLabel choose_table_entry(const LabelMap& map, const TableEntry& entry, LabelTask task) {
  for (const auto& segment : map.segments) {
    if (segment.label != entry.label || segment.name.empty()) continue;
    throw UsageError(fmt::format("{} is {} in TotalSegmentator's {}, which the file calls {}", entry.name,
                                 entry.label, name_of(task), io::in_quotes(segment.name)));
  }
  auto chosen = choose_number(map, {std::nullopt, entry.label});
  chosen.name = entry.name;
  chosen.notes.clear();
  return chosen;
}

[[noreturn]] void refuse_name(const LabelMap& map, std::string_view text, std::optional<LabelTask> task) {
  std::vector<std::string> names, quoted;
  for (const auto& segment : map.segments) {
    if (segment.name.empty()) continue;
    names.push_back(segment.name);
    quoted.push_back(io::in_quotes(segment.name));
  }
  if (task) {
    for (const auto& entry : table_of(*task)) {
      names.emplace_back(entry.name);
      quoted.push_back(io::in_quotes(entry.name));
    }
  }
  if (names.empty())
    throw UsageError(
        fmt::format("{}: the file names no labels: choose a number, or say of which task the names are; {}",
                    io::in_quotes(text), labels_there(map)));
  throw UsageError(fmt::format("no label is called {}{}: there are {}", io::in_quotes(text),
                               core::did_you_mean(text, names), listed(quoted)));
}

}  // namespace

std::string labels_there(const LabelMap& map) {
  std::vector<std::string> words;
  for (const auto label : map.labels)
    if (label != 0) words.push_back(fmt::format("{}", label));
  return words.empty() ? "the image holds no label other than 0" : "the image holds " + listed(words);
}

std::string name_of_label(const LabelMap& map, std::size_t layer, std::uint32_t label,
                          std::optional<LabelTask> task) {
  std::string name = name_in_file(map, layer, label);
  return name.empty() && task ? std::string(table_name(*task, label)) : name;
}

std::string_view name_of(LabelTask task) noexcept {
  constexpr std::string_view names[] = {"total", "total_v1", "total_mr"};
  static_assert(std::size(names) == static_cast<std::size_t>(LabelTask::total_mr) + 1);
  return names[static_cast<std::size_t>(task)];
}

std::optional<LabelTask> label_task_of(std::string_view word) noexcept {
  for (const auto task : all_tasks)
    if (name_of(task) == word) return task;
  return std::nullopt;
}

ChosenLabel choose_label(const LabelMap& map, std::string_view text, std::optional<LabelTask> task) {
  if (const auto comma = text.find(','); comma != text.npos && !named_segment(map, text)) {
    ChosenLabel first = choose_label(map, text.substr(0, comma), task),
                rest = choose_label(map, text.substr(comma + 1), task);
    if (!first.name.empty() && !rest.name.empty()) first.name += "_" + rest.name;
    first.notes.insert(first.notes.end(), rest.notes.begin(), rest.notes.end());
    first.also = std::exchange(rest.also, {});
    first.also.push_back(std::move(rest));
    return first;
  }
  const auto number = numbered(text);
  const LabelSegment* segment = named_segment(map, text);
  if (number) {
    // A segment may be called "2" and have the label 1: which of both is meant cannot be known.
    if (segment && (segment->label != number->label || (number->layer && *number->layer != segment->layer)))
      throw UsageError(
          fmt::format("{} is a number and also the name of the label {}:{}: give its layer and label instead",
                      io::in_quotes(text), segment->layer, segment->label));
    return choose_number(map, *number, task);
  }
  if (segment) {
    if (const TableEntry* entry = table_entry(task, text); entry && entry->label != segment->label)
      throw UsageError(fmt::format("{} is {} in TotalSegmentator's {}, but {} in the file",
                                   io::in_quotes(text), entry->label, name_of(*task), segment->label));
    return {segment->layer, segment->label, segment->name, {}};
  }
  if (const TableEntry* entry = table_entry(task, text)) return choose_table_entry(map, *entry, *task);
  refuse_name(map, text, task);
}

}  // namespace condyle::io
