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

void add_body(const std::string& scene, const condyle::Body& body, Report& report) {
  const condyle::TriMesh& mesh = body.mesh;
  const TetMesh filled_body = filled(mesh);
  const auto count = [](std::size_t n) { return static_cast<std::int64_t>(n); };
  report.table(tetrahedra_head)
      .add({scene, body.name, count(mesh.vertices.size()), count(mesh.triangles.size()),
            count(filled_body.vertices.size() - mesh.vertices.size()), count(filled_body.tetrahedra.size())});
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
