#include "page_labels.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "condyle/error.hpp"
#include "condyle/io/label_file.hpp"
#include "io/file/in_quotes.hpp"
#include "io/image/joint_bones.hpp"
#include "io/image/label_input.hpp"
#include "io/result/json.hpp"
#include "kinematics/hip_axes.hpp"
#include "page_proposal.hpp"

using namespace condyle;

struct CondyleLabels {
  io::LabelMap map;
  PageFile file;
  std::string description = {};
};

struct CondyleBone {
  const CondyleLabels& of;
  io::LabelBoneRequest request;
  io::LabelBone bone;

  io::RequestedBone requested() const { return {of.map, of.file.name, request, bone}; }
};

namespace {

using io::Json;

/// Labels that a list for a person can have; TotalSegmentator's tasks have some hundred.
constexpr std::size_t most_labels = 1000;

std::string choice_of(const io::LabelMap& map, std::size_t layer, std::uint32_t label) {
  return map.layers.size() > 1 ? fmt::format("{}:{}", layer, label) : fmt::format("{}", label);
}

std::string name_in_file(const io::LabelMap& map, const io::LabelSummary& summary) {
  for (const io::LabelSegment& segment : map.segments)
    if (segment.layer == summary.layer && segment.label == summary.label) return segment.name;
  return {};
}

Json labels_json(const CondyleLabels& labels) {
  const io::LabelMap& map = labels.map;
  if (map.labels.size() > most_labels)
    throw UsageError(fmt::format("{}: {} different values: a label map of bones has at most {}",
                                 labels.file.name, map.labels.size(), most_labels));
  Json list = Json::array();
  for (const io::LabelSummary& summary : io::summaries_of(map))
    if (summary.label != 0)
      list.push_back({{"choice", choice_of(map, summary.layer, summary.label)},
                      {"name", name_in_file(map, summary)},
                      {"voxels", summary.voxels}});
  if (list.empty()) throw MeshError(labels.file.name + ": no voxel has a label above 0");
  return list;
}

/// Null where the name finds no label, as the command line chooses it.
Json chosen_json(const io::LabelMap& map, const std::string& name, const std::optional<io::LabelTask>& task) {
  try {
    const io::ChosenLabel chosen = io::choose_label(map, name, task);
    return {{"label", name}, {"choice", choice_of(map, chosen.layer, chosen.label)}};
  } catch (const UsageError&) {
    return nullptr;
  }
}

Json pairs_json(const io::LabelMap& map) {
  constexpr std::array<std::optional<io::LabelTask>, 4> tasks{
      std::nullopt, io::LabelTask::total, io::LabelTask::total_v1, io::LabelTask::total_mr};
  Json pairs = Json::array();
  for (const auto& task : tasks) {
    if (task && !map.segments.empty()) break;  // numbers of a file with names of its own are none of a table
    for (const char* side : {"right", "left"}) {
      Json fixed = chosen_json(map, fmt::format("hip_{}", side), task);
      Json mobile = chosen_json(map, fmt::format("femur_{}", side), task);
      if (fixed.is_null() || mobile.is_null()) continue;
      pairs.push_back({{"side", side},
                       {"task", task ? Json(name_of(*task)) : Json(nullptr)},
                       {"fixed", std::move(fixed)},
                       {"mobile", std::move(mobile)}});
    }
  }
  return pairs;
}

/// The side that is stated, else that of the bones; refused, one line in all, where they contradict it or speak for none.
Side agreed_side(const std::optional<io::Stated<Side>>& stated, const kinematics::SideInAxes& of_bones) {
  const auto refuse = [&](const std::string& why) {
    throw UsageError(fmt::format("side: {}; {}", why, fmt::join(of_bones.evidence, "; ")));
  };
  if (!stated && !of_bones.side) refuse("the bones do not speak for one side");
  if (stated && of_bones.side && stated->value != *of_bones.side)
    refuse(fmt::format("{} it is {}, and the bones lie as those of a {} hip", stated->by,
                       name_of(stated->value), name_of(*of_bones.side)));
  return stated ? stated->value : *of_bones.side;
}

/// As a joint file is read, whose normals are scaled to unit length.
Body body_of(const io::LabelBone& bone) {
  Body body{bone.name, bone.surface.mesh};
  body.image = bone.image;
  for (ImageCut& cut : body.image->cuts) cut.normal.normalize();
  return body;
}

void add_origin(const io::ImagedBone& imaged, std::vector<std::string>& lines) {
  for (const std::string& line : io::origin_of(imaged.bone, imaged.file))
    lines.push_back(fmt::format("{}: {}", imaged.bone.name, line));
}

CondyleJoint* joined(const CondyleBone& fixed, const CondyleBone& mobile, const std::optional<Side>& given) {
  io::RequestedBone of_fixed = fixed.requested(), of_mobile = mobile.requested();
  io::take_pieces_of_joint(of_fixed, of_mobile, given, {});
  std::vector<io::LabelNote> notes = io::record_notes(of_fixed, of_mobile);
  const io::LabelBone &hip_bone = of_fixed.bone, &femur = of_mobile.bone;
  const io::ImagedBone imaged_fixed{of_fixed.map, of_fixed.file, hip_bone},
      imaged_mobile{of_mobile.map, of_mobile.file, femur};
  io::check_are_two(imaged_fixed, imaged_mobile);
  const auto stated = io::stated_side(given, hip_bone, femur);
  const auto hip = hip_of(hip_bone.surface.mesh, femur.surface.mesh);
  const auto of_bones = kinematics::side_in(lps_axes, hip);
  JointDescription description{
      .name = "dropped joint", .side = agreed_side(stated, of_bones), .units = LengthUnit::millimetres};
  description.frame.axes = lps_axes;

  PageProposal proposal{.inferred = head_evidence(hip)};
  proposal.inferred.push_back(
      fmt::format("side: {}{}", name_of(description.side), stated ? fmt::format(", {}", stated->by) : ""));
  proposal.inferred.push_back("axes: LPS, by the image's header");
  add_origin(imaged_fixed, proposal.inferred);
  add_origin(imaged_mobile, proposal.inferred);
  proposal.inferred.insert(proposal.inferred.end(), of_bones.evidence.begin(), of_bones.evidence.end());
  proposal.of_images = std::move(notes);
  proposal.fixed = fixed.of.file, proposal.mobile = mobile.of.file;
  proposal.fixed_name = hip_bone.name, proposal.mobile_name = femur.name;
  return joint_of(std::move(description), body_of(hip_bone), body_of(femur), std::move(proposal));
}

}  // namespace

