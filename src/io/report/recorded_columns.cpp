#include "io/report/recorded_columns.hpp"

#include <string>

namespace condyle::io {
namespace {

Json unit_json(const std::optional<ColumnUnit>& unit) {
  return unit ? Json(static_cast<int>(*unit)) : Json(nullptr);
}

Json column_json(const ColumnOfCoordinate& column) {
  return {{"coordinate", column.coordinate},
          {"is_length", column.kind == CoordinateKind::length},
          {"column", column.column},
          {"unit", unit_json(column.unit)},
          {"sign", column.sign},
          {"offset", column.offset},
          {"default", column.otherwise ? Json(*column.otherwise) : Json(nullptr)},
          {"range", column.range ? Json(*column.range) : Json(nullptr)},
          {"locked", column.is_locked}};
}

ColumnOfCoordinate column_of_json(const Json& json) {
  ColumnOfCoordinate column{
      .coordinate = json.at("coordinate").get<std::string>(),
      .kind = json.at("is_length").get<bool>() ? CoordinateKind::length : CoordinateKind::angle,
      .column = json.at("column").get<std::string>(),
      .sign = json.at("sign").get<double>(),
      .offset = json.at("offset").get<double>(),
      .is_locked = json.at("locked").get<bool>()};
  if (!json.at("unit").is_null()) column.unit = static_cast<ColumnUnit>(json.at("unit").get<int>());
  if (!json.at("default").is_null()) column.otherwise = json.at("default").get<double>();
  if (!json.at("range").is_null()) column.range = json.at("range").get<std::array<double, 2>>();
  return column;
}

}  // namespace

Json recorded_motion_json(const RecordedMotionMapping& mapping) {
  if (std::holds_alternative<ColumnsOfPoses>(mapping)) return {{"by", "poses"}};
  if (std::holds_alternative<PosesOfModel>(mapping)) return {{"by", "model"}};
  Json columns = Json::array();
  for (const ColumnOfCoordinate& column : std::get<std::vector<ColumnOfCoordinate>>(mapping))
    columns.push_back(column_json(column));
  return {{"by", "columns"}, {"columns", std::move(columns)}};
}

std::vector<ColumnOfCoordinate> columns_of_json(const Json& json) {
  std::vector<ColumnOfCoordinate> columns;
  for (const Json& column : json.at("columns")) columns.push_back(column_of_json(column));
  return columns;
}

}  // namespace condyle::io
