#include <cmath>

#include "questions.hpp"
#ifdef CONDYLE_BENCH_SPATIAL_HASHING
#include "condyle/mesh.hpp"
#include "methods/tetrahedra.hpp"
#endif

namespace bench {

#ifdef CONDYLE_BENCH_SPATIAL_HASHING
namespace {

const TableHead tetrahedra_head{"tetrahedra",
                                "Tetrahedra that fill the bodies of a scenario",
                                {{"scene", "scene"},
                                 {"body", "body"},
                                 {"vertices", "vertices"},
                                 {"triangles", "triangles"},
                                 {"inner_vertices", "inner vertices"},
                                 {"tetrahedra", "tetrahedra"}}};

/// Largest difference of the tetrahedra's volume from the mesh's, relative: where surface triangles are not Delaunay.
constexpr double most_volume_off = 1e-4;

/// Six times, signed.
double tetrahedron_volume(const condyle::Vec3& a, const condyle::Vec3& b, const condyle::Vec3& c,
                          const condyle::Vec3& d) {
  return (b - a).cross(c - a).dot(d - a);
}

void add_body(const std::string& scene, const condyle::Body& body, Report& report) {
  const condyle::TriMesh& mesh = body.mesh;
  const TetMesh filled_body = filled(mesh);
  double meshed = 0, filled_volume = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    meshed += tetrahedron_volume({0, 0, 0}, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
  const condyle::Points& v = filled_body.vertices;
  for (const auto& t : filled_body.tetrahedra)
    filled_volume += std::abs(tetrahedron_volume(v[t[0]], v[t[1]], v[t[2]], v[t[3]]));
  const auto count = [](std::size_t n) { return static_cast<std::int64_t>(n); };
  report.table(tetrahedra_head)
      .add({scene, body.name, count(mesh.vertices.size()), count(mesh.triangles.size()),
            count(v.size() - mesh.vertices.size()), count(filled_body.tetrahedra.size())});
  if (!(std::abs(filled_volume / meshed - 1) < most_volume_off))
    report.disagreements.push_back(scene + ": tetrahedra do not fill the " + body.name);
}

}  // namespace

void ask_tetrahedra(const Scene& scene, Effort, Report& report) {
  for (const condyle::Body* body : {&scene.joint.fixed, &scene.joint.mobile})
    add_body(scene.joint.name, *body, report);
}
#else
void ask_tetrahedra(const Scene&, Effort, Report&) {}
#endif

}  // namespace bench
