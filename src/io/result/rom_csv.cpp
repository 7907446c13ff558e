#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "condyle/io/caveats.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/rom_result.hpp"
#include "io/joint/given_degrees.hpp"
#include "io/result/clock_hour.hpp"
#include "io/result/csv_field.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/rom_columns.hpp"
#include "io/result/rom_parts.hpp"

namespace condyle {
namespace {

using Fields = std::vector<std::string>;

void append(Fields& fields, const Fields& more) {
  fields.insert(fields.end(), more.begin(), more.end());
}

std::string number_text(double value) {
  return fmt::format("{}", value);
}

std::string number_text(const std::optional<double>& value) {
  return value ? number_text(*value) : std::string();
}

/// "start_flexion_deg", "start_adduction_deg", "start_internal_rotation_deg".
Fields angle_columns(std::string_view when, Anatomy joint) {
  Fields columns;
  for (const JointAngle angle : all_joint_angles)
    columns.push_back(fmt::format("{}_{}_deg", when, name_of(angle, joint)));
  return columns;
}

Fields point_fields(const Vec3& p) {
  return {number_text(p.x()), number_text(p.y()), number_text(p.z())};
}

Fields end_fields(const MotionLimit& limit) {
  const auto& [motion, end, head] = limit;
  return {io::csv_field(motion.name),
          number_text(end.turned.degrees()),
          std::string(name_of(end.reason)),
          io::ends_in_contact(limit) ? std::string(name_of(end.kind())) : "",
          end.bearing_contact ? number_text(end.bearing_contact->turned.degrees()) : "",
          head ? number_text(head->centre_distance_mm) : "",
          head ? number_text(head->joint_space_mm) : "",
          number_text(end.error_bound.degrees())};
}

Fields motion_fields(const MotionLimit& limit, Anatomy joint) {
  const Motion& motion = limit.motion;
  const JointAngles &start = motion.start, at_limit = limit.angles_at_limit();
  return {std::string(name_of(motion.vary, joint)),
          motion.sense == RotationSense::positive ? "positive" : "negative",
          number_text(io::given_degrees(motion.range)),
          number_text(io::given_degrees(start.flexion)),
          number_text(io::given_degrees(start.adduction)),
          number_text(io::given_degrees(start.internal_rotation)),
          number_text(at_limit.flexion.degrees()),
          number_text(at_limit.adduction.degrees()),
          number_text(at_limit.internal_rotation.degrees())};
}

/// Where it is in contact: points, features, parts.
Fields contact_fields(const RomResult& result, const std::optional<ContactWitness>& contact) {
  if (!contact) return Fields(10);
  const AnswerFrame frame = frame_of(result);
  const auto part = [](const Body& body, const Feature& feature) {
    const BodyPart* of = io::part_of(body, feature);
    return of ? io::csv_field(of->name) : std::string();
  };
  Fields fields = point_fields(frame.fixed_point(contact->fixed_point));
  append(fields, point_fields(frame.mobile_point(contact->mobile_point)));
  append(fields, {io::text_of(contact->fixed_feature), io::text_of(contact->mobile_feature),
                  part(result.joint.fixed, contact->fixed_feature),
                  part(result.joint.mobile, contact->mobile_feature)});
  return fields;
}

/// With blanks between.
std::string caveat_codes(const std::vector<MotionCaveat>& caveats) {
  std::string codes;
  for (const MotionCaveat& caveat : caveats)
    codes += fmt::format("{}{}", codes.empty() ? "" : " ", name_of(caveat.code));
  return codes;
}

Fields band_fields(const LimitBand& band) {
  Fields fields;
  for (const Angle angle : {band.p5, band.median, band.p95, band.width_from.centre, band.width_from.axes,
                            band.width_from.surface})
    fields.push_back(number_text(angle.degrees()));
  fields.push_back(number_text(band.share_without_contact));
  return fields;
}

}  // namespace

std::vector<std::string> io::rom_columns(Anatomy joint) {
  Fields columns = {"motion",
                    "limit_deg",
                    "reason",
                    "contact_kind",
                    "bearing_contact_deg",
                    "centre_distance_mm",
                    "joint_space_mm",
                    "error_bound_deg",
                    "vary",
                    "sense",
                    "range_deg"};
  append(columns, angle_columns("start", joint));
  append(columns, angle_columns("limit", joint));
  append(columns, {"contact_x_mm",
                   "contact_y_mm",
                   "contact_z_mm",
                   "contact_mobile_x_mm",
                   "contact_mobile_y_mm",
                   "contact_mobile_z_mm",
                   "fixed_feature",
                   "mobile_feature",
                   "fixed_part",
                   "mobile_part",
                   "clock_hour",
                   "band_p5_deg",
                   "band_median_deg",
                   "band_p95_deg",
                   "band_from_centre_deg",
                   "band_from_axes_deg",
                   "band_from_surface_deg",
                   "band_share_without_contact",
                   "normal_range_deg",
                   "caveats"});
  return columns;
}

std::vector<std::string> io::rom_fields(const RomResult& result, std::size_t i) {
  const MotionLimit& limit = result.limits[i];
  Fields fields = end_fields(limit);
  append(fields, motion_fields(limit, result.joint.anatomy));
  append(fields, contact_fields(result, limit.end.contact));
  fields.push_back(number_text(io::clock_hour(result, limit)));
  append(fields, result.bands.empty() ? Fields(7) : band_fields(result.bands[i]));
  const auto normal = io::normal_range(result, limit);
  fields.push_back(normal ? number_text(io::given_degrees(*normal)) : std::string());
  fields.push_back(caveat_codes(motion_caveats(result.joint, limit.motion)));
  return fields;
}

std::string io::csv_line(const std::vector<std::string>& fields) {
  return fmt::format("{}\n", fmt::join(fields, ","));
}

std::string rom_csv(const RomResult& result) {
  const Fields columns = io::rom_columns(result.joint.anatomy);
  const auto clock = std::find(columns.begin(), columns.end(), "clock_hour") - columns.begin();
  const auto line = [&](Fields fields) {
    if (!result.joint.is_hip()) fields.erase(fields.begin() + clock);  // a hip's socket has a clock face
    return io::csv_line(fields);
  };
  std::string text = io::provenance_comments(result.provenance) + line(columns);
  for (std::size_t i = 0; i < result.limits.size(); ++i) text += line(io::rom_fields(result, i));
  return text;
}

}  // namespace condyle
