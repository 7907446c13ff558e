#include "condyle/answer/case.hpp"

namespace condyle {

std::vector<motion::Motion> Case::motions() const {
  return motion::with_own_motions(motion::built_in_motions(joint.kind, joint.anatomy), own_motions);
}

std::vector<motion::Motion> Case::motions(std::span<const std::string> names) const {
  std::vector<motion::Motion> known = motions();
  if (names.empty()) return known;
  std::vector<motion::Motion> chosen;
  for (const std::string& name : names) chosen.push_back(motion::motion_named(known, name));
  return chosen;
}

measure::MeasureOptions Case::measure_options(Angle pelvic_tilt) const {
  return {.pelvic_tilt = pelvic_tilt,
          .pelvis_frame = pelvis_frame,
          .ischiofemoral_pose = placement.reference_pose.angles};
}

motion::BandOptions band_options(const Case& joint, const BandRequest& request) {
  motion::Uncertainty sigma = joint.uncertainty;
  if (request.centre_mm) sigma.centre_mm = *request.centre_mm;
  if (request.axes_deg) sigma.axes = Angle::degrees(*request.axes_deg);
  if (request.surface_mm)
    sigma.surface_mm = *request.surface_mm, sigma.surface_voxels = 0, sigma.surface_from.clear();
  return {.sigma = sigma, .samples = request.samples, .seed = request.seed.value_or(joint.band_seed)};
}

}  // namespace condyle
