#include "core/predicates.hpp"

#include "core/exact_integers.hpp"

namespace condyle::core::exact {
namespace {

/// In place: predicates are asked from where nothing may fail, and integers that take memory could. Boost takes some to multiply two
/// of 40 limbs or more, and of two factors in a polynomial of degree three one has 34 at most.
template <unsigned bits>
using Within = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
    bits, bits, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;

/// Largest of the doubles as to_integers() has them, in bits.
template <std::size_t N>
int bits_of(const std::array<double, N>& in) {
  int lowest = std::numeric_limits<int>::max(), highest = std::numeric_limits<int>::min();
  for (const double value : in) {
    if (value == 0) continue;
    int e = 0;
    std::frexp(value, &e);
    lowest = std::min(lowest, e - 53);
    highest = std::max(highest, e);
  }
  return highest < lowest ? 0 : highest - lowest;
}

/// Apart, so that whoever needs few bits has not the stack of many: some 30 kB.
template <unsigned bits, std::size_t N>
[[gnu::noinline]] Sign sign_within(const std::array<double, N>& in, const auto& polynomial) {
  const Within<bits> value = polynomial(to_integers<N, Within<bits>>(in));
  return sign_of(value);
}

/// Sign of a polynomial of degree three of differences of the doubles, with six terms at most: of b bits, it has fewer than
/// 3 (b + 1) + 3. All doubles together span 2151; coordinates of bodies some 100, and with fewer limbs to clear the sign of
/// four points takes 500 ns instead of 830.
template <std::size_t N>
Sign sign_of_cubic(const std::array<double, N>& in, const auto& polynomial) {
  constexpr unsigned few = 512, enough = 6528;
  static_assert(3 * (2151 + 1) + 3 <= enough);
  return 3 * (bits_of(in) + 1) + 3 <= static_cast<int>(few) ? sign_within<few>(in, polynomial)
                                                            : sign_within<enough>(in, polynomial);
}

template <class Int>
Int determinant(const Int& ax, const Int& ay, const Int& az, const Int& bx, const Int& by, const Int& bz,
                const Int& cx, const Int& cy, const Int& cz) {
  return ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
}

}  // namespace

Sign determinant_2x2(double a, double b, double c, double d) noexcept {
  return sign_of_cubic<4>({a, b, c, d}, [](const auto& v) { return v[0] * v[3] - v[1] * v[2]; });
}

Sign orientation(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  return sign_of_cubic<9>({a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), c.x(), c.y(), c.z()}, [](const auto& v) {
    return determinant(v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]);
  });
}

Sign orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
  return sign_of_cubic<12>(
      {a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), c.x(), c.y(), c.z(), d.x(), d.y(), d.z()},
      [](const auto& v) {
        using Int = std::decay_t<decltype(v[0])>;
        return determinant<Int>(v[9] - v[0], v[10] - v[1], v[11] - v[2], v[3] - v[0], v[4] - v[1],
                                v[5] - v[2], v[6] - v[0], v[7] - v[1], v[8] - v[2]);
      });
}

Sign orientation_2d(double ax, double ay, double bx, double by, double cx, double cy) noexcept {
  return sign_of_cubic<6>({ax, ay, bx, by, cx, cy}, [](const auto& v) {
    return (v[2] - v[0]) * (v[5] - v[1]) - (v[3] - v[1]) * (v[4] - v[0]);
  });
}

}  // namespace condyle::core::exact
