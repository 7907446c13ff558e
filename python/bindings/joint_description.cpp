#include "joint.hpp"

#include <string>

#include "arrays.hpp"
#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/joint_checks.hpp"
#include "io/joint/ligament_tables.hpp"

namespace condyle::python {
namespace {

std::string word(const py::dict& given, const char* key) {
  return given[key].cast<std::string>();
}

Vec3 landmark(const py::dict& points, const char* name) {
  return vector_in(points[name], std::string("landmarks: ") + name);
}

PelvisLandmarks pelvis_in(const py::dict& points) {
  return {landmark(points, "right_asis"), landmark(points, "left_asis"), landmark(points, "right_psis"),
          landmark(points, "left_psis")};
}

FemurLandmarks femur_in(const py::dict& points) {
  return {landmark(points, "medial_epicondyle"), landmark(points, "lateral_epicondyle")};
}

/// The keys present decide, as in a joint file.
void set_landmarks(FrameDescription& frame, const py::dict& points) {
  const auto has = [&](const char* name) { return points.contains(name); };
  const bool epicondyles = has("medial_epicondyle") && has("lateral_epicondyle");
  const bool asis = has("right_asis") && has("left_asis");
  const bool psis = has("right_psis") && has("left_psis");
  const std::size_t count = points.size();
  if (asis && psis && epicondyles && count == 6) {
    frame.axes = pelvis_in(points);
    frame.mobile_axes = femur_in(points);
  } else if (asis && psis && count == 4) {
    frame.axes = pelvis_in(points);
  } else if (asis && has("pubic_symphysis") && count == 3) {
    frame.axes = AnteriorPelvicPlane{landmark(points, "right_asis"), landmark(points, "left_asis"),
                                     landmark(points, "pubic_symphysis")};
  } else if (epicondyles && has("hip_centre") && count == 3) {
    frame.axes = TransepicondylarAxis{landmark(points, "medial_epicondyle"),
                                      landmark(points, "lateral_epicondyle"), landmark(points, "hip_centre")};
  } else if (epicondyles && count == 2) {
    frame.axes = femur_in(points);
  } else {
    throw UsageError(
        "landmarks: there are those of the pelvis (right_asis, left_asis, with right_psis, left_psis or "
        "pubic_symphysis), the femur (medial_epicondyle, lateral_epicondyle), both, or the knee (epicondyles "
        "and hip_centre)");
  }
}

}  // namespace

JointDescription description_in(const py::dict& given) {
  const auto at = [&](const char* key) { return py::object(given[key]); };
  JointDescription joint;
  joint.name = word(given, "name");
  for (const JointKind kind : {JointKind::ball, JointKind::hinge, JointKind::free})
    if (word(given, "kind") == name_of(kind)) joint.kind = kind;
  for (const Anatomy anatomy : all_anatomies)
    if (word(given, "anatomy") == name_of(anatomy)) joint.anatomy = anatomy;
  joint.side = word(given, "side") == name_of(Side::right) ? Side::right : Side::left;
  joint.units = length_unit_named(word(given, "units"));
  if (word(given, "translation_frame") == name_of(TranslationFrame::joint_axes))
    joint.translation_frame = TranslationFrame::joint_axes;

  if (const py::object fit = at("fit"); !fit.is_none()) {
    CentreFit centre{fit.cast<std::string>() == "fixed" ? BodyRole::fixed : BodyRole::mobile, {}};
    if (const py::object within = at("fit_within"); !within.is_none())
      centre.within = Sphere{vector_in(within[py::int_(0)], "fit_within"),
                             py::object(within[py::int_(1)]).cast<double>()};
    joint.frame.centre = centre;
  } else if (!at("centre").is_none()) {
    joint.frame.centre = vector_in(at("centre"), "centre");
  }
  if (!at("landmarks").is_none())
    set_landmarks(joint.frame, at("landmarks").cast<py::dict>());
  else
    joint.frame.axes =
        FrameDirections{vector_in(at("anterior"), "anterior"), vector_in(at("superior"), "superior")};
  if (!at("fixed_in_W").is_none()) joint.fixed_in_W = one_pose(at("fixed_in_W"), "fixed_in_W");
  if (!at("mobile_in_W").is_none()) joint.mobile_in_W = one_pose(at("mobile_in_W"), "mobile_in_W");

  const Vec3 degrees = vector_in(at("reference_angles_deg"), "reference_pose");
  joint.reference_pose = {
      {Angle::degrees(degrees[0]), Angle::degrees(degrees[1]), Angle::degrees(degrees[2])},
      vector_in(at("reference_translation_mm"), "reference_pose")};
  for (const ZeroFrom from : {ZeroFrom::stated, ZeroFrom::anatomy})
    if (word(given, "zero_from") == name_of(from)) joint.zero_from = from;
  const auto [age, sex, species] =
      at("person").cast<std::tuple<std::optional<double>, std::optional<std::string>, std::string>>();
  joint.person.age_years = age;
  joint.person.species = species;
  for (const Sex each : all_sexes)
    if (sex == name_of(each)) joint.person.sex = each;
  joint.ligaments = io::ligaments_of_text(word(given, "ligaments"), joint);
  return joint;
}

}  // namespace condyle::python
