// How far a needle turns about a hinge before it meets a wall.
#include <array>
#include <condyle/range_of_motion.hpp>
#include <cstdio>

/// The first three corners counter-clockwise seen from outside.
condyle::TriMesh tetrahedron(const std::array<condyle::Vec3, 4>& corners) {
  condyle::TriMesh mesh;
  for (const condyle::Vec3& corner : corners) mesh.vertices.push_back(corner);
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}, {1, 0, 3}};
  return mesh;
}

int main() {
  const condyle::TriMesh wall = tetrahedron({{{5, -30, -10}, {5, 0, 30}, {5, 30, -10}, {15, 0, 0}}});
  const condyle::TriMesh needle = tetrahedron({{{1, -1, -1}, {-1, -1, 0}, {1, -1, 1}, {0, -10, 0}}});
  const condyle::Joint joint{
      "door", condyle::JointKind::hinge, condyle::Side::right, {"wall", wall}, {"needle", needle}};
  const condyle::motion::MotionLimit flexion = condyle::motion::RangeOfMotion(joint).limit(
      condyle::motion::built_in_motions(joint.kind, joint.anatomy).front());
  std::printf("flexion ends at %.3f degrees\n", flexion.end.turned.degrees());
}
