#include "io/result/implant_result.hpp"

#include <fmt/format.h>

#include <string_view>

#include "io/file/format_version.hpp"
#include "io/result/json.hpp"
#include "io/result/parameters.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/scope_text.hpp"

namespace condyle::io {
namespace {

using io::Json;

/// " 40.00 15.00 radiographic, 42.27 22.63 anatomic, ..."
std::string by_all_definitions(const plan::CupAngles& cup) {
  std::string text;
  for (const CupDefinition definition : all_cup_definitions) {
    const plan::CupAngles angles = plan::by_definition(cup, definition);
    text += fmt::format("{} {:.2f} {:.2f} {}", definition == CupDefinition::radiographic ? "" : ",",
                        angles.inclination.degrees(), angles.anteversion.degrees(), name_of(definition));
  }
  return text;
}

std::vector<plan::CupAngles> each_definition(const plan::CupAngles& cup) {
  std::vector<plan::CupAngles> angles;
  for (const CupDefinition definition : all_cup_definitions)
    angles.push_back(plan::by_definition(cup, definition));
  return angles;
}

std::optional<plan::CupAngles> rim_angles(const ImplantResult& result) {
  const auto& rim = result.answer.bones.acetabulum.plane;
  if (!rim) return std::nullopt;
  return plan::cup_angles(rim->normal, CupDefinition::radiographic, result.joint.side);
}

std::vector<std::string_view> sizes_of_bones(const SizesOfBones& of) {
  std::vector<std::string_view> names;
  const auto add = [&](bool is_of_bone, std::string_view name) {
    if (is_of_bone) names.push_back(name);
  };
  add(of.cup, "inclination"), add(of.cup, "anteversion");
  add(of.neck_shaft, "neck_shaft"), add(of.stem_version, "stem_version");
  add(of.cup_radius, "cup_radius"), add(of.offset, "offset");
  return names;
}

const char* whose(bool is_of_bone) {
  return is_of_bone ? " as the bone's" : "";
}

/// To tenths, without the sign of 0.
std::string place_text(const Vec3& p) {
  const Vec3 tenths = (p * 10).array().round() / 10;
  return fmt::format("({:.1f}, {:.1f}, {:.1f}) mm", tenths.x() + 0.0, tenths.y() + 0.0, tenths.z() + 0.0);
}

std::string centre_lines(const ImplantResult& result) {
  const ImplantAnswer& answer = result.answer;
  const measure::FemurMeasures& femur = answer.bones.femur;
  std::string text = fmt::format("  centre: that of the {}, at {}\n", name_of(answer.centre_of),
                                 place_text(answer.centre_mm));
  text += fmt::format("  bone: head of radius {:.2f} mm, residuals {:.2f} mm rms and {:.2f} mm at the most",
                      *femur.head_radius.value, *femur.head_rms.value, *femur.head_largest_residual.value);
  if (answer.centre_bound_mm) text += fmt::format(", centre within {:.2f} mm", *answer.centre_bound_mm);
  if (answer.socket)
    text += fmt::format("; socket of radius {:.2f} mm, centre {:.2f} mm from it", answer.socket->radius,
                        (answer.socket->centre - femur.head->centre).norm());
  return text + "\n";
}

std::string rim_line(const ImplantResult& result) {
  const auto rim = rim_angles(result);
  if (!rim)
    return fmt::format("  rim of the bone: not found: {}\n",
                       result.answer.bones.acetabulum.inclination.why_none);
  return fmt::format("  rim of the bone, inclination and anteversion:{}\n", by_all_definitions(*rim));
}

std::string measure_text(std::string_view name, const measure::Measure& measure) {
  return measure.value ? fmt::format("{} {:.2f} deg", name, *measure.value)
                       : fmt::format("no {}: {}", name, measure.why_none);
}

std::string stem_lines(const ImplantAnswer& answer) {
  const plan::TotalHip& hip = answer.hip;
  const measure::FemurMeasures& femur = answer.bones.femur;
  std::string text =
      fmt::format("  stem: neck-shaft angle {:.2f} deg{}, version {:.2f} deg{}, offset {:.2f} mm{}\n",
                  hip.neck_shaft.degrees(), whose(answer.of_bones.neck_shaft), hip.stem_version.degrees(),
                  whose(answer.of_bones.stem_version), hip.offset_mm, whose(answer.of_bones.offset));
  text += fmt::format("  bone: {}; {}; {}\n", measure_text("angle between neck and shaft", femur.neck_shaft),
                      measure_text("version of the neck in the frame", femur.torsion_in_frame),
                      measure_text("version over the condyles", femur.version));
  return text + fmt::format(
                    "  femur: cut {:.1f} mm from the centre across the neck, {:.0f} mm3 less; moved by "
                    "{}\n",
                    answer.cut.offset_mm, answer.removed_mm3, place_text(answer.femur_shift_mm));
}

std::string cup_line(const ImplantAnswer& answer) {
  std::string text =
      fmt::format("  cup: radius {:g} mm{}, bone begins {:.2f} mm from the centre", answer.hip.cup_radius_mm,
                  answer.of_bones.cup_radius ? " as the bone leaves room" : "", answer.room_mm);
  if (answer.stands_out)
    text += fmt::format("; its edge stands out of the rim by {:.1f} mm at {:.1f} h at the most",
                        answer.stands_out->mm, answer.stands_out->hour);
  return text + "\n";
}

/// Lines as the rest of an answer has them.
std::string indented(const std::string& lines) {
  std::string text = "  ";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    text += lines[i];
    if (lines[i] == '\n' && i + 1 < lines.size()) text += "  ";
  }
  return text;
}

Json sizes_json(const plan::TotalHip& hip) {
  Json json{{"kind", name_of(plan::Implant(hip))}, {"definition", name_of(hip.cup.definition)}};
  for (const plan::ImplantParameter& each : plan::implant_parameters(hip))
    json[fmt::format("{}_{}", each.name, each.unit)] = each.value(hip);
  json["facets"] = hip.facets;
  return json;
}

Json head_json(const ImplantAnswer& answer) {
  const measure::FemurMeasures& femur = answer.bones.femur;
  return {{"centre_mm", io::numbers(femur.head->centre)},
          {"radius_mm", *femur.head_radius.value},
          {"rms_mm", *femur.head_rms.value},
          {"largest_residual_mm", *femur.head_largest_residual.value},
          {"coverage", *femur.head_coverage.value},
          {"centre_bound_mm", io::nullable(answer.centre_bound_mm)}};
}

Json socket_json(const std::optional<Sphere>& socket) {
  if (!socket) return nullptr;
  return {{"centre_mm", io::numbers(socket->centre)}, {"radius_mm", socket->radius}};
}

Json overhang_json(const std::optional<CupOverhang>& overhang) {
  if (!overhang) return nullptr;
  return {{"mm", overhang->mm}, {"hour", overhang->hour}};
}

Json bone_json(const ImplantAnswer& answer) {
  const measure::FemurMeasures& femur = answer.bones.femur;
  Json axis = nullptr;
  if (femur.neck) axis = io::numbers(femur.neck->direction);
  return {{"neck_axis", std::move(axis)},
          {"neck_shaft_deg", io::nullable(femur.neck_shaft.value)},
          {"version_deg", io::nullable(femur.version.value)},
          {"torsion_in_frame_deg", io::nullable(femur.torsion_in_frame.value)}};
}

Json implant_notes_json(const std::vector<ImplantNote>& notes) {
  Json list = Json::array();
  for (const ImplantNote& note : notes) list.push_back({{"code", name_of(note.code)}, {"text", note.text}});
  return list;
}

}  // namespace

