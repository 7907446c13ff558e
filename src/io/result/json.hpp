#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/answer.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/joint.hpp"
#include "condyle/joint_checks.hpp"
#include "condyle/motion_contact.hpp"
#include "condyle/pose.hpp"

/// Common parts of all JSON answers.

namespace condyle::io {

/// Where there is no memory for a part of a JSON value, std::terminate() ends the process: of a value without its parts the
/// library's destructor would read what is not there, and it takes memory itself, so there is no way back to a caller. A command
/// then says that memory is out, with its exit code.
template <class T>
struct JsonMemory : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = JsonMemory<U>;
  };
  JsonMemory() = default;
  template <class U>
  JsonMemory(const JsonMemory<U>&) noexcept {}
  T* allocate(std::size_t count) noexcept { return std::allocator<T>::allocate(count); }
};

/// Keys stay in the order in which they were written.
using Json = nlohmann::basic_json<nlohmann::ordered_map, std::vector, std::string, bool, std::int64_t,
                                  std::uint64_t, double, JsonMemory>;

/// An empty answer is null, never a number that could be read as one.
template <class Value>
Json nullable(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json numbers(const Vec3& p);

/// Under `notes` in every answer: what looks wrong with a joint, what its limits must be read with, and what looks wrong with its
/// materials, loads and motion.
Json notes_json(std::span<const JointNote> notes, std::span<const motion::ContactNote> of_contact = {},
                std::span<const RangeNote> of_range = {});

/// Which joint it is; null for a hinge that is none in particular.
Json anatomy_json(const Joint& joint);

/// As it was given.
Json pose_json(const PoseDegrees& pose, Anatomy joint);

/// Without the sign of 0, which says nothing.
void drop_negative_zeros(Json& json);

/// A whole document; bytes of a name that are not UTF-8 are replaced, and control characters escaped, those too that JSON lets
/// stand and terminals obey.
std::string document(Json json);

/// Reads a document. Throws Json::parse_error, and FileError if lists and objects are more than 64 deep: what is written
/// of a value goes down its levels by recursion.
Json parsed_json(std::string_view text);

}  // namespace condyle::io
