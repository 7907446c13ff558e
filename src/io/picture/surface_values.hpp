#pragma once

#include <optional>
#include <vector>

#include "condyle/contact.hpp"
#include "condyle/io/picture.hpp"

namespace condyle::io {

/// Values that colour one body's vertices.
struct SurfaceValues {
  std::vector<double> mm;       ///< not finite where there is none
  std::vector<double> outside;  ///< of depths only: the nearest distance, negative inside the other body
  std::vector<double>
      is_bound;  ///< of depths only: 1 where `mm` is the nearest distance, for want of a depth
};

struct BothValues {
  SurfaceValues fixed, mobile;
};

/// Values of every vertex at this pose, depths along arcs if `about` is given. Throws MeshError if a depth or a gap is requested of an open mesh; nearest
/// distances of vertices that cannot be inside are above 0.
BothValues surface_values(PictureColour colour, const Joint& joint, const JointAngles& at, const Pose& X_FM,
                          const std::optional<contact::ArcsAbout>& about = {});

}  // namespace condyle::io
