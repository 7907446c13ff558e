#include "contact/along_rays.hpp"
#include "contact/overlap_sampler.hpp"

namespace condyle::contact {

OverlapSampler::SampleEnds OverlapSampler::ends_of(const OverlapSample& sample, const Results& found) const {
  SampleEnds ends;
  const auto& vertices = casting_.triangles()[sample.face];
  if (sample.triangle != no_index) {
    Vec3 normal = face_normals()[sample.face];
    if (options_.rule == FaceRule::cut_faces) {
      const auto& [a, b, c] = rays_.of_corners(sample.face);
      normal = unit(sample.at[0] * rays_.normal(a) + sample.at[1] * rays_.normal(b) +
                    sample.at[2] * rays_.normal(c));
    }
    ends.add({sample.triangle, 1, sample.point - sample.depth * normal, sample.gradient, sample.at});
    return ends;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<double, 3> start{};
    if (sample.run_on == no_index)
      start[k] = sample.at[k];
    else
      start = found.run_on[sample.run_on][k];
    const double weight = start[0] + start[1] + start[2];
    if (weight == 0) continue;
    const Index ray = rays_.of_corners(sample.face)[k];
    const RayEnd& end = found.ends[ray];
    Vec3 place = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) place += start[i] / weight * casting_.vertices()[vertices[i]];
    // The parallel to the ray through the place, up to the plane that the ray ends on.
    const Vec3 met = casting_.vertices()[vertices[k]] - end.depth * rays_.normal(ray);
    ends.add({end.triangle, weight, place - end.gradient.dot(met - place) * rays_.normal(ray), end.gradient,
              start});
  }
  return ends;
}

}  // namespace condyle::contact
