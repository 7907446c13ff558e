#pragma once

#include "condyle/hip_measures.hpp"
#include "condyle/io/joint_file.hpp"

namespace condyle::io {

/// How the hip of a joint file is measured: in the frame that its axes are from, the ischiofemoral distance in its reference pose.
inline measure::MeasureRequest measure_request_of(const LoadedJoint& loaded, Angle pelvic_tilt = {}) {
  return {.pelvic_tilt = pelvic_tilt,
          .pelvis_frame = measure::pelvis_frame_of(loaded.report.file.joint.frame),
          .ischiofemoral_pose = loaded.report.placement.reference_pose.angles};
}

}  // namespace condyle::io