std::string implant_lines(const plan::Implant& implant, Side side) {
  std::string text;
  if (const auto* hip = std::get_if<plan::TotalHip>(&implant))
    text += fmt::format("cup, inclination and anteversion:{}\n", by_all_definitions(hip->cup));
  const auto pair = plan::revolved_pair(implant, side);
  text += pair ? fmt::format("neck meets liner where their axes are {:.4f} degrees apart\n",
                             pair->half_angle.degrees())
               : fmt::format("limits of meshes only: {}\n", plan::why_not_revolved(implant));
  return text;
}

std::string implant_text(const ImplantResult& result) {
  const ImplantAnswer& answer = result.answer;
  std::string text =
      fmt::format("{}: total hip in its place, {} side, angles in the frame: {}\n", result.joint.name,
                  name_of(result.joint.side), measure::stated_frame(answer.bones) + whose_text(result.joint));
  text += io::parameters_text(result.joint);
  text += indented(implant_lines(answer.hip, result.joint.side)) + rim_line(result) + cup_line(answer);
  text += centre_lines(result) + stem_lines(answer);
  for (const std::string& caveat : answer.caveats) text += fmt::format("  {}\n", caveat);
  return text + fmt::format("  {}\n", scope_text(answer.joint));
}

std::string implant_json(const ImplantResult& result) {
  const ImplantAnswer& answer = result.answer;
  const auto rim = rim_angles(result);
  Json json{{"condyle", io::format_version},
            {"joint", result.joint.name},
            {"fixed", result.joint.fixed.name},
            {"mobile", result.joint.mobile.name},
            {"side", name_of(result.joint.side)},
            {"frame", measure::stated_frame(answer.bones)},
            {"implant", sizes_json(answer.hip)},
            {"of_bones", sizes_of_bones(answer.of_bones)},
            {"cup", io::cup_json(each_definition(answer.hip.cup))},
            {"rim", rim ? io::cup_json(each_definition(*rim)) : Json(nullptr)},
            {"centre_of", name_of(answer.centre_of)},
            {"centre_mm", io::numbers(answer.centre_mm)},
            {"head", head_json(answer)},
            {"socket", socket_json(answer.socket)},
            {"femur", bone_json(answer)},
            {"room_mm", answer.room_mm},
            {"stands_out", overhang_json(answer.stands_out)},
            {"cut",
             {{"normal", io::numbers(answer.cut.normal)},
              {"offset_mm", answer.cut.offset_mm},
              {"removed_mm3", answer.removed_mm3}}},
            {"femur_shift_mm", io::numbers(answer.femur_shift_mm)}};
  json["half_angle_deg"] = answer.pair ? Json(answer.pair->half_angle.degrees()) : Json(nullptr);
  json["why_no_half_angle"] = answer.why_no_pair.empty() ? Json(nullptr) : Json(answer.why_no_pair);
  json["implant_notes"] = implant_notes_json(answer.notes);
  json["caveats"] = answer.caveats;
  json["notes"] = io::notes_json(result.notes);
  json["scope"] = scope_text(answer.joint);
  json["provenance"] = io::provenance_json(result.provenance);
  io::drop_negative_zeros(json);
  return io::document(std::move(json));
}

}  // namespace condyle::io
