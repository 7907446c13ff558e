#include <utility>

#include "io/motion/column_zero.hpp"
#include "io/report/report.hpp"

namespace condyle::io {

Report report_of(const LoadedJoint& loaded, const RomResult* rom, std::string why_none) {
  Report report{.title = loaded.joint.name,
                .joint = loaded.joint,
                .reference_pose = loaded.report.placement.reference_pose,
                .rom = rom,
                .rom_error = std::move(why_none)};
  const JointFile& file = loaded.report.file;
  if (file.recorded_motion) report.recorded_motion = &*file.recorded_motion;
  // A page poses columns by the joint's own zero.
  static const RecordedMotionMapping not_by_a_page = PosesOfModel{};
  if (file.recorded_zero && is_moved(*file.recorded_zero, loaded.joint))
    report.recorded_motion = &not_by_a_page;
  return report;
}

}  // namespace condyle::io
