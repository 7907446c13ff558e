#include <vector>

#include "condyle/contact.hpp"
#include "condyle/error.hpp"
#include "fuzz/brute_contact.hpp"
#include "fuzz/fuzz_input.hpp"
#include "fuzz/one_line.hpp"
#include "fuzz/targets.hpp"
#include "support/brute_force.hpp"

namespace condyle::test {
namespace {

/// Every pair by brute force; triangles of zero area meet nothing.
std::vector<contact::TrianglePair> all_pairs(const TriMesh& fixed, const TriMesh& mobile) {
  std::vector<contact::TrianglePair> pairs;
  for (const auto& [i, j] : intersecting_pairs(fixed, mobile)) {
    if (!is_degenerate(fixed, i) && !is_degenerate(mobile, j)) pairs.push_back({i, j});
  }
  return pairs;
}

}  // namespace

std::string fuzz_pairs(std::string_view bytes) {
  FuzzInput input(bytes);
  try {
    const Mesh fixed = input.mesh(), mobile = input.mesh();
    const Pose X_FM = input.pose();
    const contact::JointContact joint(fixed, mobile);
    const std::vector<contact::TrianglePair> pairs = joint.pairs(X_FM);
    const TriMesh placed = posed(X_FM, mobile.arrays());
    if (pairs != all_pairs(fixed, placed)) return "other pairs than brute force finds";
    const bool in_contact = joint.in_contact(X_FM);
    if (!pairs.empty() && !in_contact) return "pairs that meet and no contact";
    if (pairs.empty() && !has_degenerate(fixed) && !has_degenerate(placed) &&
        in_contact != (corner_inside(mobile, X_FM, fixed) ||
                       corner_inside(fixed, Pose::Identity(), mobile.moved_to(placed.vertices))))
      return "one body inside the other is wrong";
  } catch (const MeshError& error) {
    return fault_of_message(error.what());
  } catch (const UsageError& error) {
    return fault_of_message(error.what());
  }
  return {};
}

}  // namespace condyle::test
