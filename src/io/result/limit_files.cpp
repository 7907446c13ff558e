#include "io/result/limit_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <numbers>
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
#include "io/motion/column_zero.hpp"
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
  if (end.reason != motion::LimitReason::contact) return "no contact";
  return end.source == LimitSource::bearing ? "bearing surface"
         : end.source == LimitSource::cut   ? "cut of the image"
                                            : "bony";
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

/// Joints in the order of the joint's rotations, about axes of the mobile body's own frame, for the element of that body.
std::string mujoco_fragment(const LimitFile& file, const LimitBoxRecord& box, const LoadedJoint& joint,
                            const std::string& comment) {
  const bool in_degrees = file.angles == AngleUnit::degrees;
  const auto angle = [&](double degrees) { return in_degrees ? degrees : degrees * std::numbers::pi / 180; };
  const auto words = [](const Vec3& v) {
    return fmt::format("{} {} {}", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);  // no -0
  };
  const BodyFrames frames = body_frames(joint);
  Pose at_zero = Pose::Identity();
  at_zero.translation() = box.held_translation_mm.value_or(Vec3::Zero());
  const Pose X_BM = inverted(frames.X_MB), X_AB = inverted(frames.X_FA) * at_zero * frames.X_MB;
  const Eigen::Quaterniond turned(X_AB.linear());
  std::string text = fmt::format(
      "<!-- angles are {0}s, of <compiler angle=\"{0}\"/>{1}; lengths metres; axis and pos in the frame of "
      "the "
      "mobile body's mesh -->\n<mujocoinclude>\n{2}<!-- where all angles are 0 the mobile body lies in the "
      "fixed "
      "one's frame at pos=\"{3}\" quat=\"{4} {5}\" -->\n",
      in_degrees ? "degree" : "radian", in_degrees ? ", MuJoCo's default" : "", comment,
      words(X_AB.translation() / 1000), turned.w(), words(turned.vec()));
  for (const BoxSideRecord& side : box.coordinates) {
    const std::string ref =
        side.offset_deg == 0 ? "" : fmt::format(" ref=\"{}\"", angle(-side.sign * side.offset_deg));
    text += fmt::format(
        "<joint name=\"{}\" type=\"hinge\" axis=\"{}\" pos=\"{}\"{} limited=\"true\" range=\"{} {}\"/>\n",
        xml_escaped(side.coordinate),
        words(X_BM.linear() * (side.sign * axis_of(side.angle, joint.joint.coordinates(), {}))),
        words(X_BM.translation() / 1000), ref, angle(side.lower.limit_deg), angle(side.upper.limit_deg));
  }
  return text + "</mujocoinclude>\n";
}

/// The copy of the model. Throws as with_limits().
std::string model_text(const LimitFile& file, const LoadedJoint& joint,
                       const std::vector<CoordinateRange>& ranges, const std::string& comment) {
  return with_limits(read_whole_file(*file.model), *file.model,
                     names_in(columns_of(joint)->front().column).first, ranges, file.stop, comment);
}

/// The model's joint, after poses by the model are held against poses by the joint file: of each coordinate by itself, and of all at once.
ModelJoint joint_of_same_meaning(const std::filesystem::path& path, const LoadedJoint& joint,
                                 const ZeroOfColumns& zero) {
  const std::vector<ColumnOfCoordinate>& columns = *columns_of(joint);
  const auto [name, first] = names_in(columns.front().column);
  const Model model = read_model(path);
  const auto has = [](const ModelJoint& each, const std::string& coordinate) {
    return std::any_of(each.coordinates.begin(), each.coordinates.end(),
                       [&](const ModelCoordinate& its) { return its.name == coordinate; });
  };
  const auto its = std::find_if(model.joints.begin(), model.joints.end(),
                                [&, name = name, first = first](const ModelJoint& each) {
                                  return name.empty() ? has(each, first) : each.name == name;
                                });
  if (its == model.joints.end()) return {};  // with_limits() says so
  for (const ModelCoupler& coupler : model.couplers)
    if (has(*its, coupler.dependent))
      throw FileError(fmt::format("{}: constraint {} moves coordinate {}: no limit of it by itself holds",
                                  path.string(), in_quotes(coupler.name), in_quotes(coupler.dependent)));
  // Degrees or mm; a joint file's frame may have six decimals.
  constexpr double values[] = {-110, -50, -20, 20, 50, 110}, rounding = 2e-6, rounding_mm = 1e-3;
  std::vector<double> at(columns.size());
  const auto check = [&](const std::string& what) {
    std::vector<double> q = its->defaults();
    for (std::size_t i = 0; i < columns.size(); ++i)
      for (std::size_t k = 0; k < q.size(); ++k)
        if (its->coordinates[k].name == names_in(columns[i].column).second)
          q[k] = at[i] * (columns[i].kind == CoordinateKind::angle ? std::numbers::pi / 180 : 1e-3);
    Pose X = pose_of(*its, q);
    X.translation() *= mm_per(LengthUnit::metres);
    const Pose file = pose_by(zero, columns, at, joint.joint.anatomy);
    if (!((X.linear() - file.linear()).cwiseAbs().maxCoeff() < rounding &&
          (X.translation() - file.translation()).norm() < rounding_mm))
      throw FileError(fmt::format(
          "{}: {} otherwise than the joint file says: make it anew from this model by condyle init",
          path.string(), what));
  };
  check("joint " + in_quotes(its->name) + " stands at zero");
  for (std::size_t i = 0; i < columns.size(); ++i) {
    for (const double value : values) {
      at[i] = value;
      check("coordinate " + in_quotes(names_in(columns[i].column).second) + " turns the joint");
    }
    at[i] = 0;
  }
  for (std::size_t i = 0; i < at.size(); ++i) at[i] = values[i];
  check("joint " + in_quotes(its->name) + " turns");
  return *its;
}

