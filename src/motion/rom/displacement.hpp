#pragma once

#include <optional>
#include <span>
#include <vector>

#include "condyle/limit_band.hpp"
#include "condyle/pose.hpp"
#include "kinematics/posed_parts.hpp"

/// Displacements of one sample of a band of limits or of measures.

namespace condyle::motion {

/// How far a joint is from the one given.
struct Displacement {
  Vec3 centre = Vec3::Zero();                    ///< mm
  Vec3 axes = Vec3::Zero();                      ///< rotation vector, rad
  double fixed_surface = 0, mobile_surface = 0;  ///< along normals, in standard deviations
  std::vector<double> parameters =
      {};  ///< of each uncertain parameter of a part, in standard deviations; empty: none moves
};

/// Throws UsageError for fewer than 20 samples or more than 100,000, and a standard deviation that is negative or not finite.
void check_band(const BandOptions& options);

/// A Latin hypercube: of every coordinate one value in each of as many strata of equal probability as there are samples. Those
/// of the parameters are drawn last: the others do not depend on how many there are.
std::vector<Displacement> displacements(const BandOptions& options, std::size_t parameters);

/// Where the frame of a displaced joint lies in that of the joint given.
Pose displaced_frame(const Displacement& by);

/// A body's surface, movable along its normals: the mean of the triangles around each vertex weighted by area, without faces in which parts
/// were cut; zero if no triangle uses it. A surface that is off by a share of a voxel has the width of the share in the normal's direction
/// instead of a length: slices are thicker than their pixels.
class MovableSurface {
 public:
  MovableSurface(const Body& body, const Uncertainty& sigma);
  /// A body of a joint. Meshes of an implant beside bone stay where they are: their sizes are given, not measured.
  MovableSurface(const Joint& joint, BodyRole role, const Uncertainty& sigma);

  /// Its vertices, moved by so many standard deviations; empty if it stays where it is.
  std::optional<Points> moved_by(double standard_deviations) const;
  /// The same, its parts displaced too.
  std::optional<Points> moved_by(double standard_deviations, const kinematics::DisplacedParts& parts,
                                 std::span<const double> parameters) const;
  /// The same as so many times its direction for each vertex, for those who move few; empty if its parts move too.
  std::optional<double> along_directions(double standard_deviations, const kinematics::DisplacedParts& parts,
                                         std::span<const double> parameters) const;
  const Points& directions() const noexcept { return directions_; }
  double longest_direction() const noexcept { return longest_; }

 private:
  Points vertices_, directions_;
  double sigma_;        ///< of the length along the directions
  double longest_ = 0;  ///< direction
};

/// Quantile of sorted values, linear between neighbours (type 7 of Hyndman and Fan 1996).
double quantile(const std::vector<double>& sorted, double q);

}  // namespace condyle::motion
