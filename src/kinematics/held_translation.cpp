#include "condyle/joint.hpp"

#include <utility>

namespace condyle {

Joint held_at(const Joint& joint, const Vec3& translation_mm) {
  Joint held = joint;
  if (translation_mm == Vec3::Zero()) return held;
  const auto moved = [&](const Mesh& mesh) {
    Points points = mesh.vertices();
    for (std::size_t v = 0; v < points.size(); ++v) points.set(v, points[v] - translation_mm);
    return mesh.moved_to(std::move(points));
  };
  const auto move_cuts = [&](std::optional<BodyImage>& image) {
    if (image)
      for (ImageCut& cut : image->cuts) cut.offset_mm -= cut.normal.dot(translation_mm);
  };
  const auto move_socket = [&](std::optional<Sphere>& socket) {
    if (socket) socket->centre -= translation_mm;
  };
  held.fixed.mesh = moved(joint.fixed.mesh);
  for (Ligament& ligament : held.ligaments) {
    for (Vec3& point : ligament.fixed) point -= translation_mm;
    if (ligament.wrap && ligament.wrap->body == BodyRole::fixed) ligament.wrap->centre -= translation_mm;
  }
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
