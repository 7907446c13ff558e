#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/answer.hpp"
#include "core/parallel.hpp"
#include "interrupts.hpp"
#include "io/result/touch_result.hpp"
#include "json_object.hpp"

namespace condyle::python {
namespace {

/// Poses between two looks at Ctrl-C.
constexpr std::size_t poses_at_a_time = 64;

/// What `condyle touch`, `turn` or `slide` says, of each pose.
template <class Ask>
py::tuple of_each(const py::object& given, const py::object& progress, const Ask& ask) {
  const PosesIn in = poses_in(given, "pose");
  std::vector<io::Json> said(in.poses.size());
  Follower follower(progress, said.size());
  {
    const py::gil_scoped_release released;
    for (std::size_t first = 0; first < said.size(); first += poses_at_a_time) {
      const std::size_t count = std::min(poses_at_a_time, said.size() - first);
      core::parallel_chunks(count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) said[first + i] = ask(in.poses[first + i]);
      });
      follower.poll(first + count);
    }
  }
  py::list answers;
  for (io::Json& each : said) answers.append(object_of(std::move(each)));
  return py::make_tuple(in.is_one, answers);
}

py::tuple touch(const Mesh& fixed, const Mesh& mobile, const py::object& pose, const py::object& along,
                bool measures, const py::object& centre, const py::object& progress) {
  TouchRequest request{.measures = measures ? TouchMeasures::all : TouchMeasures::depth};
  const PointsIn directions(along, "along");
  for (std::size_t i = 0; i < directions.size(); ++i) request.along.push_back(directions.view()[i]);
  if (!centre.is_none()) request.centre = vector_in(centre, "centre");
  const contact::JointContact bodies(fixed, mobile);
  return of_each(pose, progress, [&](const Pose& X_FM) {
    TouchRequest at = request;
    at.X_FM = X_FM;
    return io::touch_object(answer_touch(bodies, at));
  });
}

py::tuple turn(const Mesh& fixed, const Mesh& mobile, const py::object& axis, const py::object& centre,
               const py::object& pose, const py::object& progress) {
  const Vec3 direction = vector_in(axis, "axis"), point = vector_in(centre, "centre");
  return of_each(pose, progress, [&](const Pose& X_FM) {
    return io::turn_object(answer_turn(fixed, mobile, {direction, point, X_FM}));
  });
}

py::tuple slide(const Mesh& fixed, const Mesh& mobile, const py::object& along, const py::object& pose,
                const py::object& progress) {
  const Vec3 direction = vector_in(along, "along");
  return of_each(pose, progress, [&](const Pose& X_FM) {
    return io::slide_object(answer_slide(fixed, mobile, {direction, X_FM}));
  });
}

}  // namespace

void bind_touch(py::module_& module) {
  module.def("touch", &touch);
  module.def("turn", &turn);
  module.def("slide", &slide);
}

}  // namespace condyle::python
