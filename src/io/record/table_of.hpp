#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "io/file/csv_fields.hpp"
#include "io/record/json_of.hpp"
#include "io/result/result_column.hpp"

/// Records as lines of tables.

namespace condyle::io {

namespace cells {

template <class Value>
inline constexpr bool is_point =
    std::same_as<Value, PointF> || std::same_as<Value, PointM> || std::same_as<Value, Vec3>;

template <class Value>
inline constexpr bool is_angle = std::same_as<Value, Angle> || std::same_as<Value, GivenDegrees>;

/// The unit that ends a name: "limit_deg".
inline std::string unit_of(std::string_view name) {
  return name.ends_with("_deg") ? "deg" : name.ends_with("_mm") ? "mm" : name.ends_with("_hour") ? "h" : "";
}

/// One cell: numbers to the last bit.
template <class Value>
std::string cell_of(const Value& value, const RecordContext& context) {
  if constexpr (std::same_as<Value, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_arithmetic_v<Value>) {
    return fmt::format("{}", value);
  } else if constexpr (std::is_enum_v<Value> || is_angle<Value>) {
    const Json json = json_of(value, context);
    return json.is_string() ? json.get<std::string>() : fmt::format("{}", json.get<double>());
  } else if constexpr (IsRecord<Value>) {
    return csv_field(text_of(value));
  } else if constexpr (is_list<Value>) {  // of records, by their codes
    std::string codes;
    for (const auto& each : value) codes += fmt::format("{}{}", codes.empty() ? "" : " ", name_of(each.code));
    return codes;
  } else {
    return csv_field(value);
  }
}

}  // namespace cells

/// The columns of a record's fields of which `shown(field.column)` is true, by the names of the joint's angles.
template <class Record, class Shown>
std::vector<ResultColumn> columns_of(Anatomy joint, const Shown& shown) {
  constexpr std::array<const char*, 3> directions = {"anterior", "superior", "to the subject's right"};
  std::vector<ResultColumn> columns;
  for_each_field<Record>([&]<class Field>(const Field& field) {
    if constexpr (Field::has_column) {
      if (!shown(field.column)) return;
      using Value =
          std::remove_cvref_t<decltype(*reached(static_cast<const ValueOf<Record, Field>*>(nullptr)))>;
      const std::string name = *field.column.name ? field.column.name : field.key;
      if constexpr (cells::is_point<Value>) {
        for (std::size_t axis = 0; axis < 3; ++axis)
          columns.push_back({fmt::format("{}_{}_mm", name, "xyz"[axis]), "mm", number_column,
                             fmt::format("{}, {}", field.column.meaning, directions[axis])});
      } else if constexpr (is_of_angles<Value>) {
        for (const JointAngle angle : all_joint_angles)
          columns.push_back({fmt::format("{}_{}_deg", name, name_of(angle, joint)), "deg", number_column,
                             field.column.meaning});
      } else {
        constexpr bool is_number =
            (std::is_arithmetic_v<Value> && !std::same_as<Value, bool>) || cells::is_angle<Value>;
        columns.push_back(
            {name, cells::unit_of(name), is_number ? number_column : text_column, field.column.meaning});
      }
    }
  });
  return columns;
}

/// The texts of these columns, empty if there is no value.
template <class Record, class Shown>
void append_cells(std::vector<std::string>& cells, const Record& record, const RecordContext& context,
                  const Shown& shown) {
  for_each_field<Record>([&](const auto& field) {
    if constexpr (std::remove_cvref_t<decltype(field)>::has_column) {
      if (!shown(field.column)) return;
      const auto& of_field = value_of(record, field);
      const auto* value = reached(&of_field);
      using Value = std::remove_cvref_t<decltype(*value)>;
      constexpr bool is_three = cells::is_point<Value> || is_of_angles<Value>;
      if (!value) return cells.resize(cells.size() + (is_three ? 3 : 1));
      if constexpr (is_three)
        for (const Json& each : json_of(*value, context))
          cells.push_back(fmt::format("{}", each.template get<double>()));
      else
        cells.push_back(cells::cell_of(*value, context));
    }
  });
}

}  // namespace condyle::io
