#include "condyle/answer.hpp"

#include <limits>

#include "arrays.hpp"
#include "bindings.hpp"
#include "interrupts.hpp"
#include "io/result/measure_result.hpp"
#include "range_answer.hpp"

namespace condyle::python {
namespace {

constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

/// (key, part, unit, value or None, why none, note, definition, measured by, source, in the pelvis frame, (low, high, meaning, source) or None).
py::tuple measure_tuple(const measure::MeasureDefinition& each, const measure::HipMeasures& measures) {
  const measure::Measure& measure = each.of(measures);
  const auto text = [](std::string_view view) { return py::str(view.data(), view.size()); };
  const py::object normal =
      each.normal
          ? py::object(py::make_tuple(
                each.normal->low, each.normal->high, text(each.normal->people),
                each.normal->count > 0 ? py::object(py::int_(each.normal->count)) : py::object(py::none()),
                text(each.normal->meaning), text(each.normal->source)))
          : py::none();
  return py::make_tuple(text(each.key), text(name_of(each.part)), text(each.unit),
                        optional_number(measure.value), measure.why_none, measure.note, text(each.definition),
                        text(each.measured_by), text(each.source), each.in_pelvis_frame, normal,
                        each.normal && each.normal->are_patients);
}

/// A column of one number per direction, NaN where there is none.
template <class Hours, class Read>
py::array column_of(const Hours& hours, const Read& read) {
  std::vector<double> values;
  for (const auto& at : hours) {
    const std::optional<double> value = read(at);
    values.push_back(value.value_or(not_measured));
  }
  return array_of(std::move(values));
}

/// A column of one flag per direction.
template <class Hours, class Read>
py::array flags_of(const Hours& hours, const Read& read) {
  py::array_t<bool> flags(static_cast<py::ssize_t>(hours.size()));
  for (std::size_t i = 0; i < hours.size(); ++i)
    flags.mutable_at(static_cast<py::ssize_t>(i)) = read(hours[i]);
  return flags;
}

/// (p5, median, p95, samples without a value), or None.
py::object band_tuple(const std::vector<measure::MeasureBand>& bands, std::size_t i) {
  if (bands.empty()) return py::none();
  const measure::MeasureBand& band = bands[i];
  return py::make_tuple(optional_number(band.p5), optional_number(band.median), optional_number(band.p95),
                        band.samples_without_value);
}

py::dict measures_of(const JointHandle& handle, double pelvic_tilt_deg, const py::object& band,
                     const py::object& progress) {
  const MeasureRequest request{Angle::degrees(pelvic_tilt_deg), band_in(band)};
  const MeasureAnswer answer = *with_progress(
      progress, [&](const Control& control) { return answer_measures(handle.loaded, request, control); });
  const measure::HipMeasures& measures = answer.measures;
  py::list list;
  for (std::size_t i = 0; i < measure::measure_definitions().size(); ++i)
    list.append(py::make_tuple(measure_tuple(measure::measure_definitions()[i], measures),
                               band_tuple(answer.bands, i)));
  const auto& neck = measures.femur.around_neck;
  const auto& rim = measures.acetabulum.rim;
  Points points(rim.size());
  for (std::size_t i = 0; i < rim.size(); ++i)
    points.set(i, rim[i].point.value_or(Vec3(Vec3::Constant(not_measured))));
  const auto if_there = [](const measure::RimHour& at, double value) {
    return at.point ? std::optional(value) : std::nullopt;
  };
  py::dict dict;
  dict["measures"] = list;
  dict["left_out"] = py::tuple(py::cast(measures.left_out));
  dict["geometry"] = io::measure_geometry_json(measures);
  dict["pelvis_frame"] = measure::stated_frame(measures);
  dict["neck_hour"] = column_of(neck, [](const measure::NeckHour& at) { return std::optional(at.hour); });
  dict["alpha_deg"] = column_of(neck, [](const measure::NeckHour& at) { return at.alpha_deg; });
  dict["alpha_at_1mm_deg"] = column_of(neck, [](const measure::NeckHour& at) { return at.alpha_at_1mm_deg; });
  dict["is_doubtful"] = flags_of(neck, [](const measure::NeckHour& at) { return at.is_doubtful; });
  dict["offset_mm"] = column_of(neck, [](const measure::NeckHour& at) { return at.offset_mm; });
  dict["rim_hour"] = column_of(rim, [](const measure::RimHour& at) { return std::optional(at.hour); });
  dict["rim_points"] = array_of(points);
  dict["is_in_plane"] = flags_of(rim, [](const measure::RimHour& at) { return at.is_in_plane; });
  dict["cover_deg"] = column_of(rim, [&](const measure::RimHour& at) { return if_there(at, at.cover_deg); });
  dict["centre_edge_deg"] =
      column_of(rim, [&](const measure::RimHour& at) { return if_there(at, at.centre_edge_deg); });
  return dict;
}

}  // namespace

void bind_measures(py::module_& module) {
  module.def("hip_measures_of", &measures_of);
}

}  // namespace condyle::python
