#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/joint.hpp"

/// Parts of a body that move against the rest of it: docs/parts.md.

namespace condyle::kinematics {

/// p' = c + t + R S (p - c), in the frame of the part's body: R is R_x R_z R_y, or that of the angles of a cup.
Eigen::Affine3d motion_of(const PosedPart& part, Side side);

/// Whether a part moves this mesh of a body; the name of a body that is one mesh is empty.
bool moves_mesh(const PosedPart& part, BodyRole role, std::string_view mesh) noexcept;

/// How parts move one mesh of a body from where it is given.
Eigen::Affine3d motion_of_mesh(std::span<const PosedPart> parts, Side side, BodyRole role,
                               std::string_view mesh);

/// Which vertices of a body move together, and how: all that lie in the same parts.
class PartMotions {
 public:
  /// Names of parts that the body does not have are a caller's mistake: check_parts() refuses them.
  PartMotions(const Body& body, BodyRole role, std::span<const PosedPart> parts);

  /// One for each group of vertices.
  std::vector<Eigen::Affine3d> motions(std::span<const PosedPart> parts, Side side) const;
  /// Moves each vertex by its group's. Computed in pairs of doubles and rounded once; groups that do not move keep their bits.
  void move(std::span<const Eigen::Affine3d> motions, Points& points) const;

  /// The group of the whole body, if it is one.
  bool is_whole() const noexcept { return groups_.size() == 1; }
  /// The group that most vertices near a sphere are of: which one carries a head or socket.
  std::size_t group_on(const Points& points, const Sphere& sphere) const;
  /// Whether vertices are all of one group.
  bool in_one_group(std::span<const Index> vertices) const;

 private:
  struct Group {
    std::vector<std::size_t> parts;                             ///< by which it is moved, in this order
    std::vector<std::pair<std::size_t, std::size_t>> vertices;  ///< first, count
  };
  std::size_t group_of(std::size_t vertex) const;

  std::vector<Group> groups_;
};

/// How many parameters have a standard deviation.
std::size_t uncertain_parameters(const Joint& joint);

/// A body whose parts are displaced from where they are.
class DisplacedParts {
 public:
  DisplacedParts(const Joint& joint, BodyRole role);

  /// For each group of vertices its motion from where it is, each uncertain parameter displaced by so many of its standard
  /// deviations. Empty if none is given.
  std::vector<Eigen::Affine3d> motions(std::span<const double> standard_deviations) const;
  const PartMotions& groups() const noexcept { return groups_; }

 private:
  std::vector<PosedPart> parts_;
  Side side_;
  PartMotions groups_;
  std::vector<Eigen::Affine3d> back_;
};

/// Throws UsageError for parts that contradict themselves or the bodies: "part cup: ...".
void check_parts(std::span<const PosedPart> parts, const Body& fixed, const Body& mobile);

/// Takes the bodies of a joint, with the spheres that are known of them, as those that the values of its parts have moved: such as bodies
/// that were cut where they are. A mesh that is where its parts have it keeps every bit of what was given.
void take_as_moved(Joint& joint);

/// Moves the bodies of a joint to where the values of its parts have them.
void pose_parts(Joint& joint);

}  // namespace condyle::kinematics
