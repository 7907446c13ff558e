#include "arrays.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "condyle/error.hpp"

namespace condyle::python {
namespace {

std::string shape_of(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) text += fmt::format("{}{}", i ? ", " : "", array.shape(i));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

bool is_number(const py::array& array) {
  const char kind = array.dtype().kind();
  return kind == 'f' || kind == 'i' || kind == 'u';
}

std::string name_of_type(const py::array& array) {
  return py::str(array.dtype()).cast<std::string>();
}

/// As doubles, rounded if they were longer; strides stay.
py::array as_doubles(const py::array& array, std::string_view name) {
  if (!is_number(array))
    throw UsageError(fmt::format("{}: real numbers are needed, not {}", name, name_of_type(array)));
  py::array doubles = py::array_t<double, py::array::forcecast>::ensure(array);
  if (!doubles) {
    PyErr_Clear();
    throw UsageError(fmt::format("{}: {} cannot be read as doubles", name, name_of_type(array)));
  }
  return doubles;
}

/// A copy with aligned elements, where a structured or memory-mapped array has them otherwise.
py::array aligned(py::array array) {
  const auto misaligned = [](py::ssize_t of) { return of % static_cast<py::ssize_t>(alignof(double)) != 0; };
  bool is_off = misaligned(static_cast<py::ssize_t>(reinterpret_cast<std::uintptr_t>(array.data())));
  for (py::ssize_t i = 0; i < array.ndim(); ++i) is_off |= misaligned(array.strides(i));
  return is_off ? py::array(array.attr("copy")()) : array;
}

double at(const py::array& array, py::ssize_t i, py::ssize_t j) {
  return *static_cast<const double*>(array.data(i, j));
}

/// Rotations written with six decimals pass, as they do in joint files.
constexpr double rotation_tolerance = 1e-6;

/// Defect of a rigid motion; empty if there is none.
std::string fault_of(const Pose& pose) {
  if (!pose.matrix().allFinite()) return "finite numbers are needed";
  if (pose.matrix().row(3) != Eigen::RowVector4d(0, 0, 0, 1)) return "the last row of a pose is 0 0 0 1";
  const Eigen::Matrix3d rotation = pose.linear();
  const double off = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (off > rotation_tolerance) return fmt::format("the rotation is not orthonormal, but off by {:.3g}", off);
  return rotation.determinant() < 0 ? "a reflection is no pose" : "";
}

/// Matrices of a (4, 4) or (N, 4, 4) array, their values not checked.
PosesIn matrices_in(const py::object& given, std::string_view name) {
  constexpr std::string_view wanted = "(4, 4) or (N, 4, 4)";
  py::array array = array_in(given, name, wanted);
  PosesIn in{{}, array.ndim() == 2};
  if ((array.ndim() != 2 && array.ndim() != 3) || array.shape(array.ndim() - 1) != 4 ||
      array.shape(array.ndim() - 2) != 4)
    throw UsageError(
        fmt::format("{}: an array of shape {} is needed, not {}", name, wanted, shape_of(array)));
  array = aligned(as_doubles(in.is_one ? py::array(array.attr("reshape")(1, 4, 4)) : array, name));
  in.poses.resize(static_cast<std::size_t>(array.shape(0)));
  const auto entries = array.unchecked<double, 3>();
  for (std::size_t n = 0; n < in.poses.size(); ++n)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) in.poses[n].matrix()(i, j) = entries(static_cast<py::ssize_t>(n), i, j);
  return in;
}

void require_rigid(const PosesIn& in, std::size_t n, std::string_view name) {
  if (const std::string fault = fault_of(in.poses[n]); !fault.empty())
    throw UsageError(fmt::format("{}{}: {}", name, in.is_one ? "" : fmt::format(": pose {}", n), fault));
}

}  // namespace

py::array degrees_of(const std::vector<Angle>& angles) {
  std::vector<double> degrees(angles.size());
  std::transform(angles.begin(), angles.end(), degrees.begin(), [](Angle angle) { return angle.degrees(); });
  return array_of(std::move(degrees));
}

