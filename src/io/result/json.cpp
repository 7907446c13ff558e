#include "io/result/json.hpp"

namespace condyle::io {

Json numbers(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

Json notes_json(std::span<const JointNote> notes) {
  Json list = Json::array();
  for (const JointNote& note : notes) list.push_back({{"code", name_of(note.code)}, {"text", note.text}});
  return list;
}

Json anatomy_json(const Joint& joint) {
  return joint.names_its_joint() ? Json(name_of(joint.anatomy)) : Json(nullptr);
}

Json pose_json(const PoseDegrees& pose, Anatomy joint) {
  Json json;
  for (const JointAngle angle : all_joint_angles) json[name_of(angle, joint)] = pose[angle];
  return json;
}

void drop_negative_zeros(Json& json) {
  if (json.is_number_float() && json.get<double>() == 0) json = 0.0;
  if (json.is_structured())
    for (Json& element : json) drop_negative_zeros(element);
}

std::string document(Json json) {
  drop_negative_zeros(json);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace condyle::io
