#include "io/result/json.hpp"

#include <fmt/format.h>

#include "condyle/error.hpp"
#include "io/file/plain_text.hpp"

namespace condyle::io {
Json numbers(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

Json notes_json(std::span<const JointNote> notes, std::span<const motion::ContactNote> of_contact,
                std::span<const RangeNote> of_range) {
  Json list = Json::array();
  const auto add = [&](const auto& some) {
    for (const auto& note : some) list.push_back({{"code", name_of(note.code)}, {"text", note.text}});
  };
  add(notes);
  add(of_range);
  add(of_contact);
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
  return escaped_json(json.dump(2, ' ', false, Json::error_handler_t::replace)) + "\n";
}

Json parsed_json(std::string_view text) {
  static constexpr int most_levels = 64;
  return Json::parse(text, [](int depth, Json::parse_event_t, const Json&) {
    if (depth > most_levels)
      throw FileError(fmt::format("lists and objects are more than {} deep", most_levels));
    return true;
  });
}

}  // namespace condyle::io
