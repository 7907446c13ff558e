#include "table_floor.hpp"

#include "core/uninitialised.hpp"

namespace bench {

double write_table_floor(const condyle::TriMesh& mesh, std::size_t bytes) {
  const std::size_t words = bytes / sizeof(double), each = words / mesh.triangles.size();
  condyle::core::UninitialisedVector<double> written(words);
  double* next = written.data();
  for (const auto& corners : mesh.triangles) {
    condyle::Vec3 sum = condyle::Vec3::Zero();
    for (const condyle::Index corner : corners) sum += mesh.vertices[corner];
    for (std::size_t i = 0; i < each; ++i) next[i] = sum[static_cast<Eigen::Index>(i % 3)];
    next += each;
  }
  return written[0] + written[(mesh.triangles.size() * each) / 2];
}

}  // namespace bench
