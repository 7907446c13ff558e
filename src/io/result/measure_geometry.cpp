#include "io/result/measure_geometry.hpp"

namespace condyle::io {
namespace {

template <class T, class Write>
Json if_found(const std::optional<T>& found, const Write& write) {
  return found ? Json(write(*found)) : Json(nullptr);
}

Json point_or_null(const std::optional<Vec3>& point) {
  return if_found(point, [](const Vec3& p) { return numbers(p); });
}

Json closest(const std::optional<measure::ClosestBones>& at) {
  return if_found(at, [](const measure::ClosestBones& points) {
    return Json{{"fixed_mm", numbers(points.fixed_point)}, {"mobile_mm", numbers(points.mobile_point)}};
  });
}

void add_femur(const measure::FemurMeasures& femur, Json& json) {
  json["head"] = if_found(femur.head, [](const Sphere& head) {
    return Json{{"centre_mm", numbers(head.centre)}, {"radius_mm", head.radius}};
  });
  json["neck"] = if_found(femur.neck, [](const measure::NeckGeometry& neck) {
    return Json{{"head_centre_mm", numbers(neck.head.centre)}, {"direction", numbers(neck.direction)}};
  });
  json["clock"] = if_found(femur.neck, [](const measure::NeckGeometry& neck) {
    return Json{{"twelve", numbers(neck.clock.twelve)},
                {"three", numbers(neck.clock.three)},
                {"from", neck.clock_from == measure::ClockSource::shaft ? "shaft" : "frame"}};
  });
  json["shaft"] = if_found(femur.shaft, [](const measure::ShaftGeometry& shaft) {
    return Json{
        {"first_mm", numbers(shaft.first)}, {"last_mm", numbers(shaft.last)}, {"bound_deg", shaft.bound_deg}};
  });
  json["condyles"] = if_found(femur.condyles, [](const measure::CondyleGeometry& condyles) {
    return Json{{"middle_mm", numbers(condyles.middle)},
                {"medial_mm", numbers(condyles.medial)},
                {"lateral_mm", numbers(condyles.lateral)}};
  });
  json["trochanter"] = if_found(femur.trochanter_top, [](const Vec3& top) {
    return Json{{"top_mm", numbers(top)}};
  });
}

void add_acetabulum(const measure::AcetabulumMeasures& acetabulum, Json& json) {
  json["rim_plane"] = if_found(acetabulum.plane, [](const measure::RimGeometry& plane) {
    return Json{{"centre_mm", numbers(plane.centre)},
                {"normal", numbers(plane.normal)},
                {"radius_mm", plane.radius_mm}};
  });
  json["chords"] = Json::array();
  for (const measure::RimChord& chord : acetabulum.chords)
    json["chords"].push_back({{"height_mm", chord.height_mm},
                              {"front_mm", numbers(chord.front)},
                              {"back_mm", numbers(chord.back)}});
  json["edges"] = {{"lateral_mm", point_or_null(acetabulum.lateral_edge)},
                   {"anterior_mm", point_or_null(acetabulum.anterior_edge)},
                   {"posterior_mm", point_or_null(acetabulum.posterior_edge)}};
  json["pelvis"] = {{"anterior", numbers(acetabulum.anterior)},
                    {"superior", numbers(acetabulum.superior)},
                    {"lateral", numbers(acetabulum.lateral)}};
}

}  // namespace

Json measure_geometry(const measure::HipMeasures& measures) {
  Json json;
  add_femur(measures.femur, json);
  add_acetabulum(measures.acetabulum, json);
  json["joint_space"] = closest(measures.both.joint_space_at);
  json["ischiofemoral"] = closest(measures.both.ischiofemoral_at);
  return json;
}

}  // namespace condyle::io
