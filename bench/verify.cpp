// condyle-verify: the fast paths against the plain ones, many million times, on the scenes of the bench.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <random>

#include "condyle/radial.hpp"
#include "scenes.hpp"
#include "simd/instruction_set.hpp"

namespace bench {
namespace {

using condyle::PointState;
using condyle::Pose;
using condyle::radial::Penetrations;

struct Options {
  double decisions = 1e8;
  unsigned seed = 1;
};

/// One of the scene's poses, then some other turn about a random axis and some shift: by very little, so that
/// surfaces graze, or by much.
Pose near(const Pose& X_FM, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(-6, 0);
  const auto direction = [&] {
    return condyle::Vec3(normal(random), normal(random), normal(random)).normalized();
  };
  Pose nudge = Pose::Identity();
  nudge.rotate(Eigen::AngleAxisd(0.3 * std::pow(10, exponent(random)), direction()));
  nudge.translation() = 0.5 * std::pow(10, exponent(random)) * direction();
  return nudge * X_FM;
}

/// Points inside or on the surface by the plain query, as `penetrations` orders them.
struct Truth {
  condyle::radial::RadialResults hits;
  std::size_t inside = 0;

  Truth(const condyle::radial::RadialTable& table, condyle::PointsView points, const Pose& X_FM)
      : hits(table.query(condyle::posed(X_FM, points))) {
    for (const PointState state : hits.state) inside += state != PointState::outside;
  }

  /// How many points have another answer, in any value of it.
  std::int64_t wrong(const Penetrations& found) const {
    std::int64_t wrong = 0;
    std::size_t reported_inside = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const condyle::Index p = found.point[i];
      reported_inside += hits.state[p] != PointState::outside;
      const bool is_right = found.state[i] == hits.state[p] && found.winding[i] == hits.winding[p] &&
                            found.triangle[i] == hits.triangle[p] &&
                            found.depth_mm[i] == -hits.radial_gap_mm[p] &&
                            found.direction[i] == hits.direction[p];
      wrong += !is_right;
    }
    return wrong + static_cast<std::int64_t>(inside - reported_inside);
  }
};

struct Count {
  std::int64_t decisions = 0, inside = 0, uncertain = 0, wrong = 0;
};

Count verify(const Scene& scene, double decisions, unsigned seed) {
  const condyle::radial::RadialTable table(scene.joint.fixed.mesh);
  const condyle::PointsView vertices = scene.joint.mobile.mesh.vertices().view();
  const condyle::radial::SortedPoints points(vertices);
  const std::vector<condyle::simd::InstructionSet> sets = condyle::simd::instruction_sets();
  std::mt19937 random(seed);
  Penetrations found;
  Count count;
  for (std::size_t i = 0; static_cast<double>(count.decisions) < decisions; ++i) {
    const Pose X_FM = near(scene.poses[i % scene.poses.size()].X_FM, random);
    const Truth truth(table, vertices, X_FM);
    const condyle::simd::InstructionSetInUse in_use(sets[i % sets.size()]);
    condyle::radial::PenetrationWork work;
    table.penetrations(points, X_FM, found, &work);
    count.wrong += truth.wrong(found);
    count.decisions += static_cast<std::int64_t>(vertices.size());
    count.inside += static_cast<std::int64_t>(truth.inside);
    count.uncertain += static_cast<std::int64_t>(work.uncertain);
  }
  return count;
}

int run(const Options& options) {
  const double per_scene = options.decisions / static_cast<double>(scene_names().size());
  Count all;
  fmt::print("{:<24} {:>12} {:>10} {:>10} {:>6}\n", "scene", "decisions", "inside", "uncertain", "wrong");
  for (const SceneName& name : scene_names()) {
    const auto scene = make_scene(name.name);
    if (!scene) {
      fmt::print("{:<24} its meshes are not there\n", name.name);
      continue;
    }
    const Count count = verify(*scene, per_scene, options.seed);
    fmt::print("{:<24} {:>12} {:>10} {:>10} {:>6}\n", name.name, count.decisions, count.inside,
               count.uncertain, count.wrong);
    std::fflush(stdout);
    all.decisions += count.decisions, all.inside += count.inside;
    all.uncertain += count.uncertain, all.wrong += count.wrong;
  }
  fmt::print("{:<24} {:>12} {:>10} {:>10} {:>6}\n", "all", all.decisions, all.inside, all.uncertain,
             all.wrong);
  return all.wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  CLI::App app(
      "Holds the fast radial queries, on each instruction set in turn, against the plain one, vertex by "
      "vertex");
  bench::Options options;
  app.add_option("--decisions", options.decisions, "Vertices to decide, over all scenes")
      ->capture_default_str();
  app.add_option("--seed", options.seed, "Of the random poses")->capture_default_str();
  app.footer("Example:\n  condyle-verify --decisions 1e6");
  CLI11_PARSE(app, argc, argv);
  try {
    return bench::run(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "condyle-verify: {}\n", error.what());
    return 2;
  }
}
