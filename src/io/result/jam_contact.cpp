#include "io/result/jam_contact.hpp"

#include <cctype>
#include <limits>

#include "io/joint/coordinate_name.hpp"
#include "io/result/coordinate_at.hpp"

namespace condyle::io {
namespace {

/// A name as MATLAB takes it for a field.
std::string field_name(std::string_view name) {
  std::string out;
  for (const char c : name) out += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  if (out.empty() || !std::isalpha(static_cast<unsigned char>(out.front()))) out.insert(0, "m");
  return out.substr(0, 63);
}

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

JamTotals without_answer() {
  const Vec3 no_vector = Vec3::Constant(no_value);
  return {no_value, no_value, no_value, no_vector, no_value, no_value, no_vector, no_vector, no_vector};
}

JamTotals in_si_units(const contact::ContactTotals& totals) {
  return {.contact_area_m2 = 1e-6 * totals.area_mm2,
          .mean_proximity_m = 1e-3 * totals.mean_depth_mm,
          .max_proximity_m = 1e-3 * totals.max_depth_mm,
          .centre_of_proximity_m = 1e-3 * totals.centre_of_depth.value_or(Vec3::Zero()),
          .mean_pressure_pa = 1e6 * totals.mean_pressure_mpa,
          .max_pressure_pa = 1e6 * totals.max_pressure_mpa,
          .centre_of_pressure_m = 1e-3 * totals.centre_of_pressure.value_or(Vec3::Zero()),
          .contact_force_n = totals.force_n,
          .contact_moment_nm = -1e-3 * totals.moment_nmm};  // JAM reports the moment on the target
}

/// A half of a surface, in JAM's order: even ones are below 0 along an axis, odd ones not.
contact::HalfSpace half_of_region(std::size_t region) {
  contact::HalfSpace half{Vec3::Unit(static_cast<Eigen::Index>(region / 2)), 0};
  if (region % 2 == 0)
    half.normal = -half.normal;
  else
    half.offset_mm = -std::numeric_limits<double>::denorm_min();  // with 0 itself, and nothing below it
  return half;
}

/// The casting surface of a motion.
class CastingSurface {
 public:
  CastingSurface(const Mesh& mesh, contact::FaceRule rule, bool with_pressure)
      : mesh_(mesh), rule_(rule), with_pressure_(with_pressure) {}

  JamFrame frame(const std::optional<motion::FrameContact>& frame) const {
    const std::size_t triangles = mesh_.triangles().size();
    JamFrame jam;
    if (!frame) {
      jam.total = without_answer();
      jam.regional.assign(jam_regions, without_answer());
      jam.triangle_proximity_m.assign(triangles, no_value);
      if (with_pressure_) jam.triangle_pressure_pa.assign(triangles, no_value);
      return jam;
    }
    const contact::SurfaceContact& surface = frame->surface;
    jam.total = in_si_units(surface.totals);
    for (std::size_t region = 0; region < jam_regions; ++region) {
      const contact::HalfSpace half = half_of_region(region);
      jam.regional.push_back(in_si_units(
          contact::totals_of(contact::faces_within(surface.faces, mesh_, {&half, 1}), mesh_, rule_)));
    }
    jam.triangle_proximity_m.assign(triangles, 0);
    if (with_pressure_) jam.triangle_pressure_pa.assign(triangles, 0);
    for (const contact::FaceContact& face : surface.faces) {
      jam.triangle_proximity_m[face.face] = 1e-3 * face.mean_depth_mm();
      if (with_pressure_) jam.triangle_pressure_pa[face.face] = 1e6 * face.mean_pressure_mpa();
    }
    return jam;
  }

 private:
  const Mesh& mesh_;
  contact::FaceRule rule_;
  bool with_pressure_;
};

}  // namespace

JamContact jam_contact(const MotionQuestion& question, const MotionAnswer& answer) {
  const ContactSurfaces& surfaces = question.surfaces;
  const bool fixed_casts = question.contact.casting == contact::Casting::fixed;
  const Body &casting = fixed_casts ? surfaces.fixed : surfaces.mobile,
             &target = fixed_casts ? surfaces.mobile : surfaces.fixed;
  JamContact contact{
      field_name(question.joint.joint.name), {field_name(casting.name), {}}, {field_name(target.name), {}}};
  const CastingSurface surface(casting.mesh, question.contact.rays.rule, question.with_pressure);
  for (const auto& frame : answer.frames) contact.casting.frames.push_back(surface.frame(frame));
  return contact;
}

std::vector<JamCoordinate> jam_coordinates(const MotionQuestion& question, const MotionAnswer& answer) {
  const Joint& joint = question.joint.joint;
  std::vector<JamCoordinate> coordinates;
  for (const CoordinateName& name : coordinate_names_of(joint.kind, joint.anatomy)) {
    const double unit = name.kind == CoordinateKind::angle ? 1 : 1e-3;
    const std::size_t number = coordinates.size();
    auto& values = coordinates.emplace_back(JamCoordinate{field_name(name.name), {}}).values;
    for (const auto& frame : answer.frames)
      values.push_back(frame ? unit * coordinate_at(joint, frame->X_FM, number) + 0.0 : no_value);
  }
  return coordinates;
}

}  // namespace condyle::io
