#include <utility>

#include "io/report/report.hpp"

namespace condyle::io {

Report report_of(const LoadedJoint& loaded, const RomResult* rom, std::string why_none) {
  Report report{.title = loaded.joint.name,
                .joint = loaded.joint,
                .reference_pose = loaded.report.placement.reference_pose,
                .rom = rom,
                .rom_error = std::move(why_none)};
  if (loaded.report.file.recorded_motion) report.recorded_motion = &*loaded.report.file.recorded_motion;
  return report;
}

}  // namespace condyle::io
