// The sample femur, written and read again.
#include <condyle/io/mesh_file.hpp>
#include <condyle/sample/hip.hpp>
#include <cstdio>

int main() {
  const condyle::sample::SampleHip hip = condyle::sample::sample_hip({}, condyle::sample::Scenario::one);
  condyle::io::write_mesh("femur.ply", hip.femur);
  std::printf("%zu vertices\n", condyle::io::read_mesh("femur.ply").mesh.vertices.size());
}
