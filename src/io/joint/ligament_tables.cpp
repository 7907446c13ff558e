#include "io/joint/ligament_tables.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "io/result/json.hpp"

namespace condyle::io {
namespace {

/// Above 0, if it is there.
std::optional<double> positive_number(TomlTable& table, std::string_view key) {
  const std::optional<double> value = table.number(key);
  if (value && !(*value > 0)) table.fail(key, "must be above 0");
  return value;
}

/// { shape = "sphere", body = "mobile", centre = [...], radius = ... }, of a cylinder with its axis, of an ellipsoid with two axes and three radii.
LigamentWrap wrap_of(TomlTable& table, double mm) {
  LigamentWrap wrap;
  wrap.shape =
      std::array{WrapShape::sphere, WrapShape::cylinder,
                 WrapShape::ellipsoid}[table.required_word("shape", {"sphere", "cylinder", "ellipsoid"})];
  wrap.body = table.required_word("body", {"fixed", "mobile"}) == 0 ? BodyRole::fixed : BodyRole::mobile;
  wrap.centre = mm * table.required("centre", table.triple("centre"));
  if (wrap.shape == WrapShape::ellipsoid) {
    wrap.radii_mm = mm * table.required("radii", table.triple("radii"));
    if (!(wrap.radii_mm.minCoeff() > 0)) table.fail("radii", "must be above 0");
    const std::vector<Vec3> axes = table.required("axes", table.triples("axes"));
    if (axes.size() != 2 || axis_errors(axes[0], axes[1]).largest() > axis_tolerance)
      table.fail("axes", "must be two unit vectors at a right angle, x and y");
    wrap.axes << axes[0], axes[1], axes[0].cross(axes[1]);
  } else {
    wrap.radius_mm = mm * table.required("radius", positive_number(table, "radius"));
  }
  if (wrap.shape == WrapShape::cylinder) {
    wrap.axis = table.required("axis", table.triple("axis"));
    if (!(wrap.axis.norm() > 0)) table.fail("axis", "must not be zero");
    wrap.axis.normalize();
  }
  table.finish();
  return wrap;
}

/// A slack length, the pose at which it is just taut, or a share of its length in the reference pose: one of them.
void read_slack(TomlTable& table, const JointDescription& joint, double mm, DescribedLigament& out) {
  const int given =
      int(table.has("slack_length")) + int(table.has("slack_share")) + int(table.has("taut_at"));
  if (given == 0)
    table.fail_missing("slack_length", "or taut_at, or slack_share of the length in the reference pose");
  if (given > 1) table.fail("slack_length", "give one of slack_length, slack_share and taut_at");
  if (const auto length = positive_number(table, "slack_length")) out.ligament.slack_length_mm = mm * *length;
  if (const auto share = positive_number(table, "slack_share")) out.slack_share = *share;
  if (const auto text = table.text("taut_at")) try {
      const PoseDegrees pose = parse_pose(*text, joint.kind, joint.anatomy);
      if (pose.translation_mm != Vec3::Zero()) table.fail("taut_at", "takes angles only");
      out.taut_at = pose.angles();
    } catch (const UsageError& error) {
      table.fail("taut_at", error.what());
    }
}

DescribedLigament described_ligament(TomlTable& table, const JointDescription& joint, double mm) {
  DescribedLigament out;
  Ligament& ligament = out.ligament;
  ligament.name = table.required("name", table.text("name"));
  if (ligament.name.empty()) table.fail("name", "must not be empty");
  const auto points = [&](std::string_view key) {
    std::vector<Vec3> list = table.required(key, table.triples(key));
    for (Vec3& point : list) point *= mm;
    return list;
  };
  ligament.fixed = points("fixed");
  ligament.mobile = points("mobile");
  read_slack(table, joint, mm, out);
  const auto zero_or_more = [&](std::string_view key, double otherwise) {
    const double value = table.number(key).value_or(otherwise);
    if (value < 0) table.fail(key, "must be 0 or more");
    return value;
  };
  ligament.slack_sigma_mm = mm * zero_or_more("slack_sigma", 0);
  ligament.point_sigma_mm = mm * zero_or_more("point_sigma", 0);
  if (const auto stiffness = positive_number(table, "stiffness_n")) ligament.stiffness_n = *stiffness;
  ligament.transition_strain = zero_or_more("transition_strain", ligament.transition_strain);
  ligament.damping_n_s = zero_or_more("damping_n_s", 0);
  if (const auto strain = positive_number(table, "ends_at_strain")) ligament.ends_at_strain = *strain;
  if (table.is_text("wrap"))
    out.wraps_head = table.required_word("wrap", {"head"}) == 0;
  else if (auto wrap = table.table("wrap"))
    ligament.wrap = wrap_of(*wrap, mm);
  table.finish();
  return out;
}

std::string triple_text(const Vec3& v, double mm) {
  return fmt::format("[{}, {}, {}]", v.x() / mm + 0.0, v.y() / mm + 0.0, v.z() / mm + 0.0);
}

std::string points_text(const std::vector<Vec3>& points, double mm) {
  if (points.size() == 1) return triple_text(points.front(), mm);
  std::string text;
  for (const Vec3& point : points) text += (text.empty() ? "[" : ", ") + triple_text(point, mm);
  return text + "]";
}

std::string wrap_text(const LigamentWrap& wrap, double mm) {
  const std::string of_shape =
      wrap.shape == WrapShape::ellipsoid
          ? fmt::format("axes = [{}, {}], radii = {}", triple_text(wrap.axes.col(0), 1),
                        triple_text(wrap.axes.col(1), 1), triple_text(wrap.radii_mm, mm))
          : fmt::format("radius = {}", wrap.radius_mm / mm);
  return fmt::format("wrap = {{ shape = \"{}\", body = \"{}\", centre = {}, {}{} }}\n", name_of(wrap.shape),
                     wrap.body == BodyRole::fixed ? "fixed" : "mobile", triple_text(wrap.centre, mm),
                     of_shape,
                     wrap.shape == WrapShape::cylinder ? ", axis = " + triple_text(wrap.axis, 1) : "");
}

}  // namespace

std::vector<DescribedLigament> described_ligaments(TomlTable& file, const JointDescription& joint,
                                                   double mm) {
  std::vector<DescribedLigament> all;
  std::set<std::string> names;
  for (TomlTable& table : file.tables("ligament")) {
    all.push_back(described_ligament(table, joint, mm));
    if (!names.insert(all.back().ligament.name).second)
      table.fail("name", fmt::format("\"{}\" is given twice", all.back().ligament.name));
  }
  return all;
}

std::vector<DescribedLigament> ligaments_of_text(std::string_view text, const JointDescription& joint) {
  const std::filesystem::path path = "ligaments";
  try {
    const toml::table root = toml::parse(text, path.string());
    TomlTable file(path, root, "");
    std::vector<DescribedLigament> all = described_ligaments(file, joint, mm_per(joint.units));
    file.finish();
    return all;
  } catch (const FileError& error) {
    throw UsageError(error.what());
  } catch (const toml::parse_error& error) {
    throw UsageError(fmt::format("ligaments: line {}: {}", error.source().begin.line, error.description()));
  }
}

// A name has no control characters, and then a text of JSON is one of TOML: the page carries no writer of its own for it.
std::string ligaments_text(std::span<const Ligament> ligaments, double mm) {
  std::string text;
  for (const Ligament& ligament : ligaments) {
    text += fmt::format("\n[[ligament]]\nname = {}\nfixed = {}\nmobile = {}\nslack_length = {}\n",
                        Json(ligament.name).dump(), points_text(ligament.fixed, mm),
                        points_text(ligament.mobile, mm), ligament.slack_length_mm / mm);
    if (ligament.stiffness_n > 0)
      text += fmt::format("stiffness_n = {}\ntransition_strain = {}\n", ligament.stiffness_n,
                          ligament.transition_strain);
    for (const auto& [key, value] : {std::pair("damping_n_s", ligament.damping_n_s),
                                     std::pair("slack_sigma", ligament.slack_sigma_mm / mm),
                                     std::pair("point_sigma", ligament.point_sigma_mm / mm),
                                     std::pair("ends_at_strain", ligament.ends_at_strain.value_or(0))})
      if (value > 0) text += fmt::format("{} = {}\n", key, value);
    if (ligament.wrap) text += wrap_text(*ligament.wrap, mm);
  }
  return text;
}

}  // namespace condyle::io