py::array array_of(const Points& points) {
  auto kept = std::make_unique<std::vector<double>>();
  kept->reserve(3 * points.size());
  for (const auto* column : {&points.x, &points.y, &points.z})
    kept->insert(kept->end(), column->begin(), column->end());
  const double* data = kept->data();
  const auto count = static_cast<py::ssize_t>(points.size());
  const py::capsule owner(kept.release(),
                          [](void* vector) { delete static_cast<std::vector<double>*>(vector); });
  constexpr auto size = static_cast<py::ssize_t>(sizeof(double));
  return view_of(data, {count, 3}, {size, size * count}, owner);
}

py::array array_of(const Vec3& vector) {
  return array_of(std::vector<double>{vector.x(), vector.y(), vector.z()});
}

py::array array_of(const Pose& pose) {
  py::array_t<double> array({4, 4});
  auto values = array.mutable_unchecked<2>();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) values(i, j) = pose.matrix()(i, j);
  return array;
}

py::object optional_array(const std::optional<Vec3>& vector) {
  if (!vector) return py::none();
  return array_of(*vector);
}

py::object optional_number(const std::optional<double>& number) {
  if (!number) return py::none();
  return py::float_(*number);
}

void refuse_masked(const py::object& given, std::string_view name) {
  // Loaded with numpy; an array of numpy itself, the usual case, is none.
  if (Py_TYPE(given.ptr()) == reinterpret_cast<PyTypeObject*>(py::detail::npy_api::get().PyArray_Type_))
    return;
  if (py::isinstance<py::array>(given) && py::hasattr(given, "mask") && py::hasattr(given, "filled"))
    throw UsageError(
        fmt::format("{}: a masked array is not read, since what is masked has no value: give its filled() or "
                    "compressed()",
                    name));
}

py::array array_in(const py::object& given, std::string_view name, std::string_view wanted) {
  refuse_masked(given, name);
  py::array array = py::array::ensure(given);  // clears the error where there is one
  if (!array || array.dtype().kind() == 'O')
    throw UsageError(fmt::format("{}: an array of shape {} is needed, not {}", name, wanted,
                                 py::str(py::type::of(given).attr("__name__")).cast<std::string>()));
  return array;
}

py::array array_in(const py::object& given, std::string_view name, std::vector<py::ssize_t> shape,
                   std::string_view wanted) {
  py::array array = array_in(given, name, wanted);
  bool fits = array.ndim() == static_cast<py::ssize_t>(shape.size());
  for (std::size_t i = 0; fits && i < shape.size(); ++i)
    fits = shape[i] == -1 || shape[i] == array.shape(static_cast<py::ssize_t>(i));
  if (!fits)
    throw UsageError(
        fmt::format("{}: an array of shape {} is needed, not {}", name, wanted, shape_of(array)));
  return array;
}

PointsIn::PointsIn(const py::object& given, std::string_view name, NotFinite not_finite)
    : kept_(aligned(as_doubles(array_in(given, name, {-1, 3}, "(N, 3)"), name))) {
  const py::ssize_t count = kept_.shape(0);
  if (kept_.strides(0) == static_cast<py::ssize_t>(sizeof(double)) || count == 0) {
    const auto column = [&](py::ssize_t j) {
      return count == 0
                 ? std::span<const double>()
                 : std::span(static_cast<const double*>(kept_.data(0, j)), static_cast<std::size_t>(count));
    };
    view_ = {column(0), column(1), column(2)};
  } else {
    copied_ = Points(static_cast<std::size_t>(count));
    for (py::ssize_t i = 0; i < count; ++i)
      copied_.set(static_cast<std::size_t>(i), {at(kept_, i, 0), at(kept_, i, 1), at(kept_, i, 2)});
    view_ = copied_.view();
  }
  for (std::size_t i = 0; not_finite == NotFinite::refuse && i < view_.size(); ++i)
    if (!view_[i].allFinite())
      throw UsageError(fmt::format("{}: row {} is ({}, {}, {}): finite numbers are needed", name, i,
                                   view_.x[i], view_.y[i], view_.z[i]));
}

