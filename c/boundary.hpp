#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "condyle/condyle.h"
#include "condyle/error.hpp"
#include "condyle/joint.hpp"
#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"

/// What every function of the C interface is made of: arguments come in as C++ has them, errors leave as statuses.

struct condyle_mesh {
  condyle::Mesh mesh;
};

namespace condyle::c {

/// Within a handler: the status of the exception, whose text becomes that of condyle_last_error().
condyle_status status_of_exception() noexcept;

/// Runs a function's body; no exception passes.
template <class Work>
condyle_status guarded(const Work& work) noexcept {
  try {
    work();
    return CONDYLE_OK;
  } catch (...) {
    return status_of_exception();
  }
}

/// UsageError that names the argument if it is null.
void require(const void* argument, const char* name);

template <class T>
T& required(T* argument, const char* name) {
  require(argument, name);
  return *argument;
}

/// An object without arguments. Required first: an assignment evaluates its right side before its left.
template <class T>
condyle_status make(T** object, const char* name) noexcept {
  return guarded([&] {
    T*& out = required(object, name);
    out = new T;
  });
}

/// Answers of results. UsageError if they have none.
template <class T>
const T& answered(const T* results) {
  if (!required(results, "results").has_answer)
    throw UsageError("the results have no answer: the last query failed, or there was none");
  return *results;
}

/// UsageError for what is no rigid motion.
Pose pose_of(const condyle_pose* pose, const char* name);
BodyRole role_of(condyle_body body);

/// std::length_error for more than any mesh has, before anything is read.
void check_countable(std::size_t count);

/// `count` points given x, y, z one after the other.
Points points_of(const double* xyz_mm, std::size_t count, const char* name);

/// The body of a contact that has both.
template <class Contact>
const Mesh& mesh_of(const Contact& contact, BodyRole body) {
  return body == BodyRole::fixed ? contact.fixed() : contact.mobile();
}

/// New positions of all vertices of a body. UsageError for another count, before anything is read.
Points all_points_of(const Mesh& body, const double* xyz_mm, std::size_t count);

/// New positions of some vertices of a body: numbers, borrowed, and points. UsageError for more than the body has, before anything is
/// read.
struct SomePoints {
  std::span<const Index> vertices;
  Points points;
};
SomePoints some_points_of(const Mesh& body, const std::uint32_t* vertices, std::size_t count,
                          const double* xyz_mm);

Vec3 vector_of(const double* xyz, const char* name);

/// One of consecutive values from 0, as an enumerator. UsageError for any other number.
template <class Enum>
Enum one_of(int value, Enum last, const char* name) {
  if (value < 0 || value > static_cast<int>(last))
    throw UsageError(std::string(name) + ": there is no value " + std::to_string(value));
  return static_cast<Enum>(value);
}

inline void copy(const Vec3& from, double (&to)[3]) noexcept {
  std::copy_n(from.data(), 3, to);
}

}  // namespace condyle::c
