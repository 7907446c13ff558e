#include "io/result/measure_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "condyle/io/pose_text.hpp"
#include "io/file/format_version.hpp"
#include "io/file/output_folder.hpp"
#include "io/file/whole_file.hpp"
#include "io/result/caveats.hpp"
#include "io/result/csv_field.hpp"
#include "io/result/json.hpp"
#include "io/result/measure_object.hpp"
#include "io/result/provenance_forms.hpp"

namespace condyle {
namespace {

using io::Json;

/// By which axes acetabular angles are measured, and what to think of them.
std::string pelvis_text(const HipMeasures& measures) {
  const char* warning = measures.pelvis_frame.empty()
                            ? ": the pelvis may have lain turned, and acetabular angles turn with it"
                            : "";
  return stated_frame(measures) + warning;
}

/// With as many digits as its unit is read with.
std::string measured_number(const MeasureDefinition& definition, double value) {
  return fmt::format("{:.{}f}", value, definition.unit == "1" ? 3 : definition.unit == "h" ? 2 : 1);
}

std::string measured_value(const MeasureDefinition& definition, const Measure& measure) {
  if (!measure.value) return "-";
  return measured_number(definition, *measure.value) +
         (definition.unit == "1" ? "" : fmt::format(" {}", definition.unit));
}

/// "41.2 to 47.9", or nothing.
std::string measure_band_text(const MeasureDefinition& definition, const MeasureBand& band) {
  if (!band.p5 || !band.p95) return "-";
  return measured_number(definition, *band.p5) + " to " + measured_number(definition, *band.p95);
}

std::string normal_text(const MeasureDefinition& definition) {
  return definition.normal ? fmt::format("{:g} to {:g}", definition.normal->low, definition.normal->high)
                           : "";
}

std::string_view heading_of(MeasuredPart part) {
  switch (part) {
    case MeasuredPart::femur:
      return "femur";
    case MeasuredPart::acetabulum:
      return "acetabulum";
    case MeasuredPart::both:
      break;
  }
  return "both";
}

Json measure_band_json(const MeasureBand& band) {
  return {{"p5", io::nullable(band.p5)},
          {"median", io::nullable(band.median)},
          {"p95", io::nullable(band.p95)},
          {"samples_without_value", band.samples_without_value}};
}

Json measure_entry(const MeasureDefinition& definition, const HipMeasures& measures) {
  const Measure& measure = definition.of(measures);
  Json json{{"key", definition.key},
            {"part", heading_of(definition.part)},
            {"unit", definition.unit},
            {"value", io::nullable(measure.value)},
            {"definition", definition.definition},
            {"source", definition.source}};
  if (!measure.value) json["why_none"] = measure.why_none;
  if (!measure.note.empty()) json["note"] = measure.note;
  json["frame"] = definition.in_pelvis_frame ? Json(stated_frame(measures)) : Json(nullptr);
  json["normal"] = definition.normal ? Json{{"low", definition.normal->low},
                                            {"high", definition.normal->high},
                                            {"meaning", definition.normal->meaning},
                                            {"source", definition.normal->source}}
                                     : Json(nullptr);
  return json;
}

Json point_or_null(const std::optional<Vec3>& point) {
  return point ? io::numbers(*point) : Json(nullptr);
}

Json neck_json(const FemurMeasures& femur) {
  Json json = Json::array();
  for (const NeckHour& at : femur.around_neck)
    json.push_back({{"hour", at.hour},
                    {"alpha_deg", io::nullable(at.alpha_deg)},
                    {"alpha_at_1mm_deg", io::nullable(at.alpha_at_1mm_deg)},
                    {"is_doubtful", at.is_doubtful},
                    {"alpha_point_mm", point_or_null(at.alpha_point)},
                    {"offset_mm", io::nullable(at.offset_mm)},
                    {"offset_point_mm", point_or_null(at.offset_point)}});
  return json;
}

Json rim_json(const AcetabulumMeasures& acetabulum) {
  Json json = Json::array();
  for (const RimHour& at : acetabulum.rim)
    json.push_back({{"hour", at.hour},
                    {"point_mm", point_or_null(at.point)},
                    {"cover_deg", at.point ? Json(at.cover_deg) : Json(nullptr)},
                    {"centre_edge_deg", at.point ? Json(at.centre_edge_deg) : Json(nullptr)},
                    {"is_in_plane", at.is_in_plane}});
  return json;
}

/// Planes and axes that measures were made with: the femur's in the mobile body's frame, the rest in the fixed one's.
Json geometry_json(const HipMeasures& measures) {
  const FemurMeasures& femur = measures.femur;
  const AcetabulumMeasures& acetabulum = measures.acetabulum;
  Json json;
  json["neck"] = femur.neck
                     ? Json{{"head_centre_mm", io::numbers(femur.neck->head.centre)},
                            {"direction", io::numbers(femur.neck->direction)},
                            {"clock_from", femur.neck->clock_from == ClockSource::shaft ? "shaft" : "frame"}}
                     : Json(nullptr);
  json["shaft"] = femur.shaft ? Json{{"first_mm", io::numbers(femur.shaft->first)},
                                     {"last_mm", io::numbers(femur.shaft->last)},
                                     {"bound_deg", femur.shaft->bound_deg}}
                              : Json(nullptr);
  json["condyles"] = femur.condyles ? Json{{"middle_mm", io::numbers(femur.condyles->middle)},
                                           {"medial_mm", io::numbers(femur.condyles->medial)},
                                           {"lateral_mm", io::numbers(femur.condyles->lateral)}}
                                    : Json(nullptr);
  json["trochanter_mm"] = point_or_null(femur.trochanter_top);
  json["rim_plane"] = acetabulum.plane ? Json{{"centre_mm", io::numbers(acetabulum.plane->centre)},
                                              {"normal", io::numbers(acetabulum.plane->normal)},
                                              {"radius_mm", acetabulum.plane->radius_mm}}
                                       : Json(nullptr);
  json["pelvis"] = {{"anterior", io::numbers(acetabulum.anterior)},
                    {"superior", io::numbers(acetabulum.superior)},
                    {"lateral", io::numbers(acetabulum.lateral)}};
  return json;
}

/// Whether some result has a file of this name.
bool is_of_measure(std::string_view name) {
  static constexpr std::string_view names[] = {"measures.json", "measures.csv", "neck.csv", "rim.csv"};
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

std::string csv_number(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "";
}

}  // namespace

std::string measure_text(const MeasureResult& result) {
  const Joint& joint = result.joint;
  std::string text = fmt::format("{}: measures of {} and {}, {} side\n", joint.name, joint.mobile.name,
                                 joint.fixed.name, name_of(joint.side));
  text += fmt::format("  pelvis: {}\n", pelvis_text(result.answer.measures));
  std::size_t widest = 0;
  for (const MeasureDefinition& each : measure_definitions()) widest = std::max(widest, each.key.size());
  std::string_view heading;
  std::string reasons, notes;
  const bool has_bands = !result.answer.bands.empty();
  for (std::size_t i = 0; i < measure_definitions().size(); ++i) {
    const MeasureDefinition& each = measure_definitions()[i];
    if (heading != heading_of(each.part)) {
      heading = heading_of(each.part);
      text += fmt::format("  {:<{}}  {:>10}{}  normal\n", heading, widest + 2, "",
                          has_bands ? fmt::format("  {:<16}", "5 to 95 %") : "");
    }
    const Measure& measure = each.of(result.answer.measures);
    const std::string band =
        has_bands ? fmt::format("  {:<16}", measure_band_text(each, result.answer.bands[i])) : "";
    std::string line = fmt::format("    {:<{}}  {:>10}{}  {}", each.key, widest,
                                   measured_value(each, measure), band, normal_text(each));
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    if (!measure.value) reasons += fmt::format("    {}: {}\n", each.key, measure.why_none);
    if (!measure.note.empty()) notes += fmt::format("    {}: {}\n", each.key, measure.note);
  }
  if (!reasons.empty()) text += "  cannot be told:\n" + reasons;
  if (!notes.empty()) text += "  to be read with:\n" + notes;
  if (has_bands)
    text += fmt::format("  5 to 95 % of {} joints with centre, axes and surfaces displaced, seed {}\n",
                        result.answer.band_options.samples, result.answer.band_options.seed);
  text +=
      "  normal ranges are of other people, each by a method of its own: --json has what and whose they "
      "are\n";
  return text + fmt::format("  {}\n", scope_text(joint));
}

io::Json io::measure_object(const MeasureResult& result) {
  const HipMeasures& measures = result.answer.measures;
  Json list = Json::array();
  for (std::size_t i = 0; i < measure_definitions().size(); ++i) {
    list.push_back(measure_entry(measure_definitions()[i], measures));
    list.back()["band"] =
        result.answer.bands.empty() ? Json(nullptr) : measure_band_json(result.answer.bands[i]);
  }
  Json json{{"condyle", io::format_version},
            {"joint", result.joint.name},
            {"fixed", result.joint.fixed.name},
            {"mobile", result.joint.mobile.name},
            {"side", name_of(result.joint.side)},
            {"pelvis_frame", stated_frame(measures)},
            {"pelvic_tilt_deg", measures.pelvic_tilt.degrees()},
            {"measures", std::move(list)},
            {"around_neck", neck_json(measures.femur)},
            {"rim", rim_json(measures.acetabulum)},
            {"geometry", geometry_json(measures)},
            {"notes", io::notes_json(result.notes)},
            {"scope", scope_text(result.joint)},
            {"provenance", io::provenance_json(result.provenance)}};
  io::drop_negative_zeros(json);
  return json;
}

std::string measure_json(const MeasureResult& result) {
  return io::document(io::measure_object(result));
}

std::string measures_csv(const MeasureResult& result) {
  std::string text =
      io::provenance_comments(result.provenance) +
      "key,part,value,unit,p5,p95,normal_low,normal_high,frame,why_none,note,definition,source\n";
  for (std::size_t i = 0; i < measure_definitions().size(); ++i) {
    const MeasureDefinition& each = measure_definitions()[i];
    const MeasureBand band = result.answer.bands.empty() ? MeasureBand{} : result.answer.bands[i];
    const Measure& measure = each.of(result.answer.measures);
    const auto normal = [&](double NormalRange::*end) {
      return each.normal ? fmt::format("{}", (*each.normal).*end) : "";
    };
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", each.key, heading_of(each.part),
                        csv_number(measure.value), each.unit, csv_number(band.p5), csv_number(band.p95),
                        normal(&NormalRange::low), normal(&NormalRange::high),
                        each.in_pelvis_frame ? io::csv_field(stated_frame(result.answer.measures)) : "",
                        io::csv_field(measure.why_none), io::csv_field(measure.note),
                        io::csv_field(each.definition), io::csv_field(each.source));
  }
  return text;
}

std::string neck_csv(const MeasureResult& result) {
  std::string text =
      io::provenance_comments(result.provenance) + "hour,alpha_deg,alpha_at_1mm_deg,is_doubtful,offset_mm\n";
  for (const NeckHour& at : result.answer.measures.femur.around_neck)
    text += fmt::format("{},{},{},{},{}\n", at.hour, csv_number(at.alpha_deg),
                        csv_number(at.alpha_at_1mm_deg), at.is_doubtful ? 1 : 0, csv_number(at.offset_mm));
  return text;
}

std::string rim_csv(const MeasureResult& result) {
  std::string text = io::provenance_comments(result.provenance) +
                     "hour,x_mm,y_mm,z_mm,cover_deg,centre_edge_deg,is_in_plane\n";
  for (const RimHour& at : result.answer.measures.acetabulum.rim)
    text += at.point ? fmt::format("{},{},{},{},{},{},{}\n", at.hour, at.point->x(), at.point->y(),
                                   at.point->z(), at.cover_deg, at.centre_edge_deg, at.is_in_plane ? 1 : 0)
                     : fmt::format("{},,,,,,0\n", at.hour);
  return text;
}

void check_measure_folder(const std::filesystem::path& folder, const Provenance* from) {
  OutputFolder{folder, is_of_measure, io::files_read(from)};
}

std::vector<std::filesystem::path> write_measures(const std::filesystem::path& folder,
                                                  const MeasureResult& result) {
  OutputFolder out(folder, is_of_measure, io::files_read(result.provenance), "measures.json");
  io::write_whole_file(out.file("measures.json"), measure_json(result));
  io::write_whole_file(out.file("measures.csv"), measures_csv(result));
  if (!result.answer.measures.femur.around_neck.empty())
    io::write_whole_file(out.file("neck.csv"), neck_csv(result));
  if (!result.answer.measures.acetabulum.rim.empty())
    io::write_whole_file(out.file("rim.csv"), rim_csv(result));
  return out.commit();
}

}  // namespace condyle
