#include "mesh/label_surface/contour.hpp"

#include "mesh/enclosed_volume.hpp"
#include "mesh/label_surface/cell_loops.hpp"
#include "support/test.hpp"
#include "support/voxel_masks.hpp"

namespace condyle::mesh {
namespace {

enum class Samples { uniform, of_all_sizes, equal_sizes, with_zeros, tiny_or_large };

/// Random samples inside, cut sides at random or none.
SampledField random_field(std::mt19937& random, Samples samples, bool cut) {
  SampledField field;
  std::array<std::size_t, 3> n;
  for (std::size_t a = 0; a < 3; ++a) {
    SampleAxis& axis = field.axis[a];
    axis.cut_low = cut && random() % 2 == 0;
    axis.cut_high = cut && random() % 2 == 0;
    const double centres = 2 + static_cast<double>(random() % 3);
    if (axis.cut_low) axis.coordinate.push_back(-0.5);
    axis.coordinate.push_back(axis.cut_low ? -0.5 : -1);
    for (double c = 0; c < centres; ++c) axis.coordinate.push_back(c);
    axis.coordinate.push_back(axis.cut_high ? centres - 0.5 : centres);
    if (axis.cut_high) axis.coordinate.push_back(centres - 0.5);
    n[a] = axis.size();
  }
  std::uniform_real_distribution<float> uniform(-1, 1);
  const auto sample = [&] {
    const float v = uniform(random), sign = v < 0 ? -1.0f : 1.0f;
    switch (samples) {
      case Samples::uniform:
        return v;
      case Samples::of_all_sizes:
        return sign * std::pow(10.0f, -8 * std::abs(uniform(random)));
      case Samples::equal_sizes:
        return sign / 2;
      case Samples::with_zeros:
        return (static_cast<float>(random() % 5) - 2) / 4;
      case Samples::tiny_or_large:
        break;
    }
    return sign * (random() % 2 == 0 ? 1.0f : 1e-20f);
  };
  const auto must_be_outside = [&](std::size_t a, std::size_t i) {
    const SampleAxis& axis = field.axis[a];
    return axis.is_outer(i) || (!axis.cut_low && i == 0) || (!axis.cut_high && i + 1 == axis.size());
  };
  for (std::size_t k = 0; k < n[2]; ++k)
    for (std::size_t j = 0; j < n[1]; ++j)
      for (std::size_t i = 0; i < n[0]; ++i)
        field.value.push_back(
            must_be_outside(0, i) || must_be_outside(1, j) || must_be_outside(2, k) ? -0.5f : sample());
  return field;
}

class RandomSamples : public testing::TestWithParam<Samples> {};

TEST_P(RandomSamples, HaveASoundSurface) {
  std::mt19937 random(5);
  for (const bool cut : {false, true}) {
    // Side by side in one mesh, which is looked at once.
    TriMesh all;
    for (int round = 0; round < 1000; ++round) {
      const TriMesh mesh = contour_of(random_field(random, GetParam(), cut))->mesh;
      test::append(all, test::shifted_by(mesh, {8.0 * (round % 32), 8.0 * (round / 32), 0}));
    }
    EXPECT_GT(all.triangles.size(), 20'000u);
    test::expect_sound(all);
  }
}

INSTANTIATE_TEST_SUITE_P(Contour, RandomSamples,
                         testing::Values(Samples::uniform, Samples::of_all_sizes, Samples::equal_sizes,
                                         Samples::with_zeros, Samples::tiny_or_large));

TEST(CellLoops, CrossEveryEdgeBetweenInsideAndOutsideOnce) {
  for (unsigned inside = 0; inside < 256; ++inside) {
    const unsigned ambiguous = ambiguous_faces(inside);
    for (unsigned joined = 0; joined < 64; ++joined) {
      if ((joined & ~ambiguous) != 0) continue;
      std::array<int, cell_edges> crossed{};
      const CellLoops loops = loops_of_cell(inside, joined);
      for (int l = 0; l < loops.size; ++l) {
        const CellLoop& loop = loops.loop[static_cast<std::size_t>(l)];
        EXPECT_GE(loop.size, 3);
        for (int i = 0; i < loop.size; ++i) ++crossed[loop.edge[static_cast<std::size_t>(i)]];
      }
      for (std::size_t e = 0; e < cell_edges; ++e) {
        const bool a = ((inside >> edge_ends[e][0]) & 1u) != 0, b = ((inside >> edge_ends[e][1]) & 1u) != 0;
        EXPECT_EQ(crossed[e], a != b ? 1 : 0) << inside << " " << joined << " " << e;
      }
    }
  }
}

/// Two samples a and d inside, b and c outside, on a square whose middle is inside exactly if a d > b c; the body is thick.
TEST(Contour, JoinsCornersOverAFaceWhoseMiddleIsInside) {
  const auto components = [](float a, float b, float c, float d) {
    SampledField field;
    for (SampleAxis& axis : field.axis) axis.coordinate = {-1, 0, 1, 2};
    field.value.assign(64, -1.0f);
    const auto at = [](std::size_t i, std::size_t j, std::size_t k) { return (k * 4 + j) * 4 + i; };
    for (const std::size_t k : {1u, 2u}) {
      field.value[at(1, 1, k)] = a, field.value[at(2, 1, k)] = b;
      field.value[at(1, 2, k)] = c, field.value[at(2, 2, k)] = d;
    }
    const Contour contour = *contour_of(field);
    test::expect_sound(contour.mesh);
    return inspect(contour.mesh).components.size();
  };
  EXPECT_EQ(components(0.5f, -0.4f, -0.5f, 0.5f), 1u);
  EXPECT_EQ(components(0.5f, -0.5f, -0.5f, std::nextafter(0.5f, 1.0f)), 1u);
  EXPECT_EQ(components(0.5f, -0.5f, -0.5f, 0.5f), 2u);
  EXPECT_EQ(components(0.5f, -0.6f, -0.5f, 0.5f), 2u);
}

TEST(Contour, KeepsTheMarginToSamples) {
  SampledField field;
  for (SampleAxis& axis : field.axis) axis.coordinate = {-1, 0, 1};
  for (const float inside : {0.0f, 1e-30f, 1e-4f, 1e-3f, 1.0f, 1e3f, 1e6f}) {
    field.value.assign(27, -1.0f);
    field.value[13] = inside;
    const Contour contour = *contour_of(field);
    test::expect_sound(contour.mesh);
    const double linear = static_cast<double>(inside) / (static_cast<double>(inside) + 1);
    for (std::size_t v = 0; v < contour.mesh.vertices.size(); ++v) {
      const double length = contour.mesh.vertices[v].norm();
      EXPECT_GE(length, contour_margin);
      EXPECT_LE(length, 1 - contour_margin);
      EXPECT_LE(std::abs(length - linear), contour_margin + 1e-15);
      if (linear >= 2 * contour_margin && linear <= 1 - 2 * contour_margin) {
        EXPECT_NEAR(length, linear, 1e-15);
      }
    }
    EXPECT_GT(enclosed_volume(contour.mesh), 0);
  }
}

TEST(Contour, IsEmptyIfStopped) {
  std::mt19937 random(1);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(contour_of(random_field(random, Samples::uniform, true), stop.get_token()));
}

}  // namespace
}  // namespace condyle::mesh
