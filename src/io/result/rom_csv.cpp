#include <fmt/format.h>

#include "condyle/io/pose_text.hpp"
#include "condyle/io/rom_result.hpp"
#include "io/joint/given_degrees.hpp"
#include "io/result/clock_hour.hpp"
#include "io/result/csv_field.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/rom_parts.hpp"

namespace condyle {
namespace {

/// "start_flexion_deg,start_adduction_deg,start_internal_rotation_deg,".
std::string angle_columns(std::string_view when, Anatomy joint) {
  std::string columns;
  for (const JointAngle angle : all_joint_angles)
    columns += fmt::format("{}_{}_deg,", when, name_of(angle, joint));
  return columns;
}

std::string band_fields(const LimitBand& band) {
  std::string fields;
  for (const Angle angle : {band.p5, band.median, band.p95, band.width_from.centre, band.width_from.axes,
                            band.width_from.surface})
    fields += fmt::format(",{}", angle.degrees());
  return fields + fmt::format(",{}", band.share_without_contact);
}

}  // namespace

std::string rom_csv(const RomResult& result) {
  const AnswerFrame frame = frame_of(result);
  const Anatomy joint = result.joint.anatomy;
  std::string text =
      io::provenance_comments(result.provenance) +
      "motion,limit_deg,reason,contact_kind,bearing_contact_deg,centre_distance_mm,joint_space_mm,"
      "error_bound_deg,vary,sense,range_deg," +
      angle_columns("start", joint) + angle_columns("limit", joint) +
      "contact_x_mm,contact_y_mm,contact_z_mm,"
      "contact_mobile_x_mm,contact_mobile_y_mm,contact_mobile_z_mm,fixed_feature,mobile_feature,fixed_part,"
      "mobile_part,"
      "clock_hour,"
      "band_p5_deg,band_median_deg,band_p95_deg,band_from_centre_deg,band_from_axes_deg,band_from_surface_"
      "deg,"
      "band_share_without_contact,normal_range_deg\n";
  const auto point = [](const Vec3& p) { return fmt::format("{},{},{}", p.x(), p.y(), p.z()); };
  const auto start = [](const JointAngles& a) {
    return fmt::format("{},{},{}", io::given_degrees(a.flexion), io::given_degrees(a.adduction),
                       io::given_degrees(a.internal_rotation));
  };
  const auto angles = [](const JointAngles& a) {
    return fmt::format("{},{},{}", a.flexion.degrees(), a.adduction.degrees(), a.internal_rotation.degrees());
  };
  for (std::size_t i = 0; i < result.limits.size(); ++i) {
    const MotionLimit& limit = result.limits[i];
    const auto& [motion, end, head] = limit;
    const auto field = [](const std::optional<double>& value) {
      return value ? fmt::format("{}", *value) : "";
    };
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},", io::csv_field(motion.name), end.turned.degrees(),
        name_of(end.reason), io::ends_in_contact(limit) ? name_of(end.kind()) : "",
        end.bearing_contact ? fmt::format("{}", end.bearing_contact->turned.degrees()) : "",
        head ? field(head->centre_distance_mm) : "", head ? field(head->joint_space_mm) : "",
        end.error_bound.degrees(), name_of(motion.vary, joint),
        motion.sense == RotationSense::positive ? "positive" : "negative", io::given_degrees(motion.range),
        start(motion.start), angles(limit.angles_at_limit()));
    const auto hour = io::clock_hour(result, limit);
    const auto& contact = end.contact;
    const auto part = [](const Body& body, const Feature& feature) {
      const BodyPart* of = io::part_of(body, feature);
      return of ? io::csv_field(of->name) : std::string();
    };
    text += contact ? fmt::format("{},{},{},{},{},{}", point(frame.fixed_point(contact->fixed_point)),
                                  point(frame.mobile_point(contact->mobile_point)),
                                  io::text_of(contact->fixed_feature), io::text_of(contact->mobile_feature),
                                  part(result.joint.fixed, contact->fixed_feature),
                                  part(result.joint.mobile, contact->mobile_feature))
                    : std::string(",,,,,,,,,");
    text += hour ? fmt::format(",{}", *hour) : ",";
    text += result.bands.empty() ? ",,,,,,," : band_fields(result.bands[i]);
    const auto normal = io::normal_range(result, limit);
    text += normal ? fmt::format(",{}\n", io::given_degrees(*normal)) : ",\n";
  }
  return text;
}

}  // namespace condyle
