#include "io/picture/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace condyle::io {
namespace {

/// Margin around the bodies, as a fraction of the smaller side of the picture.
constexpr double margin = 0.04;
/// Around the joint centre of a ball joint, in radii of its head to each side.
constexpr double radii_about_centre = 2.5;
/// What is shown of contact's surroundings: times its own size, and at least, where it is small, of what is shown without contact.
constexpr double times_contact = 3, least_of_joint = 0.5, least_of_bodies = 1. / 6;

/// A rectangle in the plane of the picture, mm from the joint centre to the right and up.
struct Rectangle {
  double left = std::numeric_limits<double>::infinity(), right = -left, bottom = left, top = -left;

  void add(double x, double y) noexcept {
    left = std::min(left, x), right = std::max(right, x);
    bottom = std::min(bottom, y), top = std::max(top, y);
  }
  bool is_empty() const noexcept { return !(left <= right); }
  double width() const noexcept { return std::max(right - left, smallest_field_mm); }
  double height() const noexcept { return std::max(top - bottom, smallest_field_mm); }
};

bool is_inside(const SurfaceValues& values, std::size_t v) noexcept {
  const std::vector<double>& signed_mm = values.outside.empty() ? values.mm : values.outside;
  return v < signed_mm.size() && signed_mm[v] < 0;
}

/// The radius of a head about the joint centre: the distance within which a twentieth of the vertices lie. A head has more of them; a speck
/// inside it has fewer.
double radius_about_centre(const TriMesh& mobile) {
  std::vector<double> distances(mobile.vertices.size());
  for (std::size_t v = 0; v < distances.size(); ++v) distances[v] = mobile.vertices[v].norm();
  const auto nearest = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 20);
  std::nth_element(distances.begin(), nearest, distances.end());
  return std::max(*nearest, smallest_field_mm);
}

}  // namespace

FlatMesh Camera::laid(const TriMesh& mesh) const {
  FlatMesh flat{.vertices = Points(mesh.vertices.size()), .triangles = mesh.triangles};
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3 p = mesh.vertices[v];
    flat.vertices.set(v, {origin_x + samples_per_mm * p.dot(right), origin_y - samples_per_mm * p.dot(up),
                          samples_per_mm * p.dot(towards_viewer)});
  }
  return flat;
}

Camera camera_of(const PictureOptions& options, const Scene& scene, double columns, double rows) {
  const auto& [towards_viewer, up] = options.view;
  Camera camera{.right = up.cross(towards_viewer),
                .up = up,
                .towards_viewer = towards_viewer,
                .samples_per_mm = rows / options.field_mm.value_or(1),
                .origin_x = columns / 2,
                .origin_y = rows / 2};
  if (options.field_mm && std::isfinite(*options.field_mm)) return camera;

  Rectangle bodies, contact;
  const auto add = [&](const TriMesh& mesh, const SurfaceValues& values) {
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const Vec3 p = mesh.vertices[v];
      const double x = p.dot(camera.right), y = p.dot(camera.up);
      bodies.add(x, y);
      if (is_inside(values, v)) contact.add(x, y);
    }
  };
  add(scene.fixed, scene.values.fixed), add(scene.mobile, scene.values.mobile);
  const auto show = [&](const Rectangle& all, double samples_per_mm) {
    camera.samples_per_mm = samples_per_mm;
    camera.origin_x = columns / 2 - samples_per_mm * (all.left + all.right) / 2;
    camera.origin_y = rows / 2 + samples_per_mm * (all.bottom + all.top) / 2;
  };
  const double free = margin * std::min(columns, rows);
  const double of_bodies =
      std::min((columns - 2 * free) / bodies.width(), (rows - 2 * free) / bodies.height());
  show(bodies, of_bodies);
  const bool is_ball = scene.kind == JointKind::ball;
  if (options.field_mm || (contact.is_empty() && !is_ball)) return camera;

  // Nothing is shown smaller than if both bodies fit.
  const double of_joint =
      is_ball ? rows / (2 * radii_about_centre * radius_about_centre(scene.mobile)) : of_bodies;
  if (contact.is_empty()) {
    if (of_joint > of_bodies) show({0, 0, 0, 0}, of_joint);
    return camera;
  }
  const double of_contact = std::min(columns / contact.width(), rows / contact.height()) / times_contact;
  const double closest = of_joint / (is_ball ? least_of_joint : least_of_bodies);
  if (const double chosen = std::min(of_contact, closest); chosen > of_bodies) show(contact, chosen);
  return camera;
}

}  // namespace condyle::io
