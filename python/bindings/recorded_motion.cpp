#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <limits>
#include <utility>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/recorded_motion.hpp"
#include "condyle/motion_contact.hpp"
#include "interrupts.hpp"
#include "io/result/motion_result.hpp"
#include "motion.hpp"
#include "surface_contact.hpp"

namespace condyle::python {
namespace {

py::dict table_of(const std::filesystem::path& path) {
  io::MotionTable table = without_lock([&] { return io::read_motion_table(path); });
  py::dict columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    columns[py::str(table.columns[i])] = array_of(std::move(table.values[i]));
  py::dict dict;
  dict["columns"] = columns;
  dict["in_degrees"] = table.in_degrees;
  dict["processing"] = table.processing;
  return dict;
}

/// Times and (N, 4, 4) poses, NaN for gaps; velocities (N, 3) if the file has speeds, else None.
py::dict motion_of_file(const JointHandle& handle, const std::filesystem::path& path) {
  auto [motion, speeds] = without_lock([&] {
    const io::MotionTable table = io::read_motion_table(path);
    return std::pair(io::motion_of(handle.loaded, table), io::recorded_speeds(handle.loaded, table));
  });
  const auto velocity = [&speeds = speeds](Vec3 RelativeMotion::*member) -> py::object {
    if (speeds.empty()) return py::none();
    Points points;
    for (const auto& at : speeds)
      points.push_back(at ? (*at).*member : Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
    return array_of(points);
  };
  const auto count = static_cast<py::ssize_t>(motion.X_FM.size());
  py::array_t<double> poses({count, py::ssize_t{4}, py::ssize_t{4}});
  auto values = poses.mutable_unchecked<3>();
  for (py::ssize_t n = 0; n < count; ++n)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const auto& pose = motion.X_FM[static_cast<std::size_t>(n)];
        values(n, i, j) = pose ? pose->matrix()(i, j) : std::numeric_limits<double>::quiet_NaN();
      }
  py::dict dict;
  dict["in_seconds"] = motion.times.in_seconds;
  dict["time"] = array_of(std::move(motion.times.values));
  dict["X_FM"] = poses;
  dict["velocity_mm_s"] = velocity(&RelativeMotion::velocity_mm_s);
  dict["angular_velocity_rad_s"] = velocity(&RelativeMotion::angular_velocity_rad_s);
  dict["processing"] = motion.processing;
  dict["notes"] = notes_of(motion.notes);
  return dict;
}

py::dict dict_of_end(const motion::ContactEnd& end, io::ContactEndRole role) {
  py::dict dict;
  dict["kind"] = name_of(end.kind, role);
  dict["time_s"] = end.time_s;
  dict["uncertainty_s"] = end.kind == motion::ContactEndKind::recording
                              ? py::object(py::none())
                              : py::object(py::float_(end.uncertainty_s));
  dict["sample"] = end.sample;
  dict["turned_deg"] = end.turned.degrees();
  dict["contact"] = dict_of(end.contact);
  return dict;
}

py::dict recorded(const JointHandle& handle, const py::object& time_s, const py::object& given,
                  double resolution_s, const py::object& progress) {
  const std::vector<double> times = doubles_in(time_s, "time_s");
  const PosesIn in = poses_in(given, "poses");
  const auto found = with_progress(progress, [&](const Control& control) {
    return motion::contact_between(handle.contact, times, in.poses,
                                   motion::RecordedContactOptions{resolution_s}, control);
  });
  py::list contacts;
  for (const motion::ContactInterval& interval : found->contacts) {
    py::dict dict;
    dict["entry"] = dict_of_end(interval.entry, io::ContactEndRole::entry);
    dict["exit"] = dict_of_end(interval.exit, io::ContactEndRole::exit);
    dict["is_certain"] = interval.is_certain;
    dict["undecided_s"] = interval.undecided_s;
    contacts.append(dict);
  }
  py::dict dict;
  dict["contacts"] = contacts;
  dict["searched"] = bytes_of(found->searched);
  dict["poses"] = found->poses;
  return dict;
}

}  // namespace

void bind_recorded_motion(py::module_& module) {
  module.def("read_motion_table", &table_of);
  module.def("motion_of", &motion_of_file);
  module.def("contact_between", &recorded);
}

}  // namespace condyle::python
