#pragma once

#include "motion/search/first_contact.hpp"
#include "support/test.hpp"

/// Scenes for rotating meshes, and the obvious first contact: every pair of features, no tree, no box, no
/// early exit.

namespace condyle::test {

/// One body stationary, one rotating, in one common frame, about the axis.
struct RotationScene {
  TriMesh rotating, stationary;
  AxisFrame axis{Vec3::Zero(), Vec3::UnitZ()};
};

/// The library's answer.
motion::RotationLimits limits(const RotationScene& scene, const motion::RotationRange& range = {});

/// The same scene carried elsewhere by one rigid motion.
RotationScene moved(const Pose& X, const RotationScene& scene);
/// The two bodies' roles exchanged.
RotationScene exchanged(const RotationScene& scene);

/// The rotating body after a rotation by the angle (rad), rounded once more.
TriMesh turned(const RotationScene& scene, double angle);

struct BruteLimit {
  double size;  ///< of the rotation, rad
  motion::FeaturePair features;
};
/// First contact of scenes that are free at the start, by every pair of features.
std::optional<BruteLimit> brute_first_contact(const RotationScene& scene, RotationSense sense);

/// Features of the rotating body that meet the other one within the range, rad, and where each does first, by every pair of features.
std::map<motion::Feature, double> brute_feature_contacts(const RotationScene& scene, RotationSense sense,
                                                         double range);

/// Whether the surfaces meet once the body has turned: exact, every pair of triangles, for the rounded mesh.
bool brute_contact_at(const RotationScene& scene, double angle);

/// A tetrahedron, an octahedron or a bumpy ball, at random.
TriMesh random_solid(std::mt19937& random, const Vec3& centre, double size);
/// Two random solids on one ring about the axis, mostly apart at the start.
RotationScene random_scene(std::mt19937& random);
/// A rigid motion far away: random rotation, 10 m off.
Pose far_away(std::mt19937& random);

/// A solid with the outline (counter-clockwise, convex or star-shaped about the origin) between two heights.
TriMesh prism(const std::vector<Eigen::Vector2d>& outline, double low, double high);

/// Every triangle split into four in place.
TriMesh split_in_four(const TriMesh& mesh);

}  // namespace condyle::test
