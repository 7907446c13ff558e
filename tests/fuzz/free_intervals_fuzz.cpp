#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "answer/require_surface.hpp"
#include "condyle/error.hpp"
#include "condyle/first_contact.hpp"
#include "fuzz/brute_contact.hpp"
#include "fuzz/fuzz_input.hpp"
#include "fuzz/one_line.hpp"
#include "fuzz/targets.hpp"

namespace condyle::test {
namespace {

/// Positions of a motion between which nothing meets, in a unit in which those of interest differ by much more than `apart`.
struct Free {
  struct Interval {
    double low, high;
  };
  std::vector<Interval> intervals;
  double apart;
};

/// Ascending, and free or in contact by brute force where the answer says so. Three positions near each other: what rounding makes of one
/// it does not make of all.
template <typename PoseAt>
std::string fault_of(const Free& free, const std::vector<double>& asked, const Mesh& fixed,
                     const Mesh& mobile, const PoseAt& pose_at) {
  for (std::size_t i = 0; i < free.intervals.size(); ++i) {
    const auto& [low, high] = free.intervals[i];
    if (!(low <= high)) return "an interval that ends before it begins";
    if (i > 0 && !(free.intervals[i - 1].high <= low + free.apart)) return "intervals that overlap";
  }
  const TriMesh plain = mobile.arrays();
  for (const double at : asked) {
    bool is_free = false, is_near_an_end = false;
    for (const auto& [low, high] : free.intervals) {
      is_free = is_free || (low <= at && at <= high);
      is_near_an_end =
          is_near_an_end || std::abs(at - low) < 2 * free.apart || std::abs(at - high) < 2 * free.apart;
    }
    if (is_near_an_end) continue;
    int met = 0;
    for (const double off : std::array{-free.apart, 0.0, free.apart}) {
      const Pose X = pose_at(at + off);
      met += surfaces_meet(fixed, plain, X) || corner_inside(plain, X, fixed) ||
             corner_inside(fixed, Pose::Identity(), mobile.moved_to(posed(X, plain).vertices));
    }
    if (is_free && met == 3) return "surfaces that meet in a free interval";
    if (!is_free && met == 0 && !has_degenerate(fixed) && !has_degenerate(mobile))
      return "nothing that meets where no interval is";
  }
  return {};
}

template <typename Question>
std::string without_errors(const Question& question) {
  try {
    return question();
  } catch (const MeshError& error) {
    return fault_of_message(error.what());
  } catch (const UsageError& error) {
    return fault_of_message(error.what());
  }
}

}  // namespace

std::string fuzz_turns(std::string_view bytes) {
  FuzzInput input(bytes);
  return without_errors([&]() -> std::string {
    const Mesh fixed = input.mesh(), mobile = input.mesh();
    for (const Mesh* mesh : std::array{&fixed, &mobile}) require_surface(*mesh, "a body");
    const auto turns = motion::free_turns(fixed, mobile, AxisFrame(Vec3::Zero(), Vec3::UnitZ()));
    Free free{{}, 1e-6};
    // A turn before and after too.
    for (const double turn : std::array{-two_pi, 0.0, two_pi})
      for (const auto& each : turns.intervals)
        free.intervals.push_back({each.low.radians() + turn, each.high.radians() + turn});
    std::vector<double> asked;
    for (int i = 0; i < 6; ++i) asked.push_back(two_pi * (i + 0.37) / 6);
    return fault_of(free, asked, fixed, mobile, [](double angle) {
      Pose X = Pose::Identity();
      X.linear() = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
      return X;
    });
  });
}

std::string fuzz_slides(std::string_view bytes) {
  FuzzInput input(bytes);
  return without_errors([&]() -> std::string {
    const Mesh fixed = input.mesh(), mobile = input.mesh();
    for (const Mesh* mesh : std::array{&fixed, &mobile}) require_surface(*mesh, "a body");
    const auto slides = motion::free_slides(fixed, mobile, Vec3::UnitZ());
    double size = 0;
    for (const Mesh* mesh : std::array{&fixed, &mobile})
      for (std::size_t v = 0; v < mesh->vertices().size(); ++v)
        size = std::max(size, mesh->vertices()[v].cwiseAbs().maxCoeff());
    Free free{{}, 1e-6 * size};
    for (const auto& each : slides.intervals)
      free.intervals.push_back({each.low.at_mm.value_or(-8 * size), each.high.at_mm.value_or(8 * size)});
    std::vector<double> asked;
    for (int i = -3; i < 3; ++i) asked.push_back(size * (i + 0.37) / 2);
    return fault_of(free, asked, fixed, mobile, [](double along) {
      Pose X = Pose::Identity();
      X.translation().z() = along;
      return X;
    });
  });
}

}  // namespace condyle::test
