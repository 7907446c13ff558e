#include "io/result/limit_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <variant>

#include "condyle/error.hpp"
#include "condyle/io/model_file.hpp"
#include "core/lower_case.hpp"
#include "io/file/csv_fields.hpp"
#include "io/file/in_quotes.hpp"
#include "io/file/output_file.hpp"
#include "io/file/whole_file.hpp"
#include "io/file/xml_escaped.hpp"
#include "io/model/joint_mapping.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/text_table.hpp"

namespace condyle::io {
namespace {

std::string ending_of(const LimitFile& file) {
  return core::lower_case(file.path.extension().string());
}

/// Joint and coordinate that a column names: "/jointset/hip_r/hip_flexion_r/value", "hip_r/hip_flexion_r", "hip_flexion_r".
std::pair<std::string, std::string> names_in(std::string_view column) {
  if (column.ends_with("/value")) column.remove_suffix(std::string_view("/value").size());
  const std::size_t last = column.rfind('/');
  if (last == column.npos) return {"", std::string(column)};
  const std::string_view before = column.substr(0, last);
  return {std::string(before.substr(before.rfind('/') + 1)), std::string(column.substr(last + 1))};
}

/// The columns of the joint file; null without.
const std::vector<ColumnOfCoordinate>* columns_of(const LoadedJoint& joint) {
  const auto& mapping = joint.report.file.recorded_motion;
  return mapping ? std::get_if<std::vector<ColumnOfCoordinate>>(&*mapping) : nullptr;
}

std::string numbers_text(const std::vector<double>& values) {
  std::vector<std::string> words;
  for (const double value : values) words.push_back(fmt::format("{:.2f}", value));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Whose an end is.
std::string words_of(const BoxEndRecord& end) {
  if (end.source == LimitSource::living) return fmt::format("living, bone {:.2f}", end.bony_deg);
  if (end.source == LimitSource::ligament) return "ligament";
  return end.reason == motion::LimitReason::contact ? "bony" : "no contact";
}

std::string error_text(const LimitBoxRecord& box) {
  if (!box.error) return "  no other coordinate changes these limits\n";
  const BoxErrorRecord& error = *box.error;
  const auto at = [](const std::optional<std::vector<double>>& values) {
    return values ? fmt::format(", at {}", numbers_text(*values)) : std::string();
  };
  std::string text = fmt::format(
      "  limits are coupled: of {} points of a map {} are within these. A pose within them is past what is "
      "free "
      "by up to {:.2f} deg{}. Free poses are past them by up to {:.2f} deg{}\n",
      error.points, error.points_in_box, error.beyond_deg, at(error.beyond_at_deg), error.forbidden_deg,
      at(error.forbidden_at_deg));
  if (error.points_without_free > 0)
    text += fmt::format("  at {} points within them nothing is free\n", error.points_without_free);
  return wrapped(text);
}

/// A comment of XML, which two hyphens would end.
std::string xml_comment(std::string text) {
  for (std::size_t at = 0; (at = text.find("--", at)) != text.npos;) text.replace(at, 2, "- -");
  return fmt::format("<!--\n{}-->\n", text);
}

std::vector<CoordinateRange> ranges_of(const LimitBoxRecord& box) {
  std::vector<CoordinateRange> ranges;
  for (const BoxSideRecord& side : box.coordinates)
    ranges.push_back({side.coordinate, side.lower.limit_deg, side.upper.limit_deg});
  return ranges;
}

std::string opensim_fragment(const std::vector<CoordinateRange>& ranges, StopForce stop,
                             const std::string& comment) {
  std::string forces, coordinates;
  for (const CoordinateRange& range : ranges) {
    forces += force_element(range, stop);
    coordinates +=
        fmt::format("<Coordinate name=\"{}\"><range>{}</range><clamped>true</clamped></Coordinate>\n",
                    xml_escaped(range.coordinate), range_text(range));
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<OpenSimDocument Version=\"40000\">\n{}"
      "<ForceSet name=\"forceset\"><objects>\n{}</objects></ForceSet>\n"
      "<CoordinateSet><objects>\n{}</objects></CoordinateSet>\n</OpenSimDocument>\n",
      comment, forces, coordinates);
}

/// Joints in the order of the joint's rotations, to be included in the element of the mobile body.
std::string mujoco_fragment(const LimitBoxRecord& box, const Joint& joint, const std::string& comment) {
  std::string text = comment;
  for (const BoxSideRecord& side : box.coordinates) {
    const Vec3 axis = (side.sign * axis_of(side.angle, joint.coordinates(), {})).array() + 0.0;  // no -0
    const std::string ref =
        side.offset_deg == 0 ? "" : fmt::format(" ref=\"{}\"", -side.sign * side.offset_deg);
    text += fmt::format(
        "<joint name=\"{}\" type=\"hinge\" axis=\"{} {} {}\"{} limited=\"true\" range=\"{} {}\"/>\n",
        xml_escaped(side.coordinate), axis.x(), axis.y(), axis.z(), ref, side.lower.limit_deg,
        side.upper.limit_deg);
  }
  return "<mujocoinclude>\n" + text + "</mujocoinclude>\n";
}

/// The copy of the model. Throws as with_limits().
std::string model_text(const LimitFile& file, const LoadedJoint& joint,
                       const std::vector<CoordinateRange>& ranges, const std::string& comment) {
  return with_limits(read_whole_file(*file.model), *file.model,
                     names_in(columns_of(joint)->front().column).first, ranges, file.stop, comment);
}

/// A copy of a model whose coordinates have another sense or zero would have ends that mean another pose.
void require_same_meaning(const std::filesystem::path& path, const LoadedJoint& joint) {
  const std::vector<ColumnOfCoordinate>& columns = *columns_of(joint);
  const auto [name, first] = names_in(columns.front().column);
  const Model model = read_model(path);
  const auto is_of = [&, name = name, first = first](const ModelJoint& each) {
    return name.empty() ? std::any_of(each.coordinates.begin(), each.coordinates.end(),
                                      [&](const ModelCoordinate& its) { return its.name == first; })
                        : each.name == name;
  };
  const auto of_model = std::find_if(model.joints.begin(), model.joints.end(), is_of);
  if (of_model == model.joints.end()) return;  // with_limits() says so
  const std::vector<ColumnOfCoordinate> its =
      mapping_of(StandingModel(model), *of_model,
                 joint.joint.names_its_joint() ? std::optional(joint.joint.anatomy) : std::nullopt,
                 joint.joint.side)
          .columns;
  constexpr double rounding_deg = 1e-9;
  for (const ColumnOfCoordinate& ours : columns) {
    if (ours.kind != CoordinateKind::angle) continue;
    const std::string coordinate = names_in(ours.column).second;
    const auto theirs = std::find_if(its.begin(), its.end(), [&](const ColumnOfCoordinate& each) {
      return names_in(each.column).second == coordinate;
    });
    if (theirs == its.end() || theirs->coordinate != ours.coordinate || theirs->sign != ours.sign ||
        !(std::abs(theirs->offset - ours.offset) < rounding_deg))
      throw FileError(
          fmt::format("{}: coordinate {} turns the joint otherwise than the joint file says: make it "
                      "anew from this model",
                      path.string(), in_quotes(coordinate)));
  }
}

const BoxSideRecord& side_of(const LimitBoxRecord& box, JointAngle angle) {
  return *std::find_if(box.coordinates.begin(), box.coordinates.end(),
                       [&](const BoxSideRecord& side) { return side.angle == angle; });
}

/// The free interval of each point of the map, as the coordinates have it.
std::string coupled_limits(const LimitBoxRecord& box) {
  const motion::MotionMap& map = *box.map;
  const BoxSideRecord &column = side_of(box, map.grid.column.angle), &row = side_of(box, map.grid.row.angle),
                      &varied = side_of(box, map.grid.vary);
  const auto value = [](const BoxSideRecord& side, double angle_deg) {
    return side.sign * (angle_deg - side.offset_deg) + 0.0;  // no -0
  };
  std::string text = csv_field(column.coordinate + "_deg") + "," + csv_field(row.coordinate + "_deg");
  for (const char* of_end : {"_lower_deg", "_upper_deg", "_lower_reason", "_upper_reason"})
    text += "," + csv_field(varied.coordinate + of_end);
  text += "\n";
  const std::size_t columns = map.grid.column.count();
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    text += fmt::format("{},{}", value(column, map.grid.column.value_deg(i % columns)),
                        value(row, map.grid.row.value_deg(i / columns)));
    const motion::FreeInterval* free = map.points[i].nearest_to_start();
    if (!free) {
      text += ",,,,\n";
      continue;
    }
    std::array ends{std::pair(value(varied, (map.grid.start + free->low).degrees()), free->at_low.reason),
                    std::pair(value(varied, (map.grid.start + free->high).degrees()), free->at_high.reason)};
    if (varied.sign < 0) std::swap(ends[0], ends[1]);
    text += fmt::format(",{},{},{},{}\n", ends[0].first, ends[1].first, name_of(ends[0].second),
                        name_of(ends[1].second));
  }
  return text;
}

}  // namespace

std::vector<TurningCoordinate> limit_coordinates(const LoadedJoint& joint, const LimitFile& file,
                                                 const Provenance* from) {
  const std::string ending = ending_of(file);
  if (ending != ".osim" && ending != ".xml" && ending != ".csv")
    throw UsageError(file.path.string() +
                     ": limits are written as .osim, .xml of MuJoCo or .csv of coupled limits");
  if (file.model && ending != ".osim")
    throw UsageError(file.path.string() + ": a copy of a model is an .osim");
  if (file.model && core::lower_case(file.model->extension().string()) != ".osim")
    throw UsageError(file.model->string() +
                     ": is no model of OpenSim: --model takes the .osim that the joint is of");
  if (file.stop == StopForce::linear && ending != ".osim")
    throw UsageError(file.path.string() + ": a linear stop is of an .osim");
  if (file.source == LimitSource::living && ending == ".csv")
    throw UsageError(file.path.string() +
                     ": coupled limits are those of bone: write the living ones as .osim or .xml");
  if (ending == ".csv" && joint.joint.kind == JointKind::hinge)
    throw UsageError("the limits of a hinge are not coupled: write .osim or .xml");
  std::vector<std::filesystem::path> read;
  for (const std::filesystem::path& each : files_read(from)) read.push_back(each);
  if (file.model) read.push_back(*file.model);
  check_output_file(file.path, read);
  std::vector<TurningCoordinate> coordinates;
  if (const auto* columns = columns_of(joint)) {
    for (const ColumnOfCoordinate& column : *columns)
      if (column.kind == CoordinateKind::angle)
        coordinates.push_back({names_in(column.column).second,
                               joint_angle_named(column.coordinate, joint.joint.anatomy), column.sign,
                               column.offset});
    std::vector<CoordinateRange> ranges;
    for (const TurningCoordinate& each : coordinates) ranges.push_back({each.name, 0, 0});
    if (file.model) {
      (void)model_text(file, joint, ranges, "");
      require_same_meaning(*file.model, joint);
    }
    return coordinates;
  }
  if (ending == ".osim" && joint.report.file.recorded_motion)
    throw UsageError(
        "the model poses this joint by its functions: its coordinates have no limits each by itself");
  if (ending == ".osim")
    throw UsageError("no model was read into this joint: make it by condyle init MODEL.osim --joint NAME");
  for (const JointAngle angle : all_joint_angles)
    if (joint.joint.kind != JointKind::hinge || angle == JointAngle::flexion)
      coordinates.push_back({std::string(name_of(angle, joint.joint.anatomy)), angle});
  return coordinates;
}

std::string limit_box_text(const LimitBoxRecord& box) {
  TextColumn name{Align::left, {"coordinate"}}, lower{Align::right, {"lower (deg)"}},
      of_lower{Align::left, {""}}, upper{Align::right, {"upper (deg)"}}, of_upper{Align::left, {""}};
  for (const BoxSideRecord& side : box.coordinates) {
    name.cells.push_back(side.coordinate);
    lower.cells.push_back(fmt::format("{:.2f}", side.lower.limit_deg));
    of_lower.cells.push_back(words_of(side.lower));
    upper.cells.push_back(fmt::format("{:.2f}", side.upper.limit_deg));
    of_upper.cells.push_back(words_of(side.upper));
  }
  std::string text = "limits of each coordinate by itself, the others at zero angles\n" +
                     table_text(std::array{name, lower, of_lower, upper, of_upper}) + error_text(box);
  if (const auto& held = box.held_translation_mm)
    text +=
        fmt::format("  with the translation held at {:g}, {:g}, {:g} mm\n", held->x(), held->y(), held->z());
  return text;
}

void write_limits(const LimitFile& file, const LimitBoxRecord& box, const LoadedJoint& joint,
                  const Provenance* from) {
  const std::string ending = ending_of(file), text = limit_box_text(box), sources = provenance_comments(from);
  if (ending == ".csv") {
    std::string comments;
    for (std::size_t at = 0, end; at < text.size(); at = end + 1)
      end = text.find('\n', at), comments += "# " + text.substr(at, end - at) + "\n";
    return write_output_file(file.path, sources + comments + coupled_limits(box));
  }
  if (ending == ".xml")
    return write_output_file(
        file.path,
        mujoco_fragment(box, joint.joint,
                        xml_comment(text +
                                    "range and ref are degrees, as of <compiler angle=\"degree\">; axes "
                                    "are those of the joint frame at zero angles\n" +
                                    sources)));
  const std::string comment = xml_comment(
      text + "CoordinateLimitForce has degrees, range and CoordinateLinearStopForce radians\n" + sources);
  const std::vector<CoordinateRange> ranges = ranges_of(box);
  if (!file.model) return write_output_file(file.path, opensim_fragment(ranges, file.stop, comment));
  write_output_file(file.path, model_text(file, joint, ranges, comment));
}

}  // namespace condyle::io
