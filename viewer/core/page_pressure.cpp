#include "page_pressure.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "condyle/error.hpp"
#include "page_joint.hpp"

using namespace condyle;

namespace {

const contact::ElasticContactResults& results_at(PagePressure& pressure, const Pose& X_FM) {
  if (!pressure.contact) throw UsageError("pressure: no layers were given");
  if (!pressure.results || pressure.results_at.matrix() != X_FM.matrix()) {
    pressure.results = pressure.contact->at(X_FM);
    pressure.results_at = X_FM;
  }
  return *pressure.results;
}

double area_mm2(const Mesh& mesh, std::size_t triangle) {
  const Vec3 a = mesh.corner(triangle, 0);
  return (mesh.corner(triangle, 1) - a).cross(mesh.corner(triangle, 2) - a).norm() / 2;
}

/// Loads and areas of the triangles at each vertex.
struct VertexLoads {
  std::vector<double> load_n, around_mm2;
  std::vector<bool> is_loaded;

  VertexLoads(const Mesh& mesh, const contact::SurfaceContact& contact)
      : load_n(mesh.vertices().size(), 0), around_mm2(load_n), is_loaded(load_n.size(), false) {
    for (std::size_t t = 0; t < mesh.triangles().size(); ++t)
      for (const Index v : mesh.triangles()[t]) around_mm2[v] += area_mm2(mesh, t);
    for (const contact::FaceContact& face : contact.faces)
      for (const Index v : mesh.triangles()[face.face]) load_n[v] += face.load_n, is_loaded[v] = true;
  }
};

}  // namespace

int condyle_surface(CondyleJoint* joint, int of_fixed, int first_vertex, int vertex_count, int first_triangle,
                    int triangle_count, double youngs_modulus_mpa, double poisson_ratio,
                    const double* thickness_mm) {
  return guarded(-1, [&] {
    const Mesh& body = body_of(*joint, of_fixed).mesh;
    PageSurface& surface = of_fixed ? joint->pressure.fixed : joint->pressure.mobile;
    surface.first_vertex = static_cast<std::size_t>(first_vertex);
    const BodyPart run{"surface", surface.first_vertex, static_cast<std::size_t>(vertex_count),
                       static_cast<std::size_t>(first_triangle), static_cast<std::size_t>(triangle_count)};
    surface.mesh = mesh_of_part({"body", body, {run}}, run.name);
    surface.layer.reset();
    if (youngs_modulus_mpa != 0)
      surface.layer = contact::ElasticLayer{youngs_modulus_mpa, poisson_ratio,
                                            std::vector<double>(thickness_mm, thickness_mm + vertex_count)};
    joint->pressure.contact.reset();
    return 0;
  });
}

int condyle_elastic(CondyleJoint* joint, int casting, int law, int rule, double reach_mm) {
  return guarded(-1, [&] {
    constexpr std::array castings{contact::Casting::fixed, contact::Casting::mobile, contact::Casting::both};
    constexpr std::array laws{contact::PressureLaw::linear, contact::PressureLaw::logarithmic};
    constexpr std::array rules{contact::FaceRule::face_centre, contact::FaceRule::cut_faces};
    PagePressure& pressure = joint->pressure;
    if (!pressure.fixed.mesh || !pressure.mobile.mesh)
      throw UsageError("pressure: both surfaces come before what they do");
    pressure.results.reset();
    pressure.contact.emplace(
        *pressure.fixed.mesh, *pressure.mobile.mesh,
        contact::ElasticContactOptions{.casting = castings.at(static_cast<std::size_t>(casting)),
                                       .rays = {rules.at(static_cast<std::size_t>(rule)), reach_mm},
                                       .law = laws.at(static_cast<std::size_t>(law)),
                                       .fixed = pressure.fixed.layer,
                                       .mobile = pressure.mobile.layer});
    return 0;
  });
}

int condyle_pressure(CondyleJoint* joint, const double* pose, int of_fixed, float* values,
                     std::uint8_t* marks) {
  return guarded(-1, [&] {
    const contact::ElasticContactResults& results = results_at(joint->pressure, pose_of(pose));
    const std::size_t count = body_of(*joint, of_fixed).mesh.vertices().size();
    std::fill_n(values, count, 0.0f);
    std::fill_n(marks, count, std::uint8_t{0});
    const auto& cast = of_fixed ? results.fixed : results.mobile;
    if (!cast) return 0;
    const PageSurface& surface = of_fixed ? joint->pressure.fixed : joint->pressure.mobile;
    const VertexLoads loads(*surface.mesh, *cast);
    for (std::size_t v = 0; v < loads.load_n.size(); ++v) {
      if (!loads.is_loaded[v]) continue;
      values[surface.first_vertex + v] = static_cast<float>(loads.load_n[v] / loads.around_mm2[v]);
      marks[surface.first_vertex + v] = 1;
    }
    return 0;
  });
}
