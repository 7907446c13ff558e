#include "io/joint/depth_surfaces.hpp"

#include <utility>

namespace condyle::io {

Joint joint_of_surfaces(const ContactEntry& entry, Joint joint) {
  ContactSurfaces surfaces = surfaces_of(entry, joint);
  if (!entry.fixed_part.empty()) joint.fixed = std::move(surfaces.fixed);
  if (!entry.mobile_part.empty()) joint.mobile = std::move(surfaces.mobile);
  return joint;
}

DepthRequest cast_as(const ContactEntry& entry, DepthRequest request) {
  request.casting = entry.casting;
  request.rays = entry.rays;
  return request;
}

}  // namespace condyle::io
