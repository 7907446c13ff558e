#include "kinematics/axis_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "condyle/error.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/resampling.hpp"

namespace condyle::kinematics {

void bound_axis(const Points& vertices, const AxisPatches& patches, CylinderFit& fit) {
  constexpr std::size_t unknowns = 5;
  const Cylinder c = fit.cylinder;
  const Vec3 e1 = c.direction.unitOrthogonal(), e2 = c.direction.cross(e1);
  const auto block_of = [&](Index v) {
    const Vec3 q = vertices[v] - c.point;
    const double turn = core::arctangent(q.dot(e2), q.dot(e1)) / two_pi + 0.5;
    const int sector = std::min(static_cast<int>(turn * patches.sectors), patches.sectors - 1);
    return std::int64_t{sector} * patches.slices + patches.slice_at(q.dot(c.direction));
  };
  const auto resamples = resampled(fit.vertices, usual_resamples, unknowns, block_of);
  std::vector<double> turns, shifts;
  for (const std::vector<Index>& drawn : resamples.draws) {
    try {
      const Cylinder other = fit_cylinder(vertices, drawn, c).cylinder;
      shifts.push_back((other.point - c.point).cross(other.direction).norm());
      turns.push_back(core::arctangent(other.direction.cross(c.direction).norm(),
                                       std::abs(other.direction.dot(c.direction))));
    } catch (const MeshError&) {  // no axis at all
      shifts.push_back(c.radius);
      turns.push_back(two_pi / 4);
    }
  }
  fit.direction_bound = Angle::radians(upper_bound_of(std::move(turns)) * resamples.widening);
  fit.axis_bound_mm = upper_bound_of(std::move(shifts)) * resamples.widening;
}

}  // namespace condyle::kinematics
