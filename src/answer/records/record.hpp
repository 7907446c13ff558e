#pragma once

#include <boost/preprocessor.hpp>

#include <array>
#include <concepts>
#include <functional>
#include <optional>
#include <tuple>
#include <type_traits>
#include <vector>

#include "condyle/angle.hpp"
#include "condyle/joint.hpp"
#include "condyle/joint_coordinates.hpp"
#include "condyle/pose.hpp"

/// Records: what is said of an answer, in the words of the files.
///
/// A record is a struct with a table, table<Record>, that says each key once, and how its value is reached: by members, or by functions of
/// the struct. An answer's own struct is one wherever it has what is said; else a plain struct has it, whose members are named as the keys, and
/// one function fills that. The walks over the tables (io/record/) make JSON, CSV and the columns of studies of any record, and the pages of
/// docs/ are compared with them. An empty std::optional is a value that is not known.

namespace condyle {

/// A point on the fixed body, in F, or on the mobile one, in M; mm. What writes it brings it into the frame of the answer.
struct PointF {
  Vec3 mm;
};
struct PointM {
  Vec3 mm;
};

/// Degrees that somebody gave: they are written digit by digit as given.
struct GivenDegrees {
  Angle angle;
};
constexpr GivenDegrees as_given(const Angle& angle) noexcept {
  return {angle};
}

/// As in files: "fixed".
constexpr std::string_view name_of(BodyRole role) noexcept {
  return role == BodyRole::fixed ? "fixed" : "mobile";
}

/// A value for each angle of a joint, under the names that the joint has for them; an empty one is left out.
template <class Value>
using OfAngles = std::array<std::optional<Value>, all_joint_angles.size()>;

/// The tables in which a value has a column.
enum class Tables : std::uint8_t {
  rom,
  studies,  ///< of `condyle rom` and of studies
  studies_with_bands,
  studies_that_follow,  ///< a recorded motion or a load
};

/// Joints in whose tables of `condyle rom` the column is. Those of studies have it for every joint.
enum class TablesOf : std::uint8_t { all, hips, shoulders };

/// A value as a column. Its unit is that of its name; a point has three columns, NAME_x_mm and so on, and angles one each, NAME_ANGLE_deg.
struct FieldColumn {
  const char* name;  ///< "": that of the key
  const char* meaning;
  Tables tables;
  TablesOf joints = TablesOf::all;
};
struct NoColumn {};

/// What JSON has of an empty value.
enum class IfEmpty : std::uint8_t { null, left_out };

/// An entry of a record's table: a value, by the members, or functions of what comes before, that lead to it.
template <class ColumnOrNone, class... Steps>
struct Field {
  static constexpr bool has_column = std::same_as<ColumnOrNone, FieldColumn>;

  const char* key;  ///< "": in tables only
  std::tuple<Steps...> path;
  const char* meaning;  ///< of the key, as the page of docs/ has it
  ColumnOrNone column;
  IfEmpty if_empty;
};

/// A key of a record.
template <class Step>
constexpr Field<NoColumn, Step> field(const char* key, Step step, const char* meaning = "",
                                      IfEmpty if_empty = IfEmpty::null) {
  return {key, {step}, meaning, {}, if_empty};
}
/// One whose value is further down.
template <class... Steps>
constexpr Field<NoColumn, Steps...> field_along(const char* key, const char* meaning, Steps... steps) {
  return {key, {steps...}, meaning, {}, IfEmpty::null};
}
/// One that tables have too.
template <class Step>
constexpr Field<FieldColumn, Step> field(const char* key, Step step, const char* meaning,
                                         FieldColumn column) {
  return {key, {step}, meaning, column, IfEmpty::null};
}
/// A key that JSON does not have if its value is empty.
template <class Step>
constexpr auto field_if_any(const char* key, Step step, const char* meaning = "") {
  return field(key, step, meaning, IfEmpty::left_out);
}
/// A column of a value further down, which JSON has in its own record.
template <class... Steps>
constexpr Field<FieldColumn, Steps...> column_of(FieldColumn column, Steps... steps) {
  return {"", {steps...}, "", column, IfEmpty::null};
}

/// A record's name outside C++, what it is, and its fields in the order of the files.
template <class... Fields>
struct RecordTable {
  const char* name;
  const char* meaning;
  std::tuple<Fields...> fields;
};
template <class... Fields>
constexpr RecordTable<Fields...> record(const char* name, const char* meaning, Fields... fields) {
  return {name, meaning, {fields...}};
}

/// The keys of a record whose members say enough: CONDYLE_KEYS(BandRecord, p5_deg, median_deg).
#define CONDYLE_KEY(unused, Record, number, member) \
  BOOST_PP_COMMA_IF(number) field(BOOST_PP_STRINGIZE(member), &Record::member)
#define CONDYLE_KEYS(Record, ...) \
  BOOST_PP_SEQ_FOR_EACH_I(CONDYLE_KEY, Record, BOOST_PP_VARIADIC_TO_SEQ(__VA_ARGS__))

/// The table of a record.
template <class Record>
inline constexpr std::nullptr_t table = nullptr;

template <class Type>
concept IsRecord = !std::same_as<std::remove_const_t<decltype(table<Type>)>, std::nullptr_t>;

template <class Record, class Visit>
constexpr void for_each_field(const Visit& visit) {
  std::apply([&](const auto&... each) { (visit(each), ...); }, table<Record>.fields);
}

template <class Type>
inline constexpr bool is_optional = false;
template <class Type>
inline constexpr bool is_optional<std::optional<Type>> = true;
template <class Type>
inline constexpr bool is_list = false;
template <class Type>
inline constexpr bool is_list<std::vector<Type>> = true;
template <class Type, std::size_t n>
inline constexpr bool is_list<std::array<Type, n>> = true;
template <class Type>
inline constexpr bool is_of_angles = false;
template <class Type>
inline constexpr bool is_of_angles<OfAngles<Type>> = true;

/// The value to which steps lead: the optional of it if anything on the way is optional.
template <class Value, class First, class... Rest>
constexpr decltype(auto) value_at(const Value& value, const First& first, const Rest&... rest) {
  if constexpr (is_optional<Value>) {
    using Found = std::remove_cvref_t<decltype(value_at(*value, first, rest...))>;
    using Maybe = std::conditional_t<is_optional<Found>, Found, std::optional<Found>>;
    return value ? Maybe(value_at(*value, first, rest...)) : Maybe();
  } else if constexpr (sizeof...(rest) == 0) {
    return std::invoke(first, value);
  } else {  // by value: a step may be a function, whose result goes
    return std::remove_cvref_t<decltype(value_at(std::invoke(first, value), rest...))>(
        value_at(std::invoke(first, value), rest...));
  }
}

/// That of a field.
template <class Record, class Field>
constexpr decltype(auto) value_of(const Record& record, const Field& field) {
  return std::apply([&](const auto&... steps) -> decltype(auto) { return value_at(record, steps...); },
                    field.path);
}
template <class Record, class Field>
using ValueOf =
    std::remove_cvref_t<decltype(value_of(std::declval<const Record&>(), std::declval<const Field&>()))>;

/// A value without its optionals; null if one of them is empty.
template <class Value>
constexpr auto reached(const Value* value) {
  if constexpr (is_optional<Value>)
    return reached(value && *value ? &**value : nullptr);
  else
    return value;
}

}  // namespace condyle
