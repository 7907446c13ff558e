#include "io/study/study_joint.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "condyle/error.hpp"
#include "condyle/io/label_file.hpp"
#include "condyle/joint_checks.hpp"
#include "condyle/sample/hip.hpp"
#include "core/one_line.hpp"
#include "io/file/in_quotes.hpp"
#include "io/file/input_file.hpp"
#include "io/joint/load_joint.hpp"
#include "io/mesh/parse.hpp"
#include "io/model/model_joint_file.hpp"

namespace condyle::io {
namespace {

/// Where a row's joint comes from.
enum class JointSource { joint_file, meshes, labels, model, sample };

JointSource source_of(const StudyTable& table, const StudyRow& row) {
  const auto has = [&](std::string_view column) { return !table.field(row, column).empty(); };
  const bool meshes = has("fixed") && has("mobile"), one_mesh = has("fixed") != has("mobile");
  if (!one_mesh && has("joint") + meshes + has("labels") + has("opensim_model") + has("sample") == 1)
    return has("joint")           ? JointSource::joint_file
           : meshes               ? JointSource::meshes
           : has("labels")        ? JointSource::labels
           : has("opensim_model") ? JointSource::model
                                  : JointSource::sample;
  throw FileError(
      fmt::format("{}: line {}: a row needs joint, or fixed and mobile, or labels, or opensim_model, or "
                  "sample, and only one of them",
                  table.path.string(), row.line));
}

std::filesystem::path path_in(const StudyTable& table, const StudyRow& row, std::string_view column) {
  return table.path.parent_path() / std::filesystem::path(table.field(row, column));
}

/// Line and column are named if the file is not there: the table may be what is wrong.
std::filesystem::path file_in(const StudyTable& table, const StudyRow& row, std::string_view column) {
  std::filesystem::path path = path_in(table, row, column);
  if (!why_no_file(path).empty())
    throw FileError(
        fmt::format("{}: {}: no such file", table.place(row, column), core::one_line(path.string(), 300)));
  return path;
}

/// The value that goes with a word, spelt as in a joint file; the first one where the field is empty.
template <class Value, std::size_t count>
Value one_of(const StudyTable& table, const StudyRow& row, std::string_view column,
             const std::pair<std::string_view, Value> (&choices)[count]) {
  const std::string_view word = table.field(row, column);
  if (word.empty()) return choices[0].second;
  std::string names;
  for (const auto& [name, value] : choices) {
    if (name == word) return value;
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  throw FileError(fmt::format("{}: {} is none of {}", table.place(row, column), in_quotes(word), names));
}

Side side_of(const StudyTable& table, const StudyRow& row) {
  static constexpr std::pair<std::string_view, Side> sides[] = {{"right", Side::right}, {"left", Side::left}};
  return one_of(table, row, "side", sides);
}

/// The row's entries in place of a joint file.
JointFile described(const StudyTable& table, const StudyRow& row) {
  static constexpr std::pair<std::string_view, LengthUnit> units[] = {{"mm", LengthUnit::millimetres},
                                                                      {"cm", LengthUnit::centimetres},
                                                                      {"in", LengthUnit::inches},
                                                                      {"m", LengthUnit::metres}};
  static const std::pair<std::string_view, FrameDirections> axes[] = {
      {"joint", {}}, {"RAS", ras_axes}, {"LPS", lps_axes}};
  if (table.field(row, "side").empty())
    throw FileError(fmt::format("{}: right or left is needed beside meshes", table.place(row, "side")));
  JointFile file{.path = table.path, .joint = {}, .fixed = {}, .mobile = {}, .motions = {}};
  file.joint.name = table.id(row);
  file.joint.side = side_of(table, row);
  file.joint.units = one_of(table, row, "units", units);
  file.joint.frame.centre = CentreFit{};
  file.joint.frame.axes = one_of(table, row, "axes", axes);
  file.fixed = {"fixed", {{"", path_in(table, row, "fixed"), {}}}};
  file.mobile = {"mobile", {{"", path_in(table, row, "mobile"), {}}}};
  return file;
}

double measure_in(const StudyTable& table, const StudyRow& row, std::string_view column) {
  double value;
  if (!parse_number(table.field(row, column), value))
    throw FileError(
        fmt::format("{}: {} is no number", table.place(row, column), in_quotes(table.field(row, column))));
  return value;
}

/// What the row says of whose joint it is.
void set_person(Person& person, const StudyTable& table, const StudyRow& row) {
  for (const std::string_view column : {"age", "age_years"})
    if (const std::string_view age = table.field(row, column); !age.empty()) {
      person.age_years = measure_in(table, row, column);
      if (!is_age(*person.age_years))
        throw FileError(
            fmt::format("{}: {} is none of 0 to 120 years", table.place(row, column), in_quotes(age)));
    }
  static constexpr std::pair<std::string_view, Sex> sexes[] = {{"female", Sex::female}, {"male", Sex::male},
                                                               {"f", Sex::female},      {"m", Sex::male},
                                                               {"F", Sex::female},      {"M", Sex::male}};
  if (!table.field(row, "sex").empty()) person.sex = one_of(table, row, "sex", sexes);
  if (const std::string_view species = table.field(row, "species"); !species.empty())
    person.species = species;
}

LoadedJoint made(const StudyTable& table, const StudyRow& row) {
  static constexpr std::pair<std::string_view, sample::Scenario> scenarios[] = {
      {"1", sample::Scenario::one},
      {"2", sample::Scenario::two},
      {"3", sample::Scenario::three},
      {"4", sample::Scenario::four}};
  const sample::Scenario scenario = one_of(table, row, "sample", scenarios);
  sample::HipParameters measures;
  for (const sample::HipMeasure& measure : sample::hip_measures())
    if (!table.field(row, measure.name).empty()) measure.set(measures, measure_in(table, row, measure.name));
  JointFile file{.path = table.path, .joint = {}, .fixed = {}, .mobile = {}, .motions = {}};
  file.joint.name = table.id(row);
  file.joint.side = side_of(table, row);
  file.joint.zero_from = ZeroFrom::stated;  // sample bones are in neutral
  try {
    sample::SampleHip hip = sample::sample_hip(measures, scenario);
    if (file.joint.side == Side::left) hip = sample::mirrored(hip);
    PlacedJoint placed =
        make_joint(file.joint, {"hip bone", std::move(hip.hip_bone)}, {"femur", std::move(hip.femur)});
    return {std::move(placed.joint), {std::move(file), {}, {}, std::move(placed.placement), {}}};
  } catch (const UsageError& error) {
    throw FileError(fmt::format("{}: line {}: {}", table.path.string(), row.line, error.what()));
  }
}

/// The joint that condyle init proposes for two bones of a label map.
StudyJoint segmented(const StudyTable& table, const StudyRow& row) {
  static constexpr std::pair<std::string_view, std::optional<LabelTask>> tasks[] = {
      {"", std::nullopt},
      {"total", LabelTask::total},
      {"total_v1", LabelTask::total_v1},
      {"total_mr", LabelTask::total_mr}};
  const std::filesystem::path labels = file_in(table, row, "labels");
  const auto bone = [&](std::string_view column) {
    if (table.field(row, column).empty())
      throw FileError(fmt::format("{}: a label is needed beside labels", table.place(row, column)));
    return LabelBoneRequest{std::string(table.field(row, column)), one_of(table, row, "task", tasks)};
  };
  LabelJointRequest request{.labels = labels,
                            .fixed = bone("fixed_label"),
                            .mobile = bone("mobile_label"),
                            .joint_file = table.path};
  if (!table.field(row, "side").empty()) request.side = side_of(table, row);
  const std::string where = fmt::format("{}: line {}", table.path.string(), row.line);
  try {
    LabelJoint found = propose_joint(request);
    if (!found.proposal.to_fill_in.empty())
      throw UsageError("not inferred: " + found.proposal.to_fill_in.front());
    JointFile file{.path = table.path, .joint = {}, .fixed = {}, .mobile = {}, .motions = {}};
    file.joint.name = table.id(row);
    file.joint.side = *found.proposal.side;
    file.joint.frame.centre = CentreFit{};
    file.joint.frame.axes = lps_axes;
    const auto body = [](LabelBone& of) { return Body{of.name, std::move(of.surface.mesh), {}, of.image}; };
    const auto report = [&](const LabelBone& of) {
      return BodyMeshReport{"", labels, of.surface.mesh.vertices.size(), of.surface.mesh.triangles.size(),
                            0,  {}};
    };
    JointReport joint_report{std::move(file), {report(found.fixed)}, {report(found.mobile)}, {}, {}};
    PlacedJoint placed = make_joint(joint_report.file.joint, body(found.fixed), body(found.mobile));
    joint_report.placement = std::move(placed.placement);
    std::vector<std::string> codes;
    for (const LabelNote& note : found.notes)
      if (note.code != LabelNoteCode::cut_by_view && !image_note_code(name_of(note.code)))
        codes.emplace_back(name_of(note.code));
    return {{std::move(placed.joint), std::move(joint_report)}, std::move(codes)};
  } catch (const UsageError& error) {
    throw FileError(fmt::format("{}: {}", where, error.what()));
  } catch (const MeshError& error) {
    throw MeshError(fmt::format("{}: {}", where, error.what()));
  }
}

/// The joint file that condyle init proposes for a joint of a model.
JointFileOfModel of_model(const StudyTable& table, const StudyRow& row) {
  const std::filesystem::path path = file_in(table, row, "opensim_model");
  ModelJointRequest request{.joint = std::string(table.field(row, "opensim_joint")), .joint_file = {}};
  if (request.joint.empty())
    throw FileError(
        fmt::format("{}: a joint is needed beside opensim_model", table.place(row, "opensim_joint")));
  if (!table.field(row, "side").empty()) request.side = side_of(table, row);
  try {
    return joint_file_of(read_model(path), request);
  } catch (const UsageError& error) {
    throw FileError(fmt::format("{}: line {}: {}", table.path.string(), row.line, error.what()));
  }
}

StudyJoint joint_of_model(const StudyTable& table, const StudyRow& row) {
  JointFileOfModel proposed = of_model(table, row);
  std::vector<std::string> codes;
  for (const ModelNote& note : proposed.notes)
    if (note.code != ModelNoteCode::not_used && note.code != ModelNoteCode::welded)
      codes.emplace_back(name_of(note.code));
  codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
  return {load_joint(std::move(proposed.file)), std::move(codes)};
}

StudyJoint joint_as_described(const StudyTable& table, const StudyRow& row) {
  switch (source_of(table, row)) {
    case JointSource::joint_file:
      return {read_joint(file_in(table, row, "joint"))};
    case JointSource::meshes: {
      JointFile file = described(table, row);
      for (const char* body : {"fixed", "mobile"}) file_in(table, row, body);
      return {load_joint(std::move(file))};
    }
    case JointSource::labels:
      return segmented(table, row);
    case JointSource::model:
      return joint_of_model(table, row);
    case JointSource::sample:
      break;
  }
  return {made(table, row)};
}

}  // namespace

StudyJoint load_joint(const StudyTable& table, const StudyRow& row) {
  StudyJoint joint = joint_as_described(table, row);
  set_person(joint.loaded.joint.person, table, row);
  const std::string_view values = table.field(row, "parameters");
  if (values.empty()) return joint;
  try {
    joint.loaded = with_parameters(joint.loaded, parse_parameters(values));
  } catch (const UsageError& error) {
    throw FileError(fmt::format("{}: {}", table.place(row, "parameters"), error.what()));
  }
  return joint;
}

std::string place_of(const StudyTable& table, const StudyRow& row) {
  if (source_of(table, row) == JointSource::joint_file) return path_in(table, row, "joint").string();
  return fmt::format("{}: line {}", table.path.string(), row.line);
}

bool is_sample(const StudyTable& table, const StudyRow& row) {
  return source_of(table, row) == JointSource::sample;
}

std::filesystem::path followed_file(const StudyTable& table, const StudyRow& row) {
  return table.field(row, "follow").empty() ? std::filesystem::path() : path_in(table, row, "follow");
}

std::vector<std::filesystem::path> files_of(const StudyTable& table, const StudyRow& row) {
  std::vector<std::filesystem::path> files;
  for (const std::string_view column : {"joint", "fixed", "mobile", "labels", "opensim_model", "follow"})
    if (!table.field(row, column).empty()) files.push_back(path_in(table, row, column));
  if (table.field(row, "joint").empty()) return files;
  try {
    const auto of_joint = files_of(read_joint_file(path_in(table, row, "joint")));
    files.insert(files.end(), of_joint.begin(), of_joint.end());
  } catch (const FileError&) {
    // the row will be a failure
  }
  return files;
}

}  // namespace condyle::io
