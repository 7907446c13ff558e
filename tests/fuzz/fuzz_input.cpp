#include "fuzz/fuzz_input.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "condyle/angle.hpp"
#include "core/predicates.hpp"
#include "support/test_meshes.hpp"

namespace condyle::test {
namespace {

constexpr std::array units = {1.0, 0.1, 1e-3, 1e3, 1e-12, 1e12, 1e-30, 1e30, 1e-150, 5e-324, 1e58, 1e100};
constexpr std::array distances = {0.0, 0.0, 0.0, 1e6, 1e9, 1e-6};  // 1e6: a kilometre

constexpr std::uint8_t whole_numbers = 0xe0, next_doubles = 0xf0;
constexpr int zero = whole_numbers / 2;

}  // namespace

FuzzInput::FuzzInput(std::string_view bytes) : bytes_(bytes) {
  unit_ = units[below(units.size())];
  const double distance = distances[below(distances.size())];
  from_origin_ = {distance, -2 * distance, 0};
}

std::uint8_t FuzzInput::byte() noexcept {
  if (bytes_.empty()) return 0;
  const auto value = static_cast<std::uint8_t>(bytes_.front());
  bytes_.remove_prefix(1);
  return value;
}

double FuzzInput::any_double() noexcept {
  std::array<std::uint8_t, sizeof(double)> raw;
  for (auto& of : raw) of = byte();
  double value = 0;
  std::memcpy(&value, raw.data(), sizeof value);
  return value;
}

double FuzzInput::coordinate() noexcept {
  const int k = byte();
  if (k < whole_numbers) return (k - zero) * unit_;
  if (k >= next_doubles) return any_double();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return std::nextafter((byte() % whole_numbers - zero) * unit_, k % 2 == 0 ? infinity : -infinity);
}

Vec3 FuzzInput::point() noexcept {
  const double x = coordinate(), y = coordinate(), z = coordinate();
  return Vec3(x, y, z) + from_origin_;
}

Points FuzzInput::points(std::size_t most) noexcept {
  Points points;
  for (std::size_t count = 1 + below(most); count > 0; --count) points.push_back(point());
  return points;
}

TriMesh FuzzInput::mesh() {
  TriMesh mesh;
  switch (below(4)) {
    case 0:
      mesh.vertices = points(12);
      for (std::size_t count = 1 + below(16); count > 0; --count) {
        const auto corner = [&] { return static_cast<Index>(below(mesh.vertices.size())); };
        const Index a = corner(), b = corner(), c = corner();
        mesh.triangles.push_back({a, b, c});
      }
      return mesh;
    case 1:
      for (Index count = 1 + static_cast<Index>(below(4)), first = 0; count > 0; --count, first += 4) {
        for (int k = 0; k < 4; ++k) mesh.vertices.push_back(point());
        for (const Triangle& t : {Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{0, 3, 2}})
          mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      }
      return mesh;
    case 2: {
      const Vec3 low = point(), high = point();
      mesh = box(low, high);
      break;
    }
    default:
      mesh = below(2) == 0 ? sphere(from_origin_, 20 * unit_, 1)
                           : socket(from_origin_, 20 * unit_, 25 * unit_, 0);
  }
  for (std::size_t moved = below(6); moved > 0; --moved) {
    const std::size_t v = below(mesh.vertices.size());
    mesh.vertices.set(v, point());
  }
  return mesh;
}

AxisFrame FuzzInput::axis() {
  switch (below(4)) {
    case 0: {
      const Vec3 on_axis = point();
      return {on_axis, point()};
    }
    case 1:
      return {Vec3::Zero(), -Vec3::UnitX()};
    default:
      return {Vec3::Zero(), Vec3::UnitZ()};
  }
}

Pose FuzzInput::pose() {
  Pose X = Pose::Identity();
  const std::size_t kind = below(4);
  if (kind & 1) X.translation() = point();
  if (kind & 2) {
    const double x = byte() + 1.0, y = byte(), z = byte();
    X.linear() = Eigen::AngleAxisd(byte() * (two_pi / 256), Vec3(x, y, z).normalized()).toRotationMatrix();
  }
  return X;
}

bool is_degenerate(const TriMesh& mesh, std::size_t triangle) {
  const Vec3 a = mesh.corner(triangle, 0), b = mesh.corner(triangle, 1), c = mesh.corner(triangle, 2);
  for (int k = 0; k < 3; ++k) {
    const int i = k, j = (k + 1) % 3;
    if (core::orientation_2d(a[i], a[j], b[i], b[j], c[i], c[j]) != core::Sign::zero) return false;
  }
  return true;
}

}  // namespace condyle::test
