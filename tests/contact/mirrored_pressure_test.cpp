#include <cstddef>

#include "condyle/pressure.hpp"
#include "support/cup.hpp"
#include "support/test.hpp"

namespace condyle::contact {
namespace {

/// A surface and its mirror image, with the corners of its triangles in the opposite sense.
Mesh mirror_image(const TriMesh& mesh) {
  TriMesh out = mesh;
  for (std::size_t v = 0; v < out.vertices.size(); ++v) {
    const Vec3 p = mesh.vertices[v];
    out.vertices.set(v, Vec3(p.x(), p.y(), -p.z()));
  }
  for (Triangle& t : out.triangles) std::swap(t[1], t[2]);
  return Mesh(out);
}

/// With a thickness that varies, a law that is not linear, and a rim that cuts faces.
TEST(MirrorImage, HasTheSamePressure) {
  TriMesh ball = posed(test::generic_turn(), test::sphere(Vec3::Zero(), 20, 4));
  const TriMesh dish = test::cup(21, 4);
  ElasticLayer layer = test::layer_of_stiffness(5);
  std::vector<double> thickness;
  for (std::size_t v = 0; v < dish.vertices.size(); ++v)
    thickness.push_back(2 + 0.5 * std::sin(0.4 * dish.vertices[v].x() + 0.2 * dish.vertices[v].z()));
  layer.thickness_mm = thickness;
  for (const PressureLaw law : {PressureLaw::linear, PressureLaw::logarithmic})
    for (const Casting casting : {Casting::fixed, Casting::both}) {
      const ElasticContactOptions options{.casting = casting, .law = law, .fixed = layer};
      const ElasticContact one(Mesh(dish), Mesh(ball), options),
          other(mirror_image(dish), mirror_image(ball), options);
      const ElasticContactResults here = one.at(test::translated({0.3, -1.4, 0.5})),
                                  there = other.at(test::translated({0.3, -1.4, -0.5}));
      const Vec3 f = here.on_mobile.force_n, g = there.on_mobile.force_n;
      ASSERT_GT(f.norm(), 1);
      EXPECT_LT((f - Vec3(g.x(), g.y(), -g.z())).norm(), 1e-12 * f.norm());
      EXPECT_NEAR(here.fixed->totals.max_pressure_mpa, there.fixed->totals.max_pressure_mpa,
                  1e-12 * here.fixed->totals.max_pressure_mpa);
    }
}

/// Faces of the ball leave a block over its edge: up to there the depth is taken to run on.
TEST(MirrorImage, HasTheSamePressureWhereTheTargetEnds) {
  const TriMesh ball = posed(test::generic_turn(), test::sphere(Vec3::Zero(), 20, 4)),
                block = posed(test::generic_turn(), test::box({-30, -50, -40}, {4, -19, 40}));
  const ElasticContactOptions options{.casting = Casting::mobile, .fixed = test::layer_of_stiffness(5)};
  const ElasticContact one(Mesh(block), Mesh(ball), options),
      other(mirror_image(block), mirror_image(ball), options);
  const ElasticContactResults here = one.at(test::translated({0.3, -0.4, 0.5})),
                              there = other.at(test::translated({0.3, -0.4, -0.5}));
  const Vec3 f = here.on_mobile.force_n, g = there.on_mobile.force_n;
  ASSERT_GT(here.mobile->rim_faces, 0u);
  EXPECT_LT((f - Vec3(g.x(), g.y(), -g.z())).norm(), 1e-12 * f.norm());
}

}  // namespace
}  // namespace condyle::contact
