#pragma once

#include <stop_token>
#include <utility>

#include "sample/field.hpp"

namespace condyle::sample {

/// Ends the meshing of a solid that was stopped.
struct Stopped {};

/// The same solid, whose field throws Stopped once a stop is requested. Contouring and remeshing, which take nearly all of the
/// time, evaluate it at every step. A token that cannot be stopped costs nothing.
inline Solid stoppable(Solid solid, const std::stop_token& stop) {
  if (!stop.stop_possible()) return solid;
  solid.field = [field = std::move(solid.field), stop](const Vec3& p) {
    if (stop.stop_requested()) throw Stopped();
    return field(p);
  };
  return solid;
}

}  // namespace condyle::sample
