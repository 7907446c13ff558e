#include "condyle/sample/hip.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "sample/contour.hpp"
#include "support/test.hpp"

/// Sockets on surfaces of label maps, whose normals are rough and whose rims are round, and on hips with little of a socket.

namespace condyle::sample {
namespace {

/// Samples on a lattice of a cube about the origin: 1 inside a closed mesh and 0 outside.
class LabelMap {
 public:
  LabelMap(const TriMesh& mesh, double spacing, double half)
      : spacing_(spacing), low_(-half), size_(static_cast<std::size_t>(2 * half / spacing)) {
    values_.assign(size_ * size_ * size_, 0);
    // A column along z enters and leaves the solid at the triangles above its foot. Columns pass no vertex: those have
    // single precision.
    constexpr double aside = 1.234e-7;
    struct Crossing {
      double z;
      int enters;
      auto operator<=>(const Crossing&) const = default;
    };
    std::vector<std::vector<Crossing>> columns(size_ * size_);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
      const double det = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
      if (det == 0) continue;
      const Vec3 least = a.cwiseMin(b).cwiseMin(c), most = a.cwiseMax(b).cwiseMax(c);
      for (std::size_t j = first(least.y()); j < size_ && at(j) < most.y(); ++j)
        for (std::size_t i = first(least.x()); i < size_ && at(i) < most.x(); ++i) {
          const double x = at(i) + aside - a.x(), y = at(j) + aside - a.y();
          const double u = (x * (c.y() - a.y()) - (c.x() - a.x()) * y) / det;
          const double w = ((b.x() - a.x()) * y - x * (b.y() - a.y())) / det;
          if (u < 0 || w < 0 || u + w > 1) continue;
          columns[j * size_ + i].push_back(
              {a.z() + u * (b.z() - a.z()) + w * (c.z() - a.z()), det > 0 ? -1 : 1});
        }
    }
    for (std::size_t foot = 0; foot < columns.size(); ++foot) {
      std::sort(columns[foot].begin(), columns[foot].end());
      auto next = columns[foot].begin();
      int winding = 0;
      for (std::size_t k = 0; k < size_; ++k) {
        while (next != columns[foot].end() && next->z < at(k)) winding += next++->enters;
        values_[k * size_ * size_ + foot] = winding > 0 ? 1 : 0;
      }
    }
  }

  /// Gaussian, of this standard deviation in lattice steps; what lies beyond the cube counts as outside.
  void blur(double deviation) {
    const int reach = static_cast<int>(std::ceil(3 * deviation));
    std::vector<double> weights;
    double sum = 0;
    for (int d = -reach; d <= reach; ++d)
      sum += weights.emplace_back(std::exp(-d * d / (2 * deviation * deviation)));
    for (const std::size_t step : {std::size_t{1}, size_, size_ * size_}) {
      std::vector<double> blurred(values_.size());
      for (std::size_t n = 0; n < values_.size(); ++n) {
        const int along = static_cast<int>(n / step % size_);
        for (int d = std::max(-reach, -along); d <= std::min(reach, static_cast<int>(size_) - 1 - along); ++d)
          blurred[n] += weights[static_cast<std::size_t>(d + reach)] / sum *
                        values_[n + static_cast<std::size_t>(d) * step];
      }
      values_ = std::move(blurred);
    }
  }

  /// Where half of the neighbourhood is inside.
  TriMesh surface() const {
    const auto field = [this](const Vec3& p) { return FieldValue{0.5 - value(p), Vec3::Zero()}; };
    const double high = at(size_ - 1) + spacing_;
    return sample::contoured({field, {Vec3::Constant(low_ - spacing_), Vec3::Constant(high)}, {}}, spacing_);
  }

 private:
  double at(std::size_t i) const { return low_ + static_cast<double>(i) * spacing_; }
  std::size_t first(double x) const {
    return static_cast<std::size_t>(std::max(std::floor((x - low_) / spacing_), 0.0));
  }
  /// Linear between lattice points.
  double value(const Vec3& p) const {
    const Vec3 q = (p - Vec3::Constant(low_)) / spacing_;
    const Vec3 corner(std::floor(q.x()), std::floor(q.y()), std::floor(q.z()));
    if (corner.minCoeff() < 0 || corner.maxCoeff() + 1 >= static_cast<double>(size_)) return 0;
    const Vec3 part = q - corner;
    double sum = 0;
    for (const int bits : {0, 1, 2, 3, 4, 5, 6, 7}) {
      double weight = 1;
      std::size_t n = 0;
      for (int axis = 2; axis >= 0; --axis) {
        const bool upper = bits >> axis & 1;
        weight *= upper ? part[axis] : 1 - part[axis];
        n = n * size_ + static_cast<std::size_t>(corner[axis]) + upper;
      }
      sum += weight * values_[n];
    }
    return sum;
  }

  double spacing_, low_;
  std::size_t size_;
  std::vector<double> values_;
};

/// Values for two hips, with spheres fitted to the published meshes by other means.
TEST(FineSocket, OfALabelMapIsThatOfTheMesh) {
  FOUND_OR_SKIP(data, test::shared_data());
  struct Published {
    const char* mesh;
    Sphere head;
    Sphere socket;
  };
  const Published hips[] = {
      {"hip_vhf_right/hip_bone.ply", {Vec3::Zero(), 23.857}, {{-0.7409, 0.767, -0.1567}, 25.428}},
      {"hip_libhip_m1_left/coarse/hip_bone_2442.ply",
       {Vec3::Zero(), 26.158},
       {{0.0886, 0.7681, 0.7361}, 27.828}}};
  constexpr double spacing = 1.5, half = 51;
  // The inside rule moves a surface by less than half a voxel, in the worst case all of it in one direction.
  constexpr double tolerance = spacing / 2;
  for (const Published& hip : hips)
    for (const double deviation : {0.0, 0.5, 1.2}) {
      SCOPED_TRACE(testing::Message() << hip.mesh << ", blurred by " << deviation);
      LabelMap labels(test::read_ply(*data / hip.mesh), spacing, half);
      if (deviation > 0) labels.blur(deviation);
      const auto socket = kinematics::find_socket(labels.surface(), hip.head);
      ASSERT_TRUE(socket);
      EXPECT_LE((socket->fit.sphere.centre - hip.socket.centre).norm(), tolerance);
      EXPECT_NEAR(socket->fit.sphere.radius, hip.socket.radius, tolerance);
    }
}

TEST(FineSocket, IsFoundOnEverySampleHip) {
  // The last has a fifth of its sphere, in a long strip.
  for (const std::uint64_t k : {0u, 9u, 16u, 31u}) {
    const HipParameters measures = cohort_hip(7, k).measures;
    const SampleHip hip = sample_hip(measures, Scenario::one);
    const auto socket = kinematics::find_socket(hip.hip_bone, {Vec3::Zero(), measures.head_radius_mm});
    ASSERT_TRUE(socket) << k;
    EXPECT_LE(socket->fit.sphere.centre.norm(), 1e-6) << k;
    EXPECT_NEAR(socket->fit.sphere.radius, measures.head_radius_mm + measures.joint_space_mm, 1e-6) << k;
  }
}

}  // namespace
}  // namespace condyle::sample
