#pragma once

#include <atomic>
#include <optional>

#include "condyle/radial.hpp"
#include "core/lazy.hpp"

namespace condyle::contact {

/// Which points of one body lie in another, if that decides which rays from them can be in contact: a ray that begins
/// outside a solid meets its front first, and that is no contact.
class PointsInside {
 public:
  /// Points in the frame of their own body; the surface is no nearer than `nearest_mm` to the origin of its.
  PointsInside(Mesh surface, double nearest_mm, Points points);

  /// The points have moved; `are_same` if they are as many, and each the one that it was.
  void update_points(Points points, bool are_same);
  /// The surface has deformed. Preparing costs more than some questions gain: until a few were asked of the surface as it is now,
  /// they are not decided.
  void update_surface(Mesh surface, double nearest_mm);

  /// The points that are inside or on the surface, neighbours behind each other; all others are outside. False if
  /// this is not decided: for open surfaces, for those that run through themselves or have an inverted component, and
  /// if the pose moves the origin so far that a radial table would be slower than rays are. The first call makes the
  /// table.
  bool find(const Pose& X_of_points, radial::Penetrations& out) const;

 private:
  struct Prepared {
    radial::RadialTable table;
    radial::SortedPoints points;
  };

  Mesh surface_;
  double nearest_;
  Points points_;
  core::Lazy<std::optional<Prepared>> prepared_;
  mutable std::atomic<int> undecided_;  ///< questions that are to be left so
};

}  // namespace condyle::contact
