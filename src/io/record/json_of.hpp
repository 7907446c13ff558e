#pragma once

#include "answer/records/record.hpp"
#include "condyle/io/provenance.hpp"
#include "io/joint/given_degrees.hpp"
#include "io/result/json.hpp"

namespace condyle::io {

/// What the values of a record are written by: the frame of its points, and the joint whose angles it names.
struct RecordContext {
  AnswerFrame frame;
  Anatomy joint;
};

/// A record, or a value of one, as JSON: keys in the order of its table.
template <class Value>
Json json_of(const Value& value, const RecordContext& context) {
  if constexpr (is_optional<Value>) {
    return value ? json_of(*value, context) : Json(nullptr);
  } else if constexpr (IsRecord<Value>) {
    Json json = Json::object();
    for_each_field<Value>([&](const auto& field) {
      if (*field.key == 0) return;
      const auto& of_field = value_of(value, field);
      if constexpr (is_optional<std::remove_cvref_t<decltype(of_field)>>)
        if (!of_field && field.if_empty == IfEmpty::left_out) return;
      json[field.key] = json_of(of_field, context);
    });
    return json;
  } else if constexpr (is_of_angles<Value>) {
    Json json = Json::object();
    for (const JointAngle angle : all_joint_angles)
      if (const auto& of_angle = value[static_cast<std::size_t>(angle)])
        json[name_of(angle, context.joint)] = json_of(*of_angle, context);
    return json;
  } else if constexpr (is_list<Value>) {
    Json json = Json::array();
    for (const auto& each : value) json.push_back(json_of(each, context));
    return json;
  } else if constexpr (std::same_as<Value, PointF>) {
    return numbers(context.frame.fixed_point(value.mm));
  } else if constexpr (std::same_as<Value, PointM>) {
    return numbers(context.frame.mobile_point(value.mm));
  } else if constexpr (std::same_as<Value, Vec3>) {
    return numbers(value);
  } else if constexpr (std::same_as<Value, Angle>) {
    return value.degrees();
  } else if constexpr (std::same_as<Value, GivenDegrees>) {
    return given_degrees(value.angle);
  } else if constexpr (std::same_as<Value, JointAngle>) {
    return name_of(value, context.joint);
  } else if constexpr (std::is_enum_v<Value>) {
    return name_of(value);
  } else {
    return value;
  }
}

}  // namespace condyle::io