/// A free joint's limits are those at one translation, which its model or its recorded motion moves.
void require_held(const LoadedJoint& joint, bool holds_translation) {
  if (joint.joint.kind != JointKind::free || holds_translation || !joint.report.file.recorded_motion) return;
  const auto* columns = columns_of(joint);
  if (!columns || std::any_of(columns->begin(), columns->end(), [](const ColumnOfCoordinate& column) {
        return column.kind == CoordinateKind::length;
      }))
    throw UsageError(
        "the translation of this joint moves by [recorded_motion], and limits of its angles hold at one "
        "only: say "
        "which by --translation \"x=X y=Y z=Z\", or ask by --follow, without writing, where a motion that "
        "moves it ends");
}

const BoxSideRecord& side_of(const LimitBoxRecord& box, JointAngle angle) {
  return *std::find_if(box.coordinates.begin(), box.coordinates.end(),
                       [&](const BoxSideRecord& side) { return side.angle == angle; });
}

/// The free interval of each point of the map, as the coordinates have it.
std::string coupled_limits(const LimitBoxRecord& box) {
  const motion::MotionMap& map = *box.map;
  const BoxSideRecord &column = side_of(box, map.grid.column.coordinate.angle()),
                      &row = side_of(box, map.grid.row.coordinate.angle()),
                      &varied = side_of(box, map.grid.vary.angle());
  const auto value = [](const BoxSideRecord& side, double angle_deg) {
    return side.sign * (angle_deg - side.offset_deg) + 0.0;  // no -0
  };
  std::string text = csv_field(column.coordinate + "_deg") + "," + csv_field(row.coordinate + "_deg");
  for (const char* of_end : {"_lower_deg", "_upper_deg", "_lower_reason", "_upper_reason"})
    text += "," + csv_field(varied.coordinate + of_end);
  text += "\n";
  const std::size_t columns = map.grid.column.count();
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    text += fmt::format("{},{}", value(column, map.grid.column.value(i % columns)),
                        value(row, map.grid.row.value(i / columns)));
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

LimitCoordinates limit_coordinates(const LoadedJoint& joint, const LimitFile& file, const Provenance* from,
                                   bool holds_translation) {
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
  if (file.angles == AngleUnit::radians && ending != ".xml")
    throw UsageError(file.path.string() + ": the unit of angles is chosen of an .xml of MuJoCo");
  if (file.source == LimitSource::living && ending == ".csv")
    throw UsageError(file.path.string() +
                     ": coupled limits are those of bone: write the living ones as .osim or .xml");
  if (ending == ".csv" && joint.joint.kind == JointKind::hinge)
    throw UsageError("the limits of a hinge are not coupled: write .osim or .xml");
  const auto& mapping = joint.report.file.recorded_motion;
  const auto* columns = columns_of(joint);
  if (mapping &&
      (std::holds_alternative<PosesOfModel>(*mapping) ? ending != ".csv" : !columns && ending == ".osim"))
    throw UsageError(
        "the model poses this joint by its functions: its coordinates have no limits each by itself");
  if (ending == ".osim" && !columns)
    throw UsageError("no model was read into this joint: make it by condyle init MODEL.osim --joint NAME");
  require_held(joint, holds_translation);
  std::vector<std::filesystem::path> read;
  for (const std::filesystem::path& each : files_read(from)) read.push_back(each);
  if (file.model) read.push_back(*file.model);
  check_output_file(file.path, read);
  LimitCoordinates known_by;
  if (!columns) {
    const Joint& own = joint.joint;
    const auto kind = own.names_its_joint() ? name_of(own.anatomy) : name_of(own.kind);
    for (const JointAngle angle : all_joint_angles)
      if (own.kind != JointKind::hinge || angle == JointAngle::flexion)
        known_by.coordinates.push_back({ending == ".xml" ? fmt::format("{}_{:.1}_{}", kind, name_of(own.side),
                                                                       name_of(angle, own.anatomy))
                                                         : std::string(name_of(angle, own.anatomy)),
                                        angle});
    return known_by;
  }
  const ZeroOfColumns zero = zero_of(joint, *columns);
  std::vector<CoordinateRange> ranges;
  for (const ColumnOfCoordinate& column : *columns) {
    if (column.kind != CoordinateKind::angle) continue;
    ranges.push_back({names_in(column.column).second, 0, 0});
    known_by.coordinates.push_back({ranges.back().coordinate,
                                    joint_angle_named(column.coordinate, joint.joint.anatomy), column.sign,
                                    column.offset});
  }
  if (file.model) {
    (void)model_text(file, joint, ranges, "");
    for (const ModelCoordinate& its : joint_of_same_meaning(*file.model, joint, zero).coordinates)
      for (TurningCoordinate& each : known_by.coordinates)
        if (each.name == its.name && !its.stop_by_others.empty())
          each.other_stop = its.stop_by_others + stop_text(its, ": ", "");
  }
  if (is_moved(zero, joint.joint)) {
    if (holds_translation)
      throw UsageError(
          "--translation is along the joint's own axes, and [recorded_motion.zero] has others: no limits are "
          "written in its angles");
    known_by.in_zero = joint_in(zero, joint, *columns);
  }
  return known_by;
}

std::optional<LimitBoxRecord> limit_box(const LimitCoordinates& known_by, const Case& joint,
                                        const RangeAnswer& answer, const RangeRequest& request,
                                        LimitSource source, const Control& control) {
  if (!known_by.in_zero || !answer.range)
    return limit_box_record(joint, answer, request, known_by.coordinates, source, control);
  const Case in_zero = *known_by.in_zero;
  const RangeRequest about{.range = request.range, .map = request.map};
  const auto found = answer_range(in_zero, about, control);
  if (!found) return std::nullopt;
  auto box = limit_box_record(in_zero, *found, about, known_by.coordinates, source, control);
  if (box) box->zero = BoxZero::columns;
  return box;
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
  for (const BoxSideRecord& side : box.coordinates)
    if (side.other_stop)
      text += wrapped(fmt::format("  {} has a stop of the model's own too, which stays: {}\n",
                                  side.coordinate, *side.other_stop));
  if (const auto& held = box.held_translation_mm)
    text +=
        fmt::format("  with the translation held at {:g}, {:g}, {:g} mm\n", held->x(), held->y(), held->z());
  if (box.zero == BoxZero::columns)
    text += wrapped(
        "  angles count from [recorded_motion.zero], whose zero, axes or side are not those of this joint "
        "and its "
        "other limits\n");
  return text;
}

void write_limits(const LimitFile& file, const LimitBoxRecord& box, const LoadedJoint& joint,
                  const LimitCoordinates& known_by, const Provenance* from) {
  const std::string ending = ending_of(file), text = limit_box_text(box), sources = provenance_comments(from);
  if (ending == ".csv") {
    std::string comments;
    for (std::size_t at = 0, end; at < text.size(); at = end + 1)
      end = text.find('\n', at), comments += "# " + text.substr(at, end - at) + "\n";
    return write_output_file(file.path, sources + comments + coupled_limits(box));
  }
  if (ending == ".xml")
    return write_output_file(file.path,
                             mujoco_fragment(file, box, known_by.in_zero ? *known_by.in_zero : joint,
                                             xml_comment(text + sources)));
  const std::string comment = xml_comment(
      text + "CoordinateLimitForce has degrees, range and CoordinateLinearStopForce radians\n" + sources);
  const std::vector<CoordinateRange> ranges = ranges_of(box);
  if (!file.model) return write_output_file(file.path, opensim_fragment(ranges, file.stop, comment));
  write_output_file(file.path, model_text(file, joint, ranges, comment));
}

}  // namespace condyle::io
