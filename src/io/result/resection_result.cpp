#include "io/result/resection_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "condyle/impingement_zone.hpp"
#include "condyle/version.hpp"
#include "io/file/csv_fields.hpp"
#include "io/file/format_version.hpp"
#include "io/joint/proposal_lines.hpp"
#include "io/joint/settings_lines.hpp"
#include "io/result/clock_text.hpp"
#include "io/result/json.hpp"
#include "io/result/json_objects.hpp"
#include "io/result/parameters.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/quoted_limit.hpp"
#include "io/result/scope_text.hpp"
#include "io/result/text_table.hpp"

namespace condyle::io {
namespace {

using io::Json;

constexpr int bins_per_hour = 2;

/// The bones that were cut, by role.
struct CutOfBody {
  BodyRole role;
  const plan::CutBone& cut;

  std::string_view role_name() const { return role == BodyRole::mobile ? "mobile" : "fixed"; }
};

std::vector<CutOfBody> cuts_of(const plan::Resection& resection) {
  std::vector<CutOfBody> cuts;
  if (resection.mobile) cuts.push_back({BodyRole::mobile, *resection.mobile});
  if (resection.fixed) cuts.push_back({BodyRole::fixed, *resection.fixed});
  return cuts;
}

/// The hour of a point of a hip's bone around the neck, empty without one, or on the socket's clock.
std::optional<double> hour_of(const ResectionAnswer& answer, BodyRole role, const Vec3& p) {
  if (!answer.shape_before) return std::nullopt;
  if (role == BodyRole::fixed) return motion::sagittal_clock().hour_of(p);
  if (!answer.shape_before->femur.neck) return std::nullopt;
  const measure::NeckGeometry& neck = *answer.shape_before->femur.neck;
  return neck.clock.hour_of(p - neck.head.centre);
}

std::optional<double> deepest_hour(const ResectionAnswer& answer, const CutOfBody& cut) {
  return hour_of(answer, cut.role, cut.cut.deepest_at);
}

/// How deep a bone that has hours is cut in each half hour.
std::vector<double> depth_by_hour(const ResectionAnswer& answer, const CutOfBody& of) {
  std::vector<double> deepest(12 * bins_per_hour, 0);
  const plan::CutBone& cut = of.cut;
  for (std::size_t v = 0; v < cut.depth_mm.size(); ++v) {
    if (cut.depth_mm[v] == 0) continue;
    const double hour = *hour_of(answer, of.role, cut.before.vertices[v]);
    double& bin = deepest[static_cast<std::size_t>(hour * bins_per_hour) % deepest.size()];
    bin = std::max(bin, cut.depth_mm[v]);
  }
  return deepest;
}

bool has_hours(const ResectionAnswer& answer) {
  return answer.resection.mobile && hour_of(answer, BodyRole::mobile, Vec3::UnitX()).has_value();
}

std::string target_lines(const ResectionAnswer& answer, std::size_t i) {
  const plan::ReachOutcome& outcome = answer.resection.targets[i];
  const ResectionAnswer::TargetPromise& promise = answer.promises[i];
  const auto with_band = [&](const motion::MotionLimit& limit, const std::optional<motion::LimitBand>& band) {
    return band ? io::quoted_limit(limit, *band) : fmt::format("{:.1f} deg", limit.end.turned.degrees());
  };
  return wrapped(fmt::format("  {}: {}, {} without the bone; asked for {:.1f}\n    {}\n",
                             outcome.target.motion.name, with_band(outcome.before, promise.before),
                             with_band(outcome.after, promise.after), outcome.target.reach.degrees(),
                             promise.text));
}

std::string cut_lines(const ResectionResult& result, const CutOfBody& cut) {
  const plan::CutBone& bone = cut.cut;
  std::string text = fmt::format(
      "  {}: {:.1f} mm3 go, {:.1f} of it in the way, over {:.0f} mm2; {:.2f} mm at the deepest, ({:.1f}, "
      "{:.1f}, {:.1f}) "
      "mm",
      bone.body.name, bone.volume_mm3, bone.least_volume_mm3, bone.area_mm2, bone.deepest_mm,
      bone.deepest_at.x(), bone.deepest_at.y(), bone.deepest_at.z());
  if (const auto hour = deepest_hour(result.answer, cut))
    text += ", " + io::clock_text(*hour) + (cut.role == BodyRole::mobile ? " of the neck" : " of the socket");
  if (bone.burr_volume_mm3 > 0) text += fmt::format("; {:.1f} mm3 for the burr", bone.burr_volume_mm3);
  return text + "\n";
}

std::string limit_value(const motion::MotionLimit& limit) {
  if (limit.end.reason == motion::LimitReason::end_of_range) return io::beyond_range(limit, nullptr);
  return fmt::format("{:.1f}", limit.end.turned.degrees());
}

/// To the digit that is shown, and 0 without a sign.
double shown_gain(Angle gain) {
  return std::round(10 * gain.degrees()) / 10 + 0.0;
}

std::string limit_lines(const ResectionAnswer& answer) {
  std::size_t widest = 0;
  for (const motion::MotionLimit& limit : answer.before) widest = std::max(widest, limit.motion.name.size());
  std::string text =
      fmt::format("  {:<{}}  {:>8}  {:>8}  {:>6}\n", "limits (deg)", widest + 2, "before", "after", "gain");
  for (std::size_t i = 0; i < answer.before.size(); ++i)
    text +=
        fmt::format("    {:<{}}  {:>8}  {:>8}  {:>6.1f}\n", answer.before[i].motion.name, widest,
                    limit_value(answer.before[i]), limit_value(answer.after[i]), shown_gain(answer.gain[i]));
  return text;
}

/// Measures that the cut changes, to the digit that is shown.
std::string shape_lines(const ResectionAnswer& answer) {
  if (!answer.shape_before) return {};
  std::string text;
  for (const measure::MeasureDefinition& each : measure::measure_definitions()) {
    const auto &a = each.of(*answer.shape_before).value, &b = each.of(*answer.shape_after).value;
    const auto shown = [](const std::optional<double>& value) {
      return value ? fmt::format("{:.1f}", *value) : "-";
    };
    if (each.unit == "1" || shown(a) == shown(b)) continue;
    text += fmt::format("    {}: {} before, {} after\n", each.key, shown(a), shown(b));
  }
  return text.empty() ? text : "  measures that change:\n" + text;
}

std::string curve_lines(const ResectionAnswer& answer) {
  if (answer.curve.empty()) return {};
  std::string text = "  what each degree costs, each target by itself:\n";
  for (const ResectionAnswer::CurvePoint& point : answer.curve)
    text += fmt::format("    {} to {:.1f} deg: {:.1f} mm3, {:.2f} mm deep\n",
                        answer.resection.targets[point.target].target.motion.name, point.reached.degrees(),
                        point.volume_mm3, point.deepest_mm);
  return text;
}

Json limit_json(const motion::MotionLimit& limit) {
  return {{"limit_deg", degrees_turned(limit.end.turned, limit.motion)},
          {"reason", name_of(limit.end.reason)}};
}

Json band_json(const motion::LimitBand& band, const motion::Motion& motion) {
  return {{"p5_deg", degrees_turned(band.p5, motion)},
          {"median_deg", degrees_turned(band.median, motion)},
          {"p95_deg", degrees_turned(band.p95, motion)},
          {"text", quoted_band(band, motion)}};
}

/// Null without a band.
Json band_json(const std::vector<motion::LimitBand>& bands, std::size_t i, const motion::Motion& motion) {
  return bands.empty() ? Json(nullptr) : band_json(bands[i], motion);
}

Json other_centre_json(const std::optional<ResectionAnswer::TargetPromise::AboutOtherCentre>& other,
                       const motion::Motion& motion) {
  if (!other) return nullptr;
  return {{"centre", other->of == BodyRole::fixed ? "socket" : "head"},
          {"before_deg", degrees_turned(other->before, motion)},
          {"after_deg", degrees_turned(other->after, motion)},
          {"is_decided", other->is_decided}};
}

Json blocked_json(const std::optional<plan::Blocked>& blocked) {
  if (!blocked) return nullptr;
  return {{"kept_by", name_of(blocked->by)},
          {"body", blocked->body == BodyRole::mobile ? "mobile" : "fixed"},
          {"point_mm", io::numbers(blocked->point_mm)}};
}

Json target_json(const ResectionAnswer& answer, std::size_t i) {
  const plan::ReachOutcome& outcome = answer.resection.targets[i];
  Json json{{"motion", outcome.target.motion.name},
            {"reach_deg", plan::asked_degrees(outcome.target.reach)},
            {"planned_deg", plan::asked_degrees(outcome.planned)},
            {"before", limit_json(outcome.before)},
            {"after", limit_json(outcome.after)},
            {"blocked", blocked_json(outcome.blocked)}};
  const ResectionAnswer::TargetPromise& promise = answer.promises[i];
  json["confidence_reached"] = io::nullable(promise.confidence_reached);
  json["before_band"] = promise.before ? band_json(*promise.before, outcome.target.motion) : Json(nullptr);
  json["band"] = promise.after ? band_json(*promise.after, outcome.target.motion) : Json(nullptr);
  json["other_centre"] = other_centre_json(promise.other_centre, outcome.target.motion);
  json["is_plan"] = promise.is_plan;
  json["text"] = promise.text;
  return json;
}

Json cut_json(const ResectionAnswer& answer, const CutOfBody& cut) {
  const plan::CutBone& bone = cut.cut;
  Json json{{"body", cut.role_name()},
            {"name", bone.body.name},
            {"volume_mm3", bone.volume_mm3},
            {"least_volume_mm3", bone.least_volume_mm3},
            {"burr_volume_mm3", bone.burr_volume_mm3},
            {"burr_in_kept_mm", bone.burr_in_kept_mm},
            {"area_mm2", bone.area_mm2},
            {"deepest_mm", bone.deepest_mm},
            {"deepest_at_mm", io::numbers(bone.deepest_at)},
            {"deepest_hour", io::nullable(deepest_hour(answer, cut))}};
  json["depth_by_half_hour_mm"] = nullptr;
  if (json["deepest_hour"] != nullptr) json["depth_by_half_hour_mm"] = depth_by_hour(answer, cut);
  return json;
}

Json shape_json(const ResectionAnswer& answer) {
  if (!answer.shape_before) return nullptr;
  Json list = Json::array();
  for (const measure::MeasureDefinition& each : measure::measure_definitions())
    list.push_back({{"key", each.key},
                    {"unit", each.unit},
                    {"before", io::nullable(each.of(*answer.shape_before).value)},
                    {"after", io::nullable(each.of(*answer.shape_after).value)}});
  return list;
}

Json curve_json(const ResectionAnswer& answer) {
  Json list = Json::array();
  for (const ResectionAnswer::CurvePoint& point : answer.curve)
    list.push_back({{"motion", answer.resection.targets[point.target].target.motion.name},
                    {"reached_deg", point.reached.degrees()},
                    {"volume_mm3", point.volume_mm3},
                    {"deepest_mm", point.deepest_mm}});
  return list;
}

Json resection_notes_json(const std::vector<ResectionNote>& notes) {
  Json list = Json::array();
  for (const ResectionNote& note : notes) list.push_back({{"code", name_of(note.code)}, {"text", note.text}});
  return list;
}

/// Every bit.
std::string exact_vector(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
}

}  // namespace

std::string resection_text(const ResectionResult& result) {
  const ResectionAnswer& answer = result.answer;
  std::string text = fmt::format("{}: bone that must go, {} side{}\n", result.joint.name,
                                 name_of(result.joint.side), whose_text(result.joint));
  text += io::parameters_text(result.joint);
  for (const ResectionNote& note : answer.notes)
    if (note.code == ResectionNoteCode::stopped) text += wrapped(fmt::format("  stopped: {}\n", note.text));
  for (std::size_t i = 0; i < answer.resection.targets.size(); ++i) text += target_lines(answer, i);
  for (const CutOfBody& cut : cuts_of(answer.resection)) text += cut_lines(result, cut);
  if (answer.margin_mm > 0) text += fmt::format("  planned with a margin of {:.3g} mm\n", answer.margin_mm);
  text += limit_lines(answer) + shape_lines(answer) + curve_lines(answer);
  for (const std::string& caveat : answer.caveats) text += wrapped(fmt::format("  {}\n", caveat));
  return text + fmt::format("  {}\n", scope_text(result.joint));
}

Json resection_object(const ResectionResult& result) {
  const ResectionAnswer& answer = result.answer;
  Json targets = Json::array(), cuts = Json::array(), limits = Json::array();
  for (std::size_t i = 0; i < answer.resection.targets.size(); ++i) targets.push_back(target_json(answer, i));
  for (const CutOfBody& cut : cuts_of(answer.resection)) cuts.push_back(cut_json(answer, cut));
  for (std::size_t i = 0; i < answer.before.size(); ++i)
    limits.push_back({{"motion", answer.before[i].motion.name},
                      {"before", limit_json(answer.before[i])},
                      {"before_band", band_json(answer.bands_before, i, answer.before[i].motion)},
                      {"after", limit_json(answer.after[i])},
                      {"band", band_json(answer.bands_after, i, answer.before[i].motion)},
                      {"gain_deg", answer.gain[i].degrees()}});
  Json alternatives = Json::array();
  for (const ResectionAnswer::Alternative& each : answer.alternatives)
    alternatives.push_back(
        {{"confidence", each.confidence}, {"margin_mm", each.margin_mm}, {"volume_mm3", each.volume_mm3}});
  Json hours = nullptr;
  if (has_hours(answer)) hours = depth_by_hour(answer, {BodyRole::mobile, *answer.resection.mobile});
  Json json{{"condyle", io::format_version},
            {"joint", result.joint.name},
            {"fixed", result.joint.fixed.name},
            {"mobile", result.joint.mobile.name},
            {"side", name_of(result.joint.side)},
            {"margin_mm", answer.margin_mm},
            {"confidence", io::nullable(answer.confidence)},
            {"displaced", answer.displaced},
            {"alternatives", std::move(alternatives)},
            {"targets", std::move(targets)},
            {"cuts", std::move(cuts)},
            {"limits", std::move(limits)},
            {"measures", shape_json(answer)},
            {"depth_by_half_hour_mm", std::move(hours)},
            {"curve", curve_json(answer)},
            {"resection_notes", resection_notes_json(answer.notes)},
            {"caveats", answer.caveats},
            {"notes", io::notes_json(result.notes, {}, answer.limit_notes)},
            {"scope", scope_text(result.joint)},
            {"provenance", io::provenance_json(result.provenance)}};
  io::drop_negative_zeros(json);
  return json;
}

std::string resection_json(const ResectionResult& result) {
  return io::document(io::resection_object(result));
}

std::string resection_limits_csv(const ResectionResult& result) {
  const ResectionAnswer& answer = result.answer;
  std::string text = io::provenance_comments(result.provenance, result.notes);
  for (const ResectionNote& note : answer.notes)
    text += fmt::format("# note: {}: {}\n", name_of(note.code), note.text);
  text +=
      "motion,before_deg,before_reason,after_deg,after_reason,reach_deg,gain_deg,"
      "before_p5_deg,before_median_deg,before_p95_deg,after_p5_deg,after_median_deg,after_p95_"
      "deg\n";
  for (std::size_t i = 0; i < answer.before.size(); ++i) {
    const motion::MotionLimit &a = answer.before[i], &b = answer.after[i];
    std::string reach;
    for (const plan::ReachOutcome& outcome : answer.resection.targets)
      if (outcome.target.motion.name == a.motion.name)
        reach = fmt::format("{}", plan::asked_degrees(outcome.target.reach));
    text += fmt::format("{},{},{},{},{},{},{}", io::csv_field(a.motion.name),
                        degrees_turned(a.end.turned, a.motion), name_of(a.end.reason),
                        degrees_turned(b.end.turned, a.motion), name_of(b.end.reason), reach,
                        answer.gain[i].degrees());
    for (const auto* bands : {&answer.bands_before, &answer.bands_after})
      for (const auto quantile :
           {&motion::LimitBand::p5, &motion::LimitBand::median, &motion::LimitBand::p95})
        text += bands->empty() ? "," : fmt::format(",{}", degrees_turned((*bands)[i].*quantile, a.motion));
    text += '\n';
  }
  return text;
}

std::string resection_curve_csv(const ResectionResult& result) {
  std::string text =
      io::provenance_comments(result.provenance) + "motion,reached_deg,volume_mm3,deepest_mm\n";
  for (const ResectionAnswer::CurvePoint& point : result.answer.curve)
    text += fmt::format("{},{},{},{}\n",
                        io::csv_field(result.answer.resection.targets[point.target].target.motion.name),
                        point.reached.degrees(), point.volume_mm3, point.deepest_mm);
  return text;
}

std::string resection_hours_csv(const ResectionResult& result) {
  if (!has_hours(result.answer)) return {};
  std::string text = io::provenance_comments(result.provenance) + "hour,to_hour,deepest_mm\n";
  const std::vector<double> depths =
      depth_by_hour(result.answer, {BodyRole::mobile, *result.answer.resection.mobile});
  for (std::size_t i = 0; i < depths.size(); ++i)
    text += fmt::format("{},{},{}\n", double(i) / bins_per_hour, double(i + 1) / bins_per_hour, depths[i]);
  return text;
}

std::string resected_joint_file(const ResectionResult& result) {
  const Joint& joint = result.answer.resection.joint;
  ProposalLines lines;
  lines.add(fmt::format("# Written by condyle resect {}: {} without the bone that must go.", version,
                        result.joint.name));
  lines.add(fmt::format("condyle = {}", io::format_version));
  lines.add("name = " + io::toml_text(joint.name));
  const std::string from =
      result.file ? fmt::format(", from {}", result.file->path.filename().string()) : std::string();
  lines.add("planned = " + io::toml_text(joint.planned + from));
  lines.add(fmt::format("kind = \"{}\"", name_of(joint.kind)));
  if (joint.names_its_joint()) lines.add(fmt::format("joint = \"{}\"", name_of(joint.anatomy)));
  lines.add(fmt::format("side = \"{}\"", name_of(joint.side)));
  lines.add("units = \"mm\"");
  if (joint.kind == JointKind::free && joint.translation_frame == TranslationFrame::joint_axes)
    lines.add("translation_frame = \"joint_axes\"");
  // A free joint is held where its reference pose has it: the meshes are seen from there.
  PoseDegrees reference = result.file ? result.file->reference_pose : PoseDegrees{};
  reference.translation_mm = Vec3::Zero();
  const Pose X_FM = pose_at(joint.coordinates(), reference.coordinates(), joint.translation_frame);
  std::string pose;
  if (!X_FM.matrix().isIdentity(0)) {
    // The mesh is that of zero angles; the reference pose stays the one that contact is checked in.
    std::string rows;
    for (int i = 0; i < 16; ++i)
      rows += fmt::format("{}{}", i ? ", " : "", X_FM.matrix()(i / 4, i % 4) + 0.0);
    pose = "pose = [" + rows + "]";
  }
  for (const auto& [role, body] :
       {std::pair<std::string, const Body&>("fixed", joint.fixed), {"mobile", joint.mobile}}) {
    lines.add(fmt::format("\n[{}]", role));
    lines.add("name = " + io::toml_text(body.name));
    if (role == "mobile" && !pose.empty()) lines.add(pose);
    if (body.parts.empty()) {
      lines.add(fmt::format("mesh = \"resected_{}.ply\"", role));
    } else {
      for (std::size_t p = 0; p < body.parts.size(); ++p) {
        lines.add(fmt::format("[[{}.meshes]]", role));
        lines.add("name = " + io::toml_text(body.parts[p].name));
        lines.add(fmt::format("mesh = \"resected_{}_{}.ply\"", role, p + 1));
        lines.add(fmt::format("contact = \"{}\"", name_of(body.parts[p].contact)));
      }
    }
    io::add_image(lines, role, body.image);
  }
  const auto add_sphere = [&](std::string_view table, const std::optional<Sphere>& sphere) {
    if (!sphere) return;
    lines.add(fmt::format(
        "\n[{}]  # before the cut: a fit to a mesh with smaller triangles around it would differ", table));
    lines.add("centre = " + exact_vector(sphere->centre));
    lines.add(fmt::format("radius = {}", sphere->radius));
  };
  add_sphere("fixed.socket", joint.fixed.head);
  add_sphere("mobile.head", joint.mobile.head);
  if (const auto margin = joint.mobile.bearing_margin_mm) lines.add(fmt::format("margin = {}", *margin));
  lines.add("\n[frame]  # the meshes are in the joint frame");
  lines.add("centre = [0, 0, 0]\nanterior = [1, 0, 0]\nsuperior = [0, 1, 0]");
  if (!pose.empty() || joint.zero_from != ZeroFrom::as_given) {
    lines.add("\n[reference_pose]");
    for (const JointAngle angle : all_joint_angles)
      if (reference[angle] != 0)
        lines.add(fmt::format("{} = {}", name_of(angle, joint.anatomy), reference[angle]));
  }
  if (result.file) io::add_settings(lines, *result.file, joint, result.file->uncertainty);
  return std::move(lines).proposal(joint.side).toml;
}

}  // namespace condyle::io
