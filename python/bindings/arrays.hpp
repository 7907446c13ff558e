#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "condyle/angle.hpp"
#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"

/// Between numpy and the library's arrays. UsageError where an array has another shape or kind of numbers, naming what it was
/// given for.

namespace condyle::python {

namespace py = pybind11;

/// A read-only array over memory that `owner` keeps alive.
template <class T>
py::array view_of(const T* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
                  const py::object& owner) {
  py::array array(py::dtype::of<T>(), std::move(shape), std::move(strides), data, owner);
  // The effect of `flags.writeable = False`, in nanoseconds: small answers have many arrays.
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// A read-only array that a vector has become: nothing is copied.
template <class T>
py::array array_of(std::vector<T>&& values) {
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  const T* data = kept->data();
  const auto count = static_cast<py::ssize_t>(kept->size());
  const py::capsule owner(kept.release(), [](void* vector) { delete static_cast<std::vector<T>*>(vector); });
  return view_of(data, {count}, {static_cast<py::ssize_t>(sizeof(T))}, owner);
}

/// The same of enumerations and other values of one byte.
template <class T>
py::array bytes_of(const std::vector<T>& values) {
  static_assert(sizeof(T) == 1);
  const auto* begin = reinterpret_cast<const std::int8_t*>(values.data());
  return array_of(std::vector<std::int8_t>(begin, begin + values.size()));
}

py::array degrees_of(const std::vector<Angle>& angles);

/// (N, 3), column by column in memory, so that they come back without a copy.
py::array array_of(const Points& points);
py::array array_of(const Vec3& vector);
py::array array_of(const Pose& pose);

/// None where there is none.
py::object optional_array(const std::optional<Vec3>& vector);
py::object optional_number(const std::optional<double>& number);

/// Code and text of each note of an answer.
template <class Note>
py::list notes_of(const std::vector<Note>& notes) {
  py::list list;
  for (const Note& note : notes) list.append(py::make_tuple(std::string(name_of(note.code)), note.text));
  return list;
}

/// UsageError for a masked array of numpy: its masked elements hold numbers that mean nothing.
void refuse_masked(const py::object& given, std::string_view name);

/// An array of numbers; `wanted` is what its shape is called in messages: "(V, 3)".
py::array array_in(const py::object& given, std::string_view name, std::string_view wanted);
/// The same of this shape; a size of -1 is any.
py::array array_in(const py::object& given, std::string_view name, std::vector<py::ssize_t> shape,
                   std::string_view wanted);

/// Treatment of coordinates that are not finite.
enum class NotFinite { refuse, leave };

/// Points of an (N, 3) array of real numbers. Doubles that lie column by column are read where they are, as long as this
/// lives; all else is copied.
class PointsIn {
 public:
  PointsIn(const py::object& given, std::string_view name, NotFinite not_finite = NotFinite::refuse);
  PointsView view() const noexcept { return view_; }
  std::size_t size() const noexcept { return view_.size(); }

 private:
  py::array kept_;
  Points copied_;
  PointsView view_;
};

std::vector<double> doubles_in(const py::object& given, std::string_view name);
Vec3 vector_in(const py::object& given, std::string_view name);

/// Rigid motions of a (4, 4) or (N, 4, 4) array. UsageError where the last row is not 0 0 0 1 or the rotation is off by more
/// than 1e-6; matrices are used as they are.
struct PosesIn {
  std::vector<Pose> poses;
  bool is_one;  ///< a single matrix
};
PosesIn poses_in(const py::object& given, std::string_view name);
/// One of shape (4, 4).
Pose one_pose(const py::object& given, std::string_view name);
/// The same as poses_in(), of which those that are NaN throughout are gaps.
std::vector<std::optional<Pose>> poses_with_gaps_in(const py::object& given, std::string_view name);

/// Integers of an array of this shape. UsageError for other kinds of numbers, and for some beyond what std::int64_t holds.
py::array_t<std::int64_t> integers_in(const py::object& given, std::string_view name,
                                      std::vector<py::ssize_t> shape, std::string_view wanted);

/// Numbers of vertices, one for each of `count` positions. UsageError if they are not as many, or one is no number of a vertex
/// in any mesh.
std::vector<Index> vertices_in(const py::object& given, std::string_view name, std::size_t count);

/// Triangles of a (T, 3) array of integers, in range. MeshError for one that is not.
std::vector<Triangle> triangles_in(const py::object& given, std::size_t vertices);

}  // namespace condyle::python
