#include "range.hpp"

#include <fmt/format.h>

#include <stop_token>

#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/rom_result.hpp"
#include "followed.hpp"

namespace condyle::cli {
std::vector<Motion> motions_of(const LoadedJoint& loaded) {
  return with_own_motions(built_in_motions(loaded.joint.kind, loaded.joint.anatomy),
                          loaded.report.file.motions);
}

std::optional<Vec3> held_translation(const std::string& given, const LoadedJoint& loaded) {
  const Joint& joint = loaded.joint;
  if (joint.kind != JointKind::free) {
    if (!given.empty()) throw UsageError("--translation: only a free joint translates");
    return std::nullopt;
  }
  const PoseDegrees pose = parse_pose(given, joint.kind, joint.anatomy);
  if (pose.angles() != JointAngles{}) throw UsageError("--translation: takes x, y and z only");
  const Vec3 held =
      given.empty() ? loaded.report.placement.reference_pose.translation_mm : pose.translation_mm;
  if (joint.translation_frame == TranslationFrame::joint_axes && held != Vec3::Zero())
    throw UsageError(
        "--translation: held along the joint's axes it would turn with them: motions need \"x=0\" or "
        "translation_frame = \"fixed\"");
  return held;
}

std::vector<std::optional<ImpingementZone>> zones_of(const std::optional<ZoneFinder>& finder,
                                                     std::span<const MotionLimit> limits) {
  std::vector<std::optional<ImpingementZone>> zones;
  if (finder)
    for (const MotionLimit& limit : limits) zones.push_back(finder->zone(limit));
  return zones;
}

RangeFound exact_range(const Joint& joint, std::span<const Motion> motions, const RangeOptions& asked,
                       const std::optional<MapGrid>& grid, const BandOptions& band) {
  const RangeOfMotion range(joint, asked);
  RangeFound found;
  found.limits = range.limits(motions);
  found.bearing = range.bearing();
  found.bearing_rule = range.bearing_rule();
  found.terms = terms_of(asked, range);
  if (grid) {
    found.map = followed("map points", [&](const auto& follow, std::stop_token stop) {
      return motion_map(*grid, range, {.progress = follow, .stop = stop});
    });
  }
  if (band.samples > 0) {
    RangeOptions again = asked;
    again.bearing.surface = found.bearing.surface;
    found.bands = followed("joints of the band", [&](const auto& follow, std::stop_token stop) {
      return limit_bands(joint, motions, again, band, {.progress = follow, .stop = stop});
    });
  }
  return found;
}

}  // namespace condyle::cli
