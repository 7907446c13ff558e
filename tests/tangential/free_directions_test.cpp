#include "tangential/build/free_directions.hpp"

#include "mesh/winding_number.hpp"
#include "support/test.hpp"
#include "tangential/build/rings.hpp"

namespace condyle::tangential {
namespace {

Vec3 at_radians(double rho, double angle, double z) {
  return {rho * std::cos(angle), rho * std::sin(angle), z};
}

TEST(FreeDirections, ATriangleIsNearTheDirectionsThatMeetIt) {
  // Across the direction at 45 degrees, across none, and around the axis.
  EXPECT_EQ(FreeDirections::near({5, 4, 0}, {4, 5, 0}, {6, 6, 1}), 1u << 1);
  EXPECT_EQ(FreeDirections::near({5, 1, 0}, {5, 2, 0}, {6, 2, 1}), 0u);
  EXPECT_EQ(FreeDirections::near({5, 0, 0}, {-4, 4, 0}, {-4, -4, 1}), 0xffu);
  // With a corner on the half-plane, and in a plane through the axis.
  EXPECT_EQ(FreeDirections::near({-5, 0, 0}, {-5, 1, 0}, {-6, 1, 1}), 1u << 4);
  EXPECT_EQ(FreeDirections::near({0, -2, 0}, {0, -3, 0}, {0, -3, 1}), 1u << 6);
}

TEST(FreeDirections, NoPointOfATriangleIsCloserInAngleToADirectionItIsNotNear) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-1, 1), weight(0, 1);
  std::size_t free = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 centre = 3 * Vec3(uniform(random), uniform(random), 0);
    const double size = std::exp2(-8 * weight(random));
    const auto corner = [&] { return Vec3(centre + size * Vec3(uniform(random), uniform(random), 0)); };
    const Vec3 a = corner(), b = corner(), c = corner();
    const auto near = FreeDirections::near(a, b, c);
    for (int k = 0; k < FreeDirections::count; ++k) {
      if (near >> k & 1) continue;
      ++free;
      for (int j = 0; j < 20; ++j) {
        double u = weight(random), v = weight(random);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const Vec3 p = a + u * (b - a) + v * (c - a);
        const double off =
            std::remainder(std::atan2(p.y(), p.x()) - FreeDirections::angle_of(k).radians(), two_pi);
        EXPECT_GT(std::abs(off), FreeDirections::clearance);
      }
    }
  }
  EXPECT_GT(free, 5000u);
}

TEST(FreeDirections, BetweenSectorsOfCornersAreTheDirectionsThatTheTriangleMeets) {
  EXPECT_EQ(FreeDirections::between(1u << 3), FreeDirections::Directions{0});
  EXPECT_EQ(FreeDirections::between(1u << 7 | 1u << 0), FreeDirections::Directions{1u << 0});
  EXPECT_EQ(FreeDirections::between(1u << 2 | 1u << 5),
            FreeDirections::Directions{1u << 3 | 1u << 4 | 1u << 5});
  EXPECT_EQ(FreeDirections::between(1u << 1 | 1u << 5), std::nullopt);
  EXPECT_EQ(FreeDirections::between(1u << 1 | 1u << 4 | 1u << 6), std::nullopt);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::size_t decided = 0, beyond = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 centre = 2 * Vec3(uniform(random), uniform(random), 0);
    Points corners;
    for (int k = 0; k < 3; ++k) corners.push_back(centre + Vec3(uniform(random), uniform(random), 0));
    const auto sectors =
        tangential::vertices_in_axis_frame(corners, AxisFrame(Vec3::Zero(), Vec3::UnitZ())).sector;
    unsigned all = 0;
    bool clear = true;
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = corners[static_cast<std::size_t>(k)];
      const unsigned sector = sectors[static_cast<std::size_t>(k)];
      const double eighths = std::fmod(std::atan2(p.y(), p.x()) / (two_pi / 8) + 8, 8);
      clear &= sector != 0, all |= sector;
      if (sector != 0) {
        EXPECT_EQ(sector, 1u << static_cast<unsigned>(eighths)) << p.transpose();
      }
    }
    if (!clear) continue;
    const auto between = FreeDirections::between(static_cast<FreeDirections::Sectors>(all));
    if (!between) continue;
    // `near` may name more, on the other side of the axis; no point of the triangle is near those.
    const auto near = FreeDirections::near(corners[0], corners[1], corners[2]);
    EXPECT_EQ(*between & near, *between);
    for (int k = 0; k < FreeDirections::count; ++k) {
      if (*between >> k & 1 || !(near >> k & 1)) continue;
      ++beyond;
      for (int j = 0; j < 20; ++j) {
        const Vec3 p = corners[0] + std::abs(uniform(random)) * (corners[1] - corners[0]);
        const Vec3 q = p + std::abs(uniform(random)) * (corners[2] - p);
        const double off =
            std::remainder(std::atan2(q.y(), q.x()) - FreeDirections::angle_of(k).radians(), two_pi);
        EXPECT_GT(std::abs(off), FreeDirections::clearance);
      }
    }
    ++decided;
  }
  EXPECT_GT(decided, 15000u);
  EXPECT_GT(beyond, 100u);
}

/// Bodies beside the axis, around it, pierced by it, nested, hollow: wherever a cell has a free direction,
/// the winding number there is the one of any point of the cell in that direction.
TEST(FreeDirections, TheWindingNumberInAFreeDirectionIsThatOfEveryPointThere) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> weight(0.01, 0.99);
  std::size_t all_inside = 0;
  for (const TriMesh& mesh :
       {test::sphere({12, 3, 1}, 7, 3), test::torus(8, 3, 31, 17), test::box({-5, -5, -5}, {5, 5, 5}),
        test::joined(test::sphere({12, 0, 0}, 6, 3), test::sphere({12, 0, 0}, 3, 3)),
        test::socket({10, 4, -3}, 8, 12, 3)}) {
    const Rings rings =
        tangential::build_rings(mesh, AxisFrame(Vec3::Zero(), Vec3::UnitZ()), 2 * mesh.triangles.size());
    const mesh::WindingNumber winding(mesh);
    const ProfileGrid& grid = rings.grid();
    std::size_t inside = 0, compared = 0;
    for (Index row = 0; row < grid.rows; ++row) {
      for (Index column = 0; column < grid.columns; ++column) {
        const auto anchor = rings.free_directions.of(grid.cell(row, column));
        if (anchor.direction == FreeDirections::none) continue;
        const double rho = grid.rho_min + (column + weight(random)) * grid.rho_cell;
        const double z = grid.z_min + (row + weight(random)) * grid.z_cell;
        const double angle = FreeDirections::angle_of(anchor.direction).radians();
        EXPECT_EQ(winding.at(at_radians(rho, angle, z)).winding, anchor.winding) << rho << " " << z;
        inside += anchor.winding > 0, ++compared;
      }
    }
    EXPECT_GT(compared, grid.cells() / 3);
    all_inside += inside;
  }
  EXPECT_GT(all_inside, 100u);
}

}  // namespace
}  // namespace condyle::tangential
