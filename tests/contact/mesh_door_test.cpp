#include "condyle/contact.hpp"
#include "condyle/joint.hpp"
#include "contact/body_pair.hpp"
#include "mesh/winding_number.hpp"
#include "support/test.hpp"

namespace condyle::contact {
namespace {

TriMesh sphere() {
  return test::sphere({5, 0, 0}, 1, 2);
}

/// Meshes made by hand: a vertex number out of range, a coordinate that is no number, arrays of different
/// lengths.
std::vector<TriMesh> broken_meshes() {
  std::vector<TriMesh> meshes(3, sphere());
  meshes[0].triangles[17][2] = 1u << 30;
  meshes[1].vertices.y[9] = std::numeric_limits<double>::quiet_NaN();
  meshes[2].vertices.z.resize(3);
  return meshes;
}

TEST(MeshDoor, NoTableIsMadeOfAMeshThatDoesNotPass) {
  for (const TriMesh& broken : broken_meshes()) {
    EXPECT_THROW(JointContact(broken, sphere()), MeshError);
    EXPECT_THROW(JointContact(sphere(), broken), MeshError);
    EXPECT_THROW(BodyPair(broken, sphere()), MeshError);
    EXPECT_THROW(BodyPair(sphere(), broken), MeshError);
    EXPECT_THROW(mesh::WindingNumber{broken}, MeshError);
  }
}

TEST(MeshDoor, NoJointHasAMeshThatDoesNotPass) {
  for (const TriMesh& broken : broken_meshes()) {
    EXPECT_THROW(static_cast<void>(
                     Joint{"joint", JointKind::ball, Side::right, {"fixed", broken}, {"mobile", sphere()}}),
                 MeshError);
    EXPECT_THROW(static_cast<void>(
                     Joint{"joint", JointKind::ball, Side::right, {"fixed", sphere()}, {"mobile", broken}}),
                 MeshError);
  }
}

}  // namespace
}  // namespace condyle::contact