// Bytes that were dropped have no folder in which other files could be.
io::ByteSource io::LabelInput::open_data(std::string_view key, const std::filesystem::path& named) const {
  header.fail(fmt::format("{}: the data lie in another file, {}", key, in_quotes(named.string())));
}

CondyleLabels* condyle_read_labels(const char* name, const std::uint8_t* bytes, int count) {
  return guarded(static_cast<CondyleLabels*>(nullptr), [&] {
    const std::string_view contents(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
    const auto format = io::label_format_of(name);
    if (!format) throw FileError(std::string(name) + ": its ending is none of a label map");
    return new CondyleLabels{io::read_labels(contents, *format, name), {name, io::digest_of(contents)}};
  });
}

void condyle_free_labels(CondyleLabels* labels) {
  delete labels;
}

const char* condyle_labels(CondyleLabels* labels) {
  return guarded(static_cast<const char*>(nullptr), [&] {
    const Json json{{"labels", labels_json(*labels)}, {"pairs", pairs_json(labels->map)}};
    labels->description = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    return labels->description.c_str();
  });
}

CondyleBone* condyle_bone(const CondyleLabels* labels, const char* label, const char* task) {
  return guarded(static_cast<CondyleBone*>(nullptr), [&] {
    io::LabelBoneRequest request{.label = label, .task = io::label_task_of(task)};
    io::LabelBone bone = io::bone_of(labels->map, labels->file.name, request);
    return new CondyleBone{*labels, std::move(request), std::move(bone)};
  });
}

void condyle_free_bone(CondyleBone* bone) {
  delete bone;
}

const char* condyle_bone_name(const CondyleBone* bone) {
  return bone->bone.name.c_str();
}

CondyleJoint* condyle_join(const CondyleBone* fixed, const CondyleBone* mobile, int side) {
  return guarded(static_cast<CondyleJoint*>(nullptr),
                 [&] { return joined(*fixed, *mobile, given_side(side)); });
}
