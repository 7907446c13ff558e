#pragma once

#include <optional>
#include <random>

#include "motion/search/first_contact.hpp"

/// Scenes for turning meshes, and the obvious first contact: every pair of features, no tree, no box, no
/// early exit.

namespace condyle::test {

/// One body resting, one turning, in one common frame, about the axis.
struct TurnScene {
  TriMesh turning, resting;
  AxisFrame axis{Vec3::Zero(), Vec3::UnitZ()};
};

/// The library's answer.
TurnLimits limits(const TurnScene& scene, const TurnRange& range = {});

/// The same scene carried elsewhere by one rigid motion.
TurnScene moved(const Pose& X, const TurnScene& scene);
/// The two bodies' roles exchanged.
TurnScene exchanged(const TurnScene& scene);

/// The turning body after a turn, rounded once more.
TriMesh turned(const TurnScene& scene, double angle);

struct BruteLimit {
  double size;  ///< Of the turn.
  FeaturePair features;
};
/// First contact of scenes that are free at the start, by every pair of features.
std::optional<BruteLimit> brute_first_contact(const TurnScene& scene, motion::TurnDirection direction);

/// Whether the surfaces touch once the body has turned: exact, every pair of triangles, for the rounded mesh.
bool brute_touching(const TurnScene& scene, double angle);

/// A tetrahedron, an octahedron or a bumpy ball, at random.
TriMesh random_solid(std::mt19937& random, const Vec3& centre, double size);
/// Two random solids on one ring about the axis, mostly apart at the start.
TurnScene random_scene(std::mt19937& random);
/// A rigid motion far away: random turn, 10 m off.
Pose far_away(std::mt19937& random);

/// A solid with the outline (counter-clockwise, convex or star-shaped about the origin) between two heights.
TriMesh prism(const std::vector<Eigen::Vector2d>& outline, double low, double high);

/// Every triangle split into four in place.
TriMesh split_in_four(const TriMesh& mesh);

}  // namespace condyle::test
