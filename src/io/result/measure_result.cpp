#include "io/result/measure_result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "answer/records/measure_record.hpp"
#include "condyle/io/pose_text.hpp"
#include "io/file/csv_fields.hpp"
#include "io/file/format_version.hpp"
#include "io/file/output_folder.hpp"
#include "io/file/whole_file.hpp"
#include "io/record/json_of.hpp"
#include "io/result/json.hpp"
#include "io/result/json_objects.hpp"
#include "io/result/measure_geometry.hpp"
#include "io/result/parameters.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/scope_text.hpp"

namespace condyle::io {
namespace {

using io::Json;

/// By which axes acetabular angles are measured, and what to think of them.
std::string pelvis_text(const measure::HipMeasures& measures) {
  const char* warning = measures.pelvis_frame.empty()
                            ? ": the pelvis may have lain turned, and acetabular angles turn with it"
                            : "";
  return measure::stated_frame(measures) + warning;
}

/// Each sentence with the keys of its measures, in their order: "alpha_12_deg, alpha_3_deg".
std::vector<std::pair<std::string, std::string>> keys_by_sentence(const measure::HipMeasures& measures,
                                                                  std::string measure::Measure::*sentence) {
  std::vector<std::pair<std::string, std::string>> keys_of;
  for (const measure::MeasureDefinition& each : measure::measure_definitions()) {
    const std::string& said = each.of(measures).*sentence;
    if (said.empty()) continue;
    const auto known =
        std::find_if(keys_of.begin(), keys_of.end(), [&](const auto& one) { return one.first == said; });
    if (known == keys_of.end())
      keys_of.emplace_back(said, each.key);
    else
      known->second += fmt::format(", {}", each.key);
  }
  return keys_of;
}

/// "    alpha_12_deg, alpha_3_deg: ...", a line for each sentence.
std::string by_sentence(const measure::HipMeasures& measures, std::string measure::Measure::*sentence) {
  std::string text;
  for (const auto& [said, keys] : keys_by_sentence(measures, sentence))
    text += fmt::format("    {}: {}\n", keys, said);
  return text;
}

/// "1070 data sets of skeletally mature femora".
std::string people_of(const measure::NormalRange& range) {
  return range.count > 0 ? fmt::format("{} {}", range.count, range.people) : std::string(range.people);
}

/// Definition of each measure, its planes and axes, and the source of its normal range.
std::string definitions_text(const measure::HipMeasures& measures) {
  std::string text = "  definitions:\n";
  for (const measure::MeasureDefinition& each : measure::measure_definitions()) {
    text += fmt::format("    {}: {}\n      by {}{}; {}\n", each.key, each.definition, each.measured_by,
                        each.in_pelvis_frame ? fmt::format(" ({})", measure::stated_frame(measures)) : "",
                        each.source);
    if (each.normal)
      text +=
          fmt::format("      {} {:g} to {:g} of {}: {}; {}\n",
                      each.normal->are_patients ? "patients" : "normal", each.normal->low, each.normal->high,
                      people_of(*each.normal), each.normal->meaning, each.normal->source);
  }
  return text;
}

/// With as many digits as its unit is read with.
std::string measured_number(const measure::MeasureDefinition& definition, double value) {
  return fmt::format("{:.{}f}", value, definition.unit == "1" ? 3 : definition.unit == "h" ? 2 : 1);
}

std::string measured_value(const measure::MeasureDefinition& definition, const measure::Measure& measure) {
  if (!measure.value) return "-";
  return measured_number(definition, *measure.value) +
         (definition.unit == "1" ? "" : fmt::format(" {}", definition.unit));
}

/// "41.2 to 47.9", or nothing.
std::string measure_band_text(const measure::MeasureDefinition& definition,
                              const measure::MeasureBand& band) {
  if (!band.p5 || !band.p95) return "-";
  return measured_number(definition, *band.p5) + " to " + measured_number(definition, *band.p95);
}

std::string normal_text(const measure::MeasureDefinition& definition) {
  const std::optional<measure::NormalRange>& range = definition.normal;
  return range && !range->are_patients ? fmt::format("{:g} to {:g}", range->low, range->high) : "";
}

/// Why measures have no value, as notes: a sentence with the keys that it is the reason of.
Json notes_on_none(const measure::HipMeasures& measures) {
  Json notes = Json::array();
  for (const auto& [why, keys] : keys_by_sentence(measures, &measure::Measure::why_none))
    notes.push_back({{"code", "not_measured"}, {"text", keys + ": " + why}});
  return notes;
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

std::string measure_text(const MeasureResult& result, bool with_definitions) {
  const Joint& joint = result.joint;
  std::string text = fmt::format("{}: measures of {} and {}, {} side{}\n", joint.name, joint.mobile.name,
                                 joint.fixed.name, name_of(joint.side), whose_text(joint));
  text += io::parameters_text(joint);
  text += fmt::format("  pelvis: {}\n", pelvis_text(result.answer.measures));
  std::size_t widest = 0;
  for (const measure::MeasureDefinition& each : measure::measure_definitions())
    widest = std::max(widest, each.key.size());
  std::string_view heading;
  const bool has_bands = !result.answer.bands.empty();
  for (std::size_t i = 0; i < measure::measure_definitions().size(); ++i) {
    const measure::MeasureDefinition& each = measure::measure_definitions()[i];
    if (heading != name_of(each.part)) {
      heading = name_of(each.part);
      text += fmt::format("  {:<{}}  {:>10}{}  normal\n", heading, widest + 2, "",
                          has_bands ? fmt::format("  {:<16}", "5 to 95 %") : "");
    }
    const measure::Measure& measure = each.of(result.answer.measures);
    const std::string band =
        has_bands ? fmt::format("  {:<16}", measure_band_text(each, result.answer.bands[i])) : "";
    std::string line = fmt::format("    {:<{}}  {:>10}{}  {}", each.key, widest,
                                   measured_value(each, measure), band, normal_text(each));
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  if (const std::string reasons = by_sentence(result.answer.measures, &measure::Measure::why_none);
      !reasons.empty())
    text += "  cannot be computed:\n" + reasons;
  std::string notes;
  for (const std::string& sentence : result.answer.measures.left_out)
    notes += fmt::format("    {}\n", sentence);
  notes += by_sentence(result.answer.measures, &measure::Measure::note);
  if (!notes.empty()) text += "  to be read with:\n" + notes;
  if (has_bands)
    text += fmt::format("  5 to 95 % of {} joints with centre, axes and surfaces displaced, seed {}\n",
                        result.answer.band_options.samples, result.answer.band_options.seed);
  text +=
      "  normal ranges are of other people, each by a method of its own; those of patients are not called "
      "normal: "
      "--definitions has whose, and what each measure is\n";
  if (with_definitions) text += definitions_text(result.answer.measures);
  return text + fmt::format("  {}\n", scope_text(joint));
}

Json measure_object(const MeasureResult& result) {
  Json json{{"condyle", io::format_version},
            {"joint", result.joint.name},
            {"fixed", result.joint.fixed.name},
            {"mobile", result.joint.mobile.name},
            {"side", name_of(result.joint.side)}};
  json.update(json_of(shape_record(result.answer), {{}, result.joint.anatomy}));
  json["geometry"] = io::measure_geometry(result.answer.measures);
  json["notes"] = io::notes_json(result.notes);
  json["scope"] = scope_text(result.joint);
  json["provenance"] = io::provenance_json(result.provenance);
  for (Json& note : notes_on_none(result.answer.measures)) json["notes"].push_back(std::move(note));
  io::drop_negative_zeros(json);
  return json;
}

std::string measure_json(const MeasureResult& result) {
  return io::document(io::measure_object(result));
}

std::string measures_csv(const MeasureResult& result) {
  std::string text = io::provenance_comments(result.provenance, result.notes);
  for (const std::string& sentence : result.answer.measures.left_out)
    text += fmt::format("# left_out: {}\n", sentence);
  text +=
      "key,part,value,unit,p5,median,p95,samples_without_value,normal_low,normal_high,normal_people,"
      "normal_meaning,normal_source,patients_low,patients_high,frame,measured_by,why_none,note,definition,"
      "source\n";
  const ShapeRecord shape = shape_record(result.answer);
  for (std::size_t i = 0; i < shape.measures.size(); ++i) {
    const MeasureRecord& each = shape.measures[i];
    const std::optional<measure::NormalRange>& range = measure::measure_definitions()[i].normal;
    const auto& [p5, median, p95, samples_without_value] = each.band.value_or(measure::MeasureBand{});
    const auto ends_of = [](const std::optional<NormalRangeRecord>& people) {
      return people ? fmt::format("{},{}", people->low, people->high) : ",";
    };
    text += csv_line(
        {std::string(each.key), std::string(name_of(each.part)), csv_number(each.value),
         std::string(each.unit), csv_number(p5), csv_number(median), csv_number(p95),
         each.band ? fmt::format("{}", samples_without_value) : "", ends_of(each.normal),
         range ? csv_field(people_of(*range)) : "", range ? csv_field(range->meaning) : "",
         range ? csv_field(range->source) : "", ends_of(each.patients), csv_field(each.frame.value_or("")),
         csv_field(measure::measure_definitions()[i].measured_by), csv_field(each.why_none.value_or("")),
         csv_field(each.note.value_or("")), csv_field(each.definition), csv_field(each.source)});
  }
  return text;
}

std::string neck_csv(const MeasureResult& result) {
  std::string text =
      io::provenance_comments(result.provenance) + "hour,alpha_deg,alpha_at_1mm_deg,is_doubtful,offset_mm\n";
  for (const measure::NeckHour& at : result.answer.measures.femur.around_neck)
    text += fmt::format("{},{},{},{},{}\n", at.hour, csv_number(at.alpha_deg),
                        csv_number(at.alpha_at_1mm_deg), at.is_doubtful ? 1 : 0, csv_number(at.offset_mm));
  return text;
}

std::string rim_csv(const MeasureResult& result) {
  std::string text = io::provenance_comments(result.provenance) +
                     "hour,x_mm,y_mm,z_mm,cover_deg,centre_edge_deg,is_in_plane\n";
  for (const measure::RimHour& at : result.answer.measures.acetabulum.rim)
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

}  // namespace condyle::io