std::vector<double> doubles_in(const py::object& given, std::string_view name) {
  const py::array array = aligned(as_doubles(array_in(given, name, {-1}, "(N,)"), name));
  std::vector<double> values(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = *static_cast<const double*>(array.data(static_cast<py::ssize_t>(i)));
  return values;
}

Vec3 vector_in(const py::object& given, std::string_view name) {
  const py::array array = aligned(as_doubles(array_in(given, name, {3}, "(3,)"), name));
  Vec3 vector;
  for (int i = 0; i < 3; ++i) vector[i] = *static_cast<const double*>(array.data(i));
  if (!vector.allFinite()) throw UsageError(fmt::format("{}: finite numbers are needed", name));
  return vector;
}

PosesIn poses_in(const py::object& given, std::string_view name) {
  PosesIn in = matrices_in(given, name);
  for (std::size_t n = 0; n < in.poses.size(); ++n) require_rigid(in, n, name);
  return in;
}

Pose one_pose(const py::object& given, std::string_view name) {
  const PosesIn in = poses_in(given, name);
  if (!in.is_one) throw UsageError(fmt::format("{}: one pose of shape (4, 4) is needed", name));
  return in.poses.front();
}

std::vector<std::optional<Pose>> poses_with_gaps_in(const py::object& given, std::string_view name) {
  const PosesIn in = matrices_in(given, name);
  std::vector<std::optional<Pose>> poses(in.poses.size());
  for (std::size_t n = 0; n < poses.size(); ++n) {
    if (in.poses[n].matrix().array().isNaN().all()) continue;
    require_rigid(in, n, name);
    poses[n] = in.poses[n];
  }
  return poses;
}

py::array_t<std::int64_t> integers_in(const py::object& given, std::string_view name,
                                      std::vector<py::ssize_t> shape, std::string_view wanted) {
  const py::array array = array_in(given, name, std::move(shape), wanted);
  if (array.dtype().kind() != 'i' && array.dtype().kind() != 'u')
    throw UsageError(fmt::format("{}: integers are needed, not {}", name, name_of_type(array)));
  // Numbers beyond the signed range must not wrap to others.
  if (array.dtype().kind() == 'u' && array.itemsize() == 8 && array.size() > 0 &&
      py::bool_(array.attr("max")().attr("__gt__")(py::int_(INT64_MAX))))
    throw UsageError(fmt::format("{}: a number beyond {}", name, INT64_MAX));
  return py::array_t<std::int64_t, py::array::forcecast>(array);
}

std::vector<Index> vertices_in(const py::object& given, std::string_view name, std::size_t count) {
  const std::string named(name);
  const py::array_t<std::int64_t> numbers = integers_in(given, name, {-1}, "(K,)");
  std::vector<Index> vertices;
  for (py::ssize_t i = 0; i < numbers.shape(0); ++i) {
    const std::int64_t vertex = numbers.at(i);
    if (vertex < 0 || vertex >= static_cast<std::int64_t>(no_index))
      throw UsageError(named + ": vertex " + std::to_string(vertex) + " is none of the mesh's");
    vertices.push_back(static_cast<Index>(vertex));
  }
  if (vertices.size() != count)
    throw UsageError(named + ": " + std::to_string(vertices.size()) + " numbers for " +
                     std::to_string(count) + " positions");
  return vertices;
}

std::vector<Triangle> triangles_in(const py::object& given, std::size_t vertices) {
  const py::array_t<std::int64_t> numbers = integers_in(given, "triangles", {-1, 3}, "(T, 3)");
  const auto numbers_at = numbers.unchecked<2>();
  std::vector<Triangle> triangles(static_cast<std::size_t>(numbers.shape(0)));
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::int64_t vertex = numbers_at(static_cast<py::ssize_t>(t), k);
      if (vertex < 0 || vertex >= static_cast<std::int64_t>(vertices))
        throw MeshError(fmt::format("triangle {} uses vertex {} of {}", t, vertex, vertices));
      triangles[t][static_cast<std::size_t>(k)] = static_cast<Index>(vertex);
    }
  return triangles;
}

}  // namespace condyle::python
