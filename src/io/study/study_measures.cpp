#include "io/study/study_measures.hpp"

#include <fmt/format.h>

#include <cmath>

#include "condyle/answer.hpp"
#include "condyle/error.hpp"
#include "io/file/csv_fields.hpp"
#include "io/file/in_quotes.hpp"
#include "io/mesh/parse.hpp"

namespace condyle::io {
namespace {

constexpr const char* tilt_column = "pelvic_tilt_deg";

/// Tables of samples have columns by the names of measures: what was asked for, which is not what is measured.
std::string column_name(const measure::MeasureDefinition& definition, const char* of_band = "") {
  return fmt::format("measured_{}{}", definition.key, of_band);
}

std::string number_or_empty(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "";
}

Angle tilt_in(const StudyTable& table, const StudyRow& row) {
  const std::string_view text = table.field(row, tilt_column);
  double degrees = 0;
  if (!text.empty() &&
      !(parse_number(text, degrees) && std::abs(degrees) <= measure::largest_pelvic_tilt_deg))
    throw FileError(fmt::format("{}: {} is no number of degrees from {:g} to {:g}",
                                table.place(row, tilt_column), in_quotes(text),
                                -measure::largest_pelvic_tilt_deg, measure::largest_pelvic_tilt_deg));
  return Angle::degrees(degrees);
}

/// "alpha_3_deg: ...; alpha_largest_deg: ...", of the measures that have such a sentence.
std::string sentences(const measure::HipMeasures& measures, std::string measure::Measure::*sentence) {
  std::string text;
  for (const measure::MeasureDefinition& each : measure::measure_definitions())
    if (const std::string& said = each.of(measures).*sentence; !said.empty())
      text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", each.key, said);
  return csv_field(text);
}

/// All that a measure's row in the files of one joint says of it.
std::string meaning_of(const measure::MeasureDefinition& each) {
  std::string text = fmt::format("{}; by {}; {}", each.definition, each.measured_by, each.source);
  if (each.normal)
    text += fmt::format("; normal {:g} to {:g}: {}; {}", each.normal->low, each.normal->high,
                        each.normal->meaning, each.normal->source);
  return text;
}

/// The sentences of a list as one text.
std::string joined(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += (text.empty() ? "" : "; ") + sentence;
  return text;
}

}  // namespace

std::vector<ResultColumn> measure_columns(bool with_bands) {
  std::vector<ResultColumn> columns;
  for (const measure::MeasureDefinition& each : measure::measure_definitions()) {
    const std::string unit(each.unit == "1" ? "" : each.unit);
    columns.push_back({column_name(each), unit, number_column, meaning_of(each)});
    if (!with_bands) continue;
    columns.push_back({column_name(each, "_p5"), unit, number_column, "5 % of the varied joints"});
    columns.push_back({column_name(each, "_p95"), unit, number_column, "95 % of the varied joints"});
  }
  columns.push_back({"measured_frame", "", text_column, "frame of the measures that turn with the pelvis"});
  columns.push_back({"measured_left_out", "", text_column, "pieces of the meshes that are not measured"});
  columns.push_back({"measured_notes", "", text_column, "what measures must be read with, by their keys"});
  columns.push_back({"measured_none", "", text_column, "why measures are empty, by their keys"});
  return columns;
}

std::optional<std::vector<std::string>> measure_fields(const StudyTable& table, const StudyRow& row,
                                                       const LoadedJoint& loaded,
                                                       const std::optional<BandRequest>& of_bands,
                                                       std::stop_token stop) {
  const auto answer = answer_measures(loaded, {tilt_in(table, row), of_bands}, {.stop = stop});
  if (!answer) return std::nullopt;
  const auto& [measures, bands, band_options] = *answer;
  std::vector<std::string> fields;
  for (std::size_t i = 0; i < measure::measure_definitions().size(); ++i) {
    fields.push_back(number_or_empty(measure::measure_definitions()[i].of(measures).value));
    if (bands.empty()) continue;
    fields.push_back(number_or_empty(bands[i].p5));
    fields.push_back(number_or_empty(bands[i].p95));
  }
  fields.push_back(csv_field(measure::stated_frame(measures)));
  fields.push_back(csv_field(joined(measures.left_out)));
  fields.push_back(sentences(measures, &measure::Measure::note));
  fields.push_back(sentences(measures, &measure::Measure::why_none));
  return fields;
}

}  // namespace condyle::io
