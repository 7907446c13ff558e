#include "condyle/motion_map.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <limits>

#include "answer/limit_facts.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "interrupts.hpp"
#include "io/record/json_of.hpp"
#include "io/result/limit_files.hpp"
#include "json_object.hpp"
#include "motion.hpp"
#include "range_answer.hpp"

namespace condyle::python {
namespace {

/// The three angles, then x, y and z.
motion::MapCoordinate coordinate_numbered(std::size_t number) {
  if (number < 3) return angle_numbered(number);
  return motion::MapCoordinate::translation(static_cast<int>(number) - 3);
}

motion::GridAxis axis_in(const py::tuple& given) {
  return {coordinate_numbered(given[0].cast<std::size_t>()), given[1].cast<double>(), given[2].cast<double>(),
          given[3].cast<double>()};
}

py::array values_of(const motion::GridAxis& axis) {
  std::vector<double> values(axis.count());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = axis.value(i);
  return array_of(std::move(values));
}

/// One end of a rotation, or of a slide, at every point.
struct Ends {
  std::vector<double> moved, error_bound, bearing_contact;
  std::vector<std::int8_t> reason, kind;
  std::vector<std::int32_t> ligament;
  Points fixed_point;

  void add(const motion::MapEnd& limit, const io::AnswerFrame& frame) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    moved.push_back(std::abs(limit.from_start));
    error_bound.push_back(limit.error_bound);
    bearing_contact.push_back(limit.bearing_contact.value_or(none));
    reason.push_back(static_cast<std::int8_t>(limit.reason));
    kind.push_back(static_cast<std::int8_t>(limit.kind()));
    ligament.push_back(limit.ligament ? static_cast<std::int32_t>(*limit.ligament) : -1);
    fixed_point.push_back(limit.contact ? frame.fixed_point(limit.contact->fixed_point)
                                        : Vec3::Constant(none));
  }

  py::dict dict() && {
    py::dict dict;
    dict["moved"] = array_of(std::move(moved));
    dict["reason"] = array_of(std::move(reason));
    dict["kind"] = array_of(std::move(kind));
    dict["error_bound"] = array_of(std::move(error_bound));
    dict["bearing_contact"] = array_of(std::move(bearing_contact));
    dict["fixed_point"] = array_of(fixed_point);
    dict["ligament"] = array_of(std::move(ligament));
    return dict;
  }
};

py::dict dict_of_map(const motion::MotionMap& map, const io::AnswerFrame& frame) {
  Ends negative, positive;
  std::vector<std::int64_t> offset{0};
  std::vector<double> low, high;
  for (std::size_t i = 0; i < map.grid.size(); ++i) {
    const motion::MapPoint point = map.point(i);
    negative.add(point.negative, frame);
    positive.add(point.positive, frame);
    for (const motion::MapInterval& interval : point.intervals) {
      low.push_back(interval.low.from_start);
      high.push_back(interval.high.from_start);
    }
    offset.push_back(static_cast<std::int64_t>(low.size()));
  }
  const motion::FreeVolume volume = motion::free_volume(map);
  py::dict dict;
  dict["row_values"] = values_of(map.grid.row);
  dict["column_values"] = values_of(map.grid.column);
  dict["negative"] = std::move(negative).dict();
  dict["positive"] = std::move(positive).dict();
  dict["offset"] = array_of(std::move(offset));
  dict["low"] = array_of(std::move(low));
  dict["high"] = array_of(std::move(high));
  dict["free_volume_deg3"] = volume.plain_deg3;
  dict["weighted_free_volume_deg3"] = volume.weighted_deg3;
  dict["row_area_deg2"] = array_of(std::vector<double>(volume.row_area_deg2));
  dict["held_translation_mm"] =
      std::vector<double>(map.grid.held.translation_mm.begin(), map.grid.held.translation_mm.end());
  return dict;
}

py::dict map_of(const RangeHandle& handle, const py::tuple& row, const py::tuple& column, std::size_t vary,
                double start_deg, const py::object& held_deg, const py::object& progress) {
  const motion::MapGrid grid{.row = axis_in(row),
                             .column = axis_in(column),
                             .vary = coordinate_numbered(vary),
                             .start = Angle::degrees(start_deg),
                             .held = {.angles = angles_in(held_deg, "held_deg")}};
  const RangeAnswer found = further_answered(handle, {.map = grid}, progress);
  py::dict dict = dict_of_map(*found.map, io::frame_of(handle.result()));
  dict["notes"] = notes_of(found.notes);
  return dict;
}

/// Python's rows and columns, and the angle that varies.
motion::MapGrid grid_in(const py::tuple& given) {
  const auto axes = given[0].cast<py::tuple>();
  return {.row = axis_in(axes[0].cast<py::tuple>()),
          .column = axis_in(axes[1].cast<py::tuple>()),
          .vary = coordinate_numbered(given[1].cast<std::size_t>())};
}

py::dict write_limits(const RangeHandle& handle, const JointHandle& joint, const std::filesystem::path& path,
                      bool is_living, bool is_linear, bool in_radians,
                      const std::optional<std::filesystem::path>& model, const std::optional<py::tuple>& grid,
                      const py::object& progress) {
  const io::LimitFile file{path, is_linear ? io::StopForce::linear : io::StopForce::limit, model,
                           is_living ? LimitSource::living : LimitSource::bony,
                           in_radians ? io::AngleUnit::radians : io::AngleUnit::degrees};
  const io::LimitCoordinates known_by =
      io::limit_coordinates(joint.loaded, file, nullptr, handle.request.translation_mm.has_value());
  RangeRequest beside;
  if (grid) beside.map = grid_in(*grid);
  const RangeAnswer found = further_answered(handle, beside, progress);
  RangeRequest request = handle.request;
  if (grid) request.map = beside.map;
  const LimitBoxRecord box = *with_progress(progress, [&](const Control& control) {
    return io::limit_box(known_by, handle.asked, found, request, file.source, control);
  });
  io::write_limits(file, box, joint.loaded, known_by, nullptr);
  return object_of(io::json_of(box, {io::frame_of(handle.result()), handle.answer.joint.anatomy}));
}

py::list bands_of(const RangeHandle& handle, const py::list& motions, const py::object& band,
                  const py::object& progress) {
  const RangeAnswer found =
      further_answered(handle, {.motions = motions_in(motions), .bands = band_in(band)}, progress);
  py::list list;
  for (std::size_t i = 0; i < found.bands.size(); ++i) {
    const motion::LimitBand& of_limit = found.bands[i];
    const motion::Motion& motion = found.limits[i].motion;
    py::dict dict;
    dict["p5_deg"] = degrees_turned(of_limit.p5, motion);
    dict["median_deg"] = degrees_turned(of_limit.median, motion);
    dict["p95_deg"] = degrees_turned(of_limit.p95, motion);
    dict["text"] = quoted_band(of_limit, motion);
    dict["width_from_centre_deg"] = of_limit.width_from.centre.degrees();
    dict["width_from_axes_deg"] = of_limit.width_from.axes.degrees();
    dict["width_from_surface_deg"] = of_limit.width_from.surface.degrees();
    dict["width_from_parameters_deg"] = of_limit.width_from.parameters.degrees();
    dict["share_without_contact"] = of_limit.share_without_contact;
    dict["share_in_contact_at_start"] = of_limit.share_in_contact_at_start;
    list.append(dict);
  }
  return list;
}

}  // namespace

void bind_motion_map(py::module_& module) {
  module.def("motion_map", &map_of);
  module.def("write_limits", &write_limits);
  module.def("limit_bands", &bands_of);
}

}  // namespace condyle::python
