#include "condyle/joint.hpp"

#include <utility>

#include "kinematics/ligament_path.hpp"

namespace condyle {

Joint held_at(const Joint& joint, const Vec3& translation_mm) {
  Joint held = joint;
  if (translation_mm == Vec3::Zero()) return held;
  const auto moved = [&](const Mesh& mesh) {
    return mesh.moved_to(shifted(mesh.vertices(), -translation_mm));
  };
  const auto move_cuts = [&](std::optional<BodyImage>& image) {
    if (image)
      for (ImageCut& cut : image->cuts) cut.offset_mm -= cut.normal.dot(translation_mm);
  };
  const auto move_socket = [&](std::optional<Sphere>& socket) {
    if (socket) socket->centre -= translation_mm;
  };
  held.fixed.mesh = moved(joint.fixed.mesh);
  for (Ligament& ligament : held.ligaments) kinematics::shift(ligament, -translation_mm, Vec3::Zero());
  move_cuts(held.fixed.image);
  move_socket(held.fixed.head);
  if (held.posed) {
    held.posed->fixed.mesh = moved(held.posed->fixed.mesh);
    move_cuts(held.posed->fixed.image);
    move_socket(held.posed->fixed.head);
    for (PosedPart& part : held.posed->parts)
      if (part.body == BodyRole::fixed) {
        part.centre -= translation_mm;
        for (CutPlane& plane : part.cut) plane.point -= translation_mm;
      }
  }
  return held;
}

}  // namespace condyle
