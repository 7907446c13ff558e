#include "io/image/hips_of_labels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <utility>

#include "condyle/error.hpp"
#include "io/image/label_name.hpp"
#include "mesh/label_surface/voxel_pieces.hpp"

namespace condyle::io {
namespace {

constexpr std::array<std::string_view, 11> pelvis_words = {
    "hip",  "hip bone", "pelvis",     "pelvic bone", "hemipelvis", "innominate", "innominate bone",
    "coxa", "os coxae", "coxal bone", "hipbone"};
constexpr std::array<std::string_view, 5> femur_words = {"femur", "proximal femur", "femur proximal",
                                                         "femoral bone", "thigh bone"};

/// A label that may be a bone.
struct Named {
  std::string label;  ///< as choose_label() takes it
  std::optional<Side> side;
};

/// A name in lower case without its words for the side: "hip bone" of "Right_Hip_Bone".
std::string without_side(std::string_view name) {
  std::string bone, word;
  const auto end_word = [&] {
    if (!word.empty() && word != "left" && word != "right" && word != "l" && word != "r")
      bone += (bone.empty() ? "" : " ") + word;
    word.clear();
  };
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else
      end_word();
  }
  end_word();
  return bone;
}

/// The labels that have voxels and one of these names, or the one that was chosen.
std::vector<Named> labels_called(const LabelMap& map, std::span<const LabelSummary> present,
                                 std::span<const std::string_view> words, const std::string& chosen,
                                 std::optional<LabelTask> task) {
  if (!chosen.empty()) return {{chosen, side_in_name(choose_label(map, chosen, task).name)}};
  std::vector<Named> found;
  for (const LabelSummary& summary : present) {
    const std::string name = name_of_label(map, summary.layer, summary.label, task);
    if (std::find(words.begin(), words.end(), without_side(name)) != words.end())
      found.push_back({name, side_in_name(name)});
  }
  return found;
}

/// The label for a side: that of the side, else the only one without a side. Null if there is none.
const Named* for_side(std::span<const Named> labels, std::optional<Side> side, std::string_view file,
                      std::string_view what) {
  for (const auto& wanted : {side, std::optional<Side>()}) {
    std::vector<const Named*> found;
    for (const Named& each : labels)
      if (each.side == wanted || !side) found.push_back(&each);
    if (found.size() > 1)
      throw UsageError(fmt::format("{}: {} and {} are both a {}: --fixed and --mobile say which is meant",
                                   file, found[0]->label, found[1]->label, what));
    if (!found.empty()) return found.front();
  }
  return nullptr;
}

}  // namespace

bool is_of_both_sides(const LabelMap& map, const std::string& label, std::optional<LabelTask> task) {
  ChosenLabel chosen;
  if (label.empty()) {
    for (const LabelSummary& summary : summaries_of(map))
      if (summary.label != 0) chosen.layer = summary.layer, chosen.label = summary.label;
  } else {
    chosen = choose_label(map, label, task);
  }
  VoxelMask mask = mask_of(map, chosen);
  mesh::VoxelBox box{mask.size, std::move(mask.inside)};
  const mesh::KeptBone kept = mesh::keep_bone(box, map.grid.X_WI, std::nullopt);
  return std::any_of(kept.left_out.begin(), kept.left_out.end(),
                     [](const mesh::LeftOutPiece& piece) { return piece.is_other_side; });
}

/// "; --task total would name 76 femur_right, 78 hip_right": of the tables of TotalSegmentator those by which the map has a hip.
std::string fitting_tables(const LabelMap& map, std::span<const LabelSummary> present) {
  std::string text;
  for (const LabelTask task : {LabelTask::total, LabelTask::total_v1, LabelTask::total_mr}) {
    const auto pelves = labels_called(map, present, pelvis_words, "", task),
               femora = labels_called(map, present, femur_words, "", task);
    if (pelves.empty() || femora.empty()) continue;
    text += fmt::format("; --task {} would name {} and {}", name_of(task), femora.front().label,
                        pelves.front().label);
  }
  return text;
}

LabelHips hips_in(const LabelMap& map, std::string_view file, const HipLabels& wanted) {
  const std::vector<LabelSummary> present = summaries_of(map);
  const auto called = [&](std::span<const std::string_view> words, const std::string& chosen,
                          std::string_view what) {
    auto found = labels_called(map, present, words, chosen, wanted.task);
    if (found.empty())
      throw UsageError(
          fmt::format("no label is called a {}{}: {}{}; --fixed and --mobile take numbers", what,
                      wanted.task ? fmt::format(" in TotalSegmentator's {}", name_of(*wanted.task)) : "",
                      labels_there(map), fitting_tables(map, present)));
    return found;
  };
  std::vector<Named> pelves, femora;
  try {
    pelves = called(pelvis_words, wanted.fixed, "hip bone or pelvis");
    femora = called(femur_words, wanted.mobile, "femur");
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{}: {}", file, error.what()));
  }
  LabelHips found;
  const auto add = [&](const Named& femur, std::optional<Side> side, bool is_of_both, bool by_piece) {
    if (wanted.side && side && side != wanted.side) return;
    const Named* pelvis = for_side(pelves, side, file, "hip bone or pelvis");
    if (!pelvis) return found.left_out.push_back(femur.label + ": no hip bone or pelvis of its side");
    if (femur.side && is_of_both)
      found.left_out.push_back(femur.label + ": the other of its two large pieces");
    for (const LabelHip& other : found.hips)
      if (other.side == side || !side || !other.side)
        throw UsageError(
            fmt::format("{}: {} and {} are femora of one side, or have none in their names: "
                        "--fixed and --mobile say which is meant",
                        file, other.mobile, femur.label));
    found.hips.push_back({pelvis->label, femur.label, side ? side : pelvis->side, by_piece});
  };
  for (const Named& femur : femora) {
    const bool is_of_both = is_of_both_sides(map, femur.label, wanted.task);
    if (femur.side || !is_of_both) {
      add(femur, femur.side ? femur.side : wanted.side, is_of_both, false);
    } else {
      add(femur, Side::left, true, true);
      add(femur, Side::right, true, true);
    }
  }
  for (const Named& pelvis : pelves)
    if (std::none_of(found.hips.begin(), found.hips.end(),
                     [&](const LabelHip& hip) { return hip.fixed == pelvis.label; }) &&
        (!wanted.side || !pelvis.side || pelvis.side == wanted.side))
      found.left_out.push_back(pelvis.label + ": no femur of its side");
  if (found.hips.empty())
    throw UsageError(fmt::format("{}: no femur and hip bone are of one side{}", file,
                                 wanted.side ? fmt::format(", the {}", name_of(*wanted.side)) : ""));
  std::stable_sort(found.hips.begin(), found.hips.end(), [](const LabelHip& a, const LabelHip& b) {
    return a.side == Side::left && b.side == Side::right;
  });
  return found;
}

}  // namespace condyle::io
