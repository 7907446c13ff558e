#include "condyle/motion_map.hpp"

#include <limits>

#include "arrays.hpp"
#include "bindings.hpp"
#include "interrupts.hpp"
#include "motion.hpp"
#include "range_answer.hpp"

namespace condyle::python {
namespace {

motion::GridAxis axis_in(const py::tuple& given) {
  return {angle_numbered(given[0].cast<std::size_t>()), given[1].cast<double>(), given[2].cast<double>(),
          given[3].cast<double>()};
}

py::array values_of(const motion::GridAxis& axis) {
  std::vector<double> values(axis.count());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = axis.value_deg(i);
  return array_of(std::move(values));
}

/// One end of a rotation at every point.
struct Ends {
  std::vector<double> turned_deg, error_bound_deg, bearing_contact_deg;
  std::vector<std::int8_t> reason, kind;
  Points fixed_point;

  void add(const motion::Limit& limit, const io::AnswerFrame& frame) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    turned_deg.push_back(limit.turned.degrees());
    error_bound_deg.push_back(limit.error_bound.degrees());
    bearing_contact_deg.push_back(limit.bearing_contact ? limit.bearing_contact->turned.degrees() : none);
    reason.push_back(static_cast<std::int8_t>(limit.reason));
    kind.push_back(static_cast<std::int8_t>(limit.kind()));
    fixed_point.push_back(limit.contact ? frame.fixed_point(limit.contact->fixed_point)
                                        : Vec3::Constant(none));
  }

  py::dict dict() && {
    py::dict dict;
    dict["turned_deg"] = array_of(std::move(turned_deg));
    dict["reason"] = array_of(std::move(reason));
    dict["kind"] = array_of(std::move(kind));
    dict["error_bound_deg"] = array_of(std::move(error_bound_deg));
    dict["bearing_contact_deg"] = array_of(std::move(bearing_contact_deg));
    dict["fixed_point"] = array_of(fixed_point);
    return dict;
  }
};

py::dict dict_of_map(const motion::MotionMap& map, const io::AnswerFrame& frame) {
  Ends negative, positive;
  std::vector<std::int64_t> offset{0};
  std::vector<double> low_deg, high_deg;
  for (const motion::FreeAngles& point : map.points) {
    negative.add(point.from_start.negative, frame);
    positive.add(point.from_start.positive, frame);
    for (const motion::FreeInterval& interval : point.intervals) {
      low_deg.push_back(interval.low.degrees());
      high_deg.push_back(interval.high.degrees());
    }
    offset.push_back(static_cast<std::int64_t>(low_deg.size()));
  }
  const motion::FreeVolume volume = motion::free_volume(map);
  py::dict dict;
  dict["row_deg"] = values_of(map.grid.row);
  dict["column_deg"] = values_of(map.grid.column);
  dict["negative"] = std::move(negative).dict();
  dict["positive"] = std::move(positive).dict();
  dict["offset"] = array_of(std::move(offset));
  dict["low_deg"] = array_of(std::move(low_deg));
  dict["high_deg"] = array_of(std::move(high_deg));
  dict["free_volume_deg3"] = volume.plain_deg3;
  dict["weighted_free_volume_deg3"] = volume.weighted_deg3;
  dict["row_area_deg2"] = array_of(std::vector<double>(volume.row_area_deg2));
  return dict;
}

py::dict map_of(const RangeHandle& handle, const py::tuple& row, const py::tuple& column, std::size_t vary,
                double start_deg, double negative_deg, double positive_deg, const py::object& progress) {
  const motion::MapGrid grid{.row = axis_in(row),
                             .column = axis_in(column),
                             .vary = angle_numbered(vary),
                             .start = Angle::degrees(start_deg),
                             .range = {Angle::degrees(negative_deg), Angle::degrees(positive_deg)}};
  motion::check_grid(grid, handle.answer.joint.kind);
  const auto map = followed(progress, [&](const auto& report, const std::stop_token& stop) {
    return motion::motion_map(grid, *handle.answer.range, {.progress = report, .stop = stop});
  });
  return dict_of_map(*map, io::frame_of(handle.result()));
}

py::list bands_of(const RangeHandle& handle, const py::list& given, std::size_t samples, std::uint64_t seed,
                  double centre_mm, double axes_deg, double surface_mm, double surface_voxels,
                  const py::object& progress) {
  const std::vector<motion::Motion> motions = motions_in(given);
  const motion::BandOptions options{
      .sigma = {centre_mm, Angle::degrees(axes_deg), surface_mm, surface_voxels},
      .samples = samples,
      .seed = seed};
  const auto bands = followed(progress, [&](const auto& report, const std::stop_token& stop) {
    return motion::limit_bands(handle.answer.joint, motions, handle.options(), options,
                               {.progress = report, .stop = stop});
  });
  py::list list;
  for (const motion::LimitBand& band : *bands) {
    py::dict dict;
    dict["p5_deg"] = band.p5.degrees();
    dict["median_deg"] = band.median.degrees();
    dict["p95_deg"] = band.p95.degrees();
    dict["width_from_centre_deg"] = band.width_from.centre.degrees();
    dict["width_from_axes_deg"] = band.width_from.axes.degrees();
    dict["width_from_surface_deg"] = band.width_from.surface.degrees();
    dict["width_from_parameters_deg"] = band.width_from.parameters.degrees();
    dict["share_without_contact"] = band.share_without_contact;
    dict["share_in_contact_at_start"] = band.share_in_contact_at_start;
    list.append(dict);
  }
  return list;
}

}  // namespace

void bind_motion_map(py::module_& module) {
  module.def("motion_map", &map_of);
  module.def("limit_bands", &bands_of);
  module.def("uncertainty", [](const JointHandle& handle) {
    const io::JointFile& file = handle.loaded.report.file;
    const motion::Uncertainty& sigma = file.uncertainty;
    return py::make_tuple(sigma.centre_mm, sigma.axes.degrees(), sigma.surface_mm, file.band_seed,
                          sigma.surface_voxels);
  });
}

}  // namespace condyle::python
