// The figures of docs/range-of-motion.md for a centre that moves: limits of joints with their centre moved by a millimetre, in brackets what
// counting bearing contact would make of them, and how far they change.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

#include "condyle/io/joint_file.hpp"
#include "condyle/range_of_motion.hpp"

namespace {

using condyle::Joint, condyle::motion::MotionLimit, condyle::Vec3;

constexpr double millimetre = 1;

condyle::TriMesh moved(condyle::TriMesh mesh, const Vec3& by) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) mesh.vertices.set(v, mesh.vertices[v] + by);
  return mesh;
}

std::vector<double> limits_deg(Joint joint, const Vec3& centre, condyle::motion::BearingRule rule) {
  joint.fixed.mesh = moved(joint.fixed.mesh, -centre);
  joint.mobile.mesh = moved(joint.mobile.mesh, -centre);
  const condyle::motion::RangeOfMotion range(
      joint, {.bearing = {.rule = rule},
              .overlap = {.reference_contact = condyle::motion::ReferenceContact::accept}});
  std::vector<double> limits;
  for (const MotionLimit& limit : range.limits(condyle::motion::hip_motions()))
    limits.push_back(limit.end.turned.degrees());
  return limits;
}

/// Changes by a displacement, of all motions and displacements.
struct Changes {
  std::vector<double> deg;

  double largest() const { return *std::max_element(deg.begin(), deg.end()); }
  double ninetieth_percentile() const {
    std::vector<double> sorted = deg;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() * 9 / 10];
  }
};

void print_table(const Joint& joint, Changes& impingement, Changes& counted) {
  const std::array<Vec3, 7> centres{Vec3(0, 0, 0),           Vec3(-millimetre, 0, 0), Vec3(millimetre, 0, 0),
                                    Vec3(0, -millimetre, 0), Vec3(0, millimetre, 0),  Vec3(0, 0, -millimetre),
                                    Vec3(0, 0, millimetre)};
  std::printf("**%s**\n\n| centre moved by |", joint.name.c_str());
  for (const condyle::motion::Motion& motion : condyle::motion::hip_motions())
    std::printf(" %s |", motion.name.c_str());
  std::printf("\n|---|");
  for (std::size_t i = 0; i < condyle::motion::hip_motions().size(); ++i) std::printf("--:|");
  std::vector<double> first, first_counted;
  for (const Vec3& centre : centres) {
    const auto limits = limits_deg(joint, centre, condyle::motion::BearingRule::leave_out);
    const auto all = limits_deg(joint, centre, condyle::motion::BearingRule::count);
    std::printf("\n| %g, %g, %g |", centre.x(), centre.y(), centre.z());
    for (std::size_t i = 0; i < limits.size(); ++i) {
      std::printf(" %.2f", limits[i]);
      if (std::abs(limits[i] - all[i]) > 0.005) std::printf(" (%.2f)", all[i]);
      std::printf(" |");
      if (first.empty()) continue;
      impingement.deg.push_back(std::abs(limits[i] - first[i]));
      counted.deg.push_back(std::abs(all[i] - first_counted[i]));
    }
    if (first.empty()) first = limits, first_counted = all;
  }
  std::printf("\n\n");
}

void print(const char* what, const Changes& changes) {
  std::printf("| %s | %.1f | %.1f |\n", what, changes.largest(), changes.ninetieth_percentile());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s JOINT...   hips as joint files\n", argv[0]);
    return 2;
  }
  try {
    Changes impingement, counted;
    for (int i = 1; i < argc; ++i) print_table(condyle::io::read_joint(argv[i]).joint, impingement, counted);
    std::printf("| change of a limit, degrees | largest | nine in ten below |\n|---|--:|--:|\n");
    print("impingement ends a motion", impingement);
    print("any contact ends a motion", counted);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
