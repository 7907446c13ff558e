#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

/// The functions by which a model of OpenSim lets a joint's axes follow its coordinates.

namespace condyle::io {

struct ConstantFunction {
  double value = 0;
};

/// a1 q1 + ... + an qn + b.
struct LinearFunction {
  std::vector<double> slopes;
  double offset = 0;
};

/// Highest power first.
struct PolynomialFunction {
  std::vector<double> coefficients;
};

/// Straight from point to point; the first and the last piece go on.
struct PiecewiseLinearFunction {
  std::vector<double> x, y;
};

/// OpenSim's SimmSpline, which is no natural cubic: the spline of Forsythe, Malcolm and Moler (Computer Methods for
/// Mathematical Computations, 1977), whose third derivative at either end is that of the cubic through the four points there.
/// Beyond its ends it goes straight on.
class SimmSpline {
 public:
  /// Two points or more, x increasing, as many y.
  SimmSpline(std::vector<double> x, std::vector<double> y);

  double operator()(double q) const noexcept;

 private:
  double slope_after(std::size_t i) const noexcept;

  std::vector<double> x_, y_;
  std::vector<double> sixths_;  ///< of the second derivative at each point
};

struct ScaledFunction;

using ModelFunction = std::variant<ConstantFunction, LinearFunction, PolynomialFunction,
                                   PiecewiseLinearFunction, SimmSpline, ScaledFunction>;

/// MultiplierFunction: what scaled models put round their functions.
struct ScaledFunction {
  double scale = 1;
  std::shared_ptr<const ModelFunction> of;
};

/// Its value at these numbers; all functions but the linear one take the first alone.
double value_of(const ModelFunction& function, std::span<const double> q) noexcept;

/// How many numbers it takes; nothing if it takes any.
std::optional<std::size_t> arguments_of(const ModelFunction& function);

/// The function as slope * q + offset of one number, where it is that for every q.
struct StraightLine {
  double slope, offset;
};
std::optional<StraightLine> straight_line(const ModelFunction& function);

}  // namespace condyle::io
