#include "io/model/model_function.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace condyle::io {
namespace {

double rise(const std::vector<double>& x, const std::vector<double>& y, std::size_t i) noexcept {
  return (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
}

/// The third divided difference of four points, which is a sixth of the third derivative of the cubic through them.
double third_difference(const std::vector<double>& x, const std::vector<double>& y,
                        std::size_t first) noexcept {
  const auto second = [&](std::size_t i) { return (rise(x, y, i + 1) - rise(x, y, i)) / (x[i + 2] - x[i]); };
  return (second(first + 1) - second(first)) / (x[first + 3] - x[first]);
}

/// The piece that a number lies on, the first or the last one where it lies beyond them.
std::size_t piece_at(const std::vector<double>& x, double q) noexcept {
  const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, q);
  return static_cast<std::size_t>(above - x.begin()) - 1;
}

/// A system whose row i is below[i - 1], diagonal[i], above[i] about the diagonal.
std::vector<double> solved(std::vector<double> diagonal, const std::vector<double>& beside,
                           std::vector<double> right) {
  const std::size_t n = diagonal.size();
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = beside[i - 1] / diagonal[i - 1];
    diagonal[i] -= factor * beside[i - 1];
    right[i] -= factor * right[i - 1];
  }
  right[n - 1] /= diagonal[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) right[i] = (right[i] - beside[i] * right[i + 1]) / diagonal[i];
  return right;
}

}  // namespace

SimmSpline::SimmSpline(std::vector<double> x, std::vector<double> y) : x_(std::move(x)), y_(std::move(y)) {
  const std::size_t n = x_.size();
  assert(n >= 2 && y_.size() == n);
  sixths_.assign(n, 0);
  if (n == 2) return;
  std::vector<double> widths(n - 1), diagonal(n), right(n);
  for (std::size_t i = 0; i + 1 < n; ++i) widths[i] = x_[i + 1] - x_[i];
  for (std::size_t i = 1; i + 1 < n; ++i) {
    diagonal[i] = 2 * (widths[i - 1] + widths[i]);
    right[i] = rise(x_, y_, i) - rise(x_, y_, i - 1);
  }
  diagonal.front() = -widths.front();
  diagonal.back() = -widths.back();
  if (n > 3) {
    right.front() = widths.front() * widths.front() * third_difference(x_, y_, 0);
    right.back() = -widths.back() * widths.back() * third_difference(x_, y_, n - 4);
  }
  sixths_ = solved(std::move(diagonal), widths, std::move(right));
}

/// Slope of the tangent where piece i begins.
double SimmSpline::slope_after(std::size_t i) const noexcept {
  return rise(x_, y_, i) - (x_[i + 1] - x_[i]) * (sixths_[i + 1] + 2 * sixths_[i]);
}

double SimmSpline::operator()(double q) const noexcept {
  const std::size_t n = x_.size();
  if (q < x_.front()) return y_.front() + (q - x_.front()) * slope_after(0);
  if (q > x_.back()) {
    const double width = x_[n - 1] - x_[n - 2];
    const double slope = rise(x_, y_, n - 2) + width * (sixths_[n - 2] + 2 * sixths_[n - 1]);
    return y_.back() + (q - x_.back()) * slope;
  }
  const std::size_t i = piece_at(x_, q);
  const double t = q - x_[i], width = x_[i + 1] - x_[i];
  const double cubic = (sixths_[i + 1] - sixths_[i]) / width;
  return y_[i] + t * (slope_after(i) + t * (3 * sixths_[i] + t * cubic));
}

double value_of(const ModelFunction& function, std::span<const double> q) noexcept {
  return std::visit(
      [&](const auto& f) -> double {
        using F = std::decay_t<decltype(f)>;
        if constexpr (std::is_same_v<F, ConstantFunction>) {
          return f.value;
        } else if constexpr (std::is_same_v<F, LinearFunction>) {
          double sum = 0;
          for (std::size_t i = 0; i < f.slopes.size(); ++i) sum += f.slopes[i] * q[i];
          return sum + f.offset;
        } else if constexpr (std::is_same_v<F, PolynomialFunction>) {
          double value = 0;
          for (const double coefficient : f.coefficients) value = value * q[0] + coefficient;
          return value;
        } else if constexpr (std::is_same_v<F, PiecewiseLinearFunction>) {
          const std::size_t i = piece_at(f.x, q[0]);
          return f.y[i] + (q[0] - f.x[i]) * rise(f.x, f.y, i);
        } else if constexpr (std::is_same_v<F, SimmSpline>) {
          return f(q[0]);
        } else {
          return f.scale * value_of(*f.of, q);
        }
      },
      function);
}

std::optional<std::size_t> arguments_of(const ModelFunction& function) {
  if (const auto* scaled = std::get_if<ScaledFunction>(&function)) return arguments_of(*scaled->of);
  if (const auto* linear = std::get_if<LinearFunction>(&function)) return linear->slopes.size();
  if (std::holds_alternative<ConstantFunction>(function)) return std::nullopt;
  return 1;
}

std::optional<StraightLine> straight_line(const ModelFunction& function) {
  if (const auto* constant = std::get_if<ConstantFunction>(&function))
    return StraightLine{0, constant->value};
  if (const auto* linear = std::get_if<LinearFunction>(&function)) {
    if (linear->slopes.size() == 1) return StraightLine{linear->slopes[0], linear->offset};
    return std::nullopt;
  }
  if (const auto* scaled = std::get_if<ScaledFunction>(&function)) {
    const auto line = straight_line(*scaled->of);
    if (line) return StraightLine{scaled->scale * line->slope, scaled->scale * line->offset};
  }
  return std::nullopt;
}

}  // namespace condyle::io
