// The sample femur, written and read again.
#include <condyle/io/mesh_file.hpp>
#include <condyle/sample/hip.hpp>
#include <cstdio>

int main() {
  const condyle::SampleHip hip = condyle::sample_hip({}, condyle::Scenario::one);
  condyle::write_mesh("femur.ply", hip.femur);
  std::printf("%zu vertices\n", condyle::read_mesh("femur.ply").mesh.vertices.size());
}
