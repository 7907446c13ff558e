#pragma once

/// Numbers of some 106 bits from doubles alone: the same bits on every machine, and compiled to WebAssembly, where long double is
/// another type on each.

namespace condyle::core {

/// A number as the sum of two doubles, the second at most half a unit in the last place of the first: some 106 bits.
/// T. J. Dekker, A floating-point technique for extending the available precision, Numerische Mathematik 18, 1971.
struct Pair {
  double high, low;
};

/// a + b exactly, where |a| >= |b| or a is 0.
constexpr Pair ordered_sum(double a, double b) noexcept {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}
/// a + b exactly.
constexpr Pair exact_sum(double a, double b) noexcept {
  const double sum = a + b, b_in_it = sum - a;
  return {sum, (a - (sum - b_in_it)) + (b - b_in_it)};
}
/// a b exactly, below some 10^300: halves of 26 bits, whose products are exact.
constexpr Pair exact_product(double a, double b) noexcept {
  const auto halves = [](double x) {
    const double moved = 0x1.0000002p27 * x, high = moved - (moved - x);
    return Pair{high, x - high};
  };
  const Pair p = halves(a), q = halves(b);
  const double product = a * b;
  return {product, ((p.high * q.high - product) + p.high * q.low + p.low * q.high) + p.low * q.low};
}

constexpr Pair operator-(Pair a) noexcept {
  return {-a.high, -a.low};
}
constexpr Pair operator+(Pair a, Pair b) noexcept {
  const Pair high = exact_sum(a.high, b.high), low = exact_sum(a.low, b.low);
  const Pair sum = ordered_sum(high.high, high.low + low.high);
  return ordered_sum(sum.high, sum.low + low.low);
}
constexpr Pair operator-(Pair a, Pair b) noexcept {
  return a + -b;
}
constexpr Pair operator*(Pair a, Pair b) noexcept {
  const Pair product = exact_product(a.high, b.high);
  return ordered_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

}  // namespace condyle::core
