#include "io/model/model_element.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/file/in_quotes.hpp"
#include "io/file/plain_text.hpp"
#include "io/file/words.hpp"

namespace condyle::io {
namespace {

constexpr std::string_view functions_read[] = {
    "Constant",   "LinearFunction",     "PolynomialFunction", "PiecewiseLinearFunction",
    "SimmSpline", "NaturalCubicSpline", "natCubicSpline",     "MultiplierFunction"};

}  // namespace

bool is_function(std::string_view element) noexcept {
  constexpr std::string_view others[] = {"Sine", "MultivariatePolynomialFunction", "SignalGenerator",
                                         "FunctionAdapter"};
  return std::find(std::begin(functions_read), std::end(functions_read), element) !=
             std::end(functions_read) ||
         std::find(std::begin(others), std::end(others), element) != std::end(others) ||
         element.ends_with("Function") || element.ends_with("Spline");
}

void ModelElement::fail_at(const XmlElement& element, std::string_view what) const {
  source_->fail(fmt::format("line {}: {}{}{}", element.line, of_, of_.empty() ? "" : ": ", what));
}

const XmlElement* ModelElement::first_of(std::initializer_list<std::string_view> names) const noexcept {
  for (const std::string_view name : names)
    if (const XmlElement* child = element_->child(name)) return child;
  return nullptr;
}

std::string ModelElement::name() const {
  std::string name = element_->label();
  require_plain(name, "its name");
  return name;
}

void ModelElement::require_plain(std::string_view text, std::string_view what) const {
  if (has_control_character(text)) fail(fmt::format("{} has a control character", what));
  if (end_of_utf8(text) != text.size()) fail(fmt::format("{} is not UTF-8", what));
}

std::string ModelElement::text(std::string_view child) const {
  const XmlElement* element = element_->child(child);
  std::string text = element ? element->text() : std::string();
  require_plain(text, child);
  return text;
}

std::vector<double> ModelElement::numbers(const XmlElement& element) const {
  std::vector<double> values;
  // XML joins what is before and after it, and OpenSim does not.
  if (element.has_comment_in_word())
    fail_at(element, fmt::format("{}: a comment stands inside a number", element.name));
  const std::string text = element.text();
  for (const std::string_view word : io::words_of(text)) {
    double value = 0;
    if (!parse_number(word, value))
      fail_at(element, fmt::format("{}: {} is no number", element.name, in_quotes(word)));
    if (!std::isfinite(value))
      fail_at(element, fmt::format("{}: {} is not finite", element.name, in_quotes(word)));
    values.push_back(value);
  }
  return values;
}

double ModelElement::number(std::string_view child, double otherwise) const {
  const XmlElement* element = element_->child(child);
  if (!element || element->text().empty()) return otherwise;
  const std::vector<double> values = numbers(*element);
  if (values.size() != 1)
    fail_at(*element, fmt::format("{}: one number is needed, not {}", child, values.size()));
  return values[0];
}

Vec3 ModelElement::triple(std::initializer_list<std::string_view> children, const Vec3& otherwise) const {
  const XmlElement* element = first_of(children);
  if (!element || element->text().empty()) return otherwise;
  const std::vector<double> values = numbers(*element);
  if (values.size() != 3)
    fail_at(*element, fmt::format("{}: three numbers are needed, not {}", element->name, values.size()));
  return {values[0], values[1], values[2]};
}

bool ModelElement::flag(std::string_view child, bool otherwise) const {
  const XmlElement* element = element_->child(child);
  const std::string text = element ? io::lower_case(element->text()) : std::string();
  if (text.empty()) return otherwise;
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  fail_at(*element, fmt::format("{}: {} is neither true nor false", child, in_quotes(text)));
}

std::vector<double> ModelElement::required_numbers(const XmlElement& function, std::string_view child) const {
  const XmlElement* element = function.child(child);
  std::vector<double> values = element ? numbers(*element) : std::vector<double>();
  if (values.empty()) fail_at(function, fmt::format("{}: {} is missing", function.name, child));
  return values;
}

void ModelElement::require_points(const XmlElement& function, const std::vector<double>& x,
                                  const std::vector<double>& y) const {
  if (x.size() != y.size())
    fail_at(function, fmt::format("{}: {} numbers x and {} y", function.name, x.size(), y.size()));
  if (x.size() < 2) fail_at(function, fmt::format("{}: two points or more are needed", function.name));
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!(x[i] > x[i - 1]))
      fail_at(function, fmt::format("{}: x must increase, and {} follows {}", function.name, x[i], x[i - 1]));
}

ModelFunction ModelElement::function_of(const XmlElement& element, int depth) const {
  const std::string_view name = element.name;
  const ModelElement values(*source_, element, of_);
  if (name == "Constant") return ConstantFunction{values.number("value", 0)};
  if (name == "LinearFunction") {
    std::vector<double> slopes = required_numbers(element, "coefficients");
    const double offset = slopes.back();
    slopes.pop_back();
    return LinearFunction{std::move(slopes), offset};
  }
  if (name == "PolynomialFunction") return PolynomialFunction{required_numbers(element, "coefficients")};
  if (name == "MultiplierFunction") {
    if (depth > 10) fail_at(element, "functions nested deeper than 10");
    const ModelElement inside(*source_, element, of_);
    const XmlElement* wrapper = element.child("function");
    if (!wrapper || wrapper->children.size() != 1)
      fail_at(element, "MultiplierFunction: one function is needed in it");
    return ScaledFunction{inside.number("scale", 1), std::make_shared<const ModelFunction>(
                                                         function_of(wrapper->children.front(), depth + 1))};
  }
  if (std::find(std::begin(functions_read), std::end(functions_read), name) == std::end(functions_read))
    fail_at(element, fmt::format("function {} is not read", in_quotes(name)));
  std::vector<double> x = required_numbers(element, "x"), y = required_numbers(element, "y");
  require_points(element, x, y);
  if (name == "PiecewiseLinearFunction") return PiecewiseLinearFunction{std::move(x), std::move(y)};
  return SimmSpline(std::move(x), std::move(y));
}

std::optional<ModelFunction> ModelElement::function() const {
  std::optional<ModelFunction> found;
  for (const XmlElement& child : element_->children) {
    const bool is_wrapper = child.name == "function" || child.name == "coupled_coordinates_function";
    if (is_wrapper && child.children.size() > 1)
      fail_at(child, fmt::format("{}: is more than one", child.name));
    if (is_wrapper ? child.children.empty() : child.name_attribute != "function" && !is_function(child.name))
      continue;
    if (found) fail_at(child, "a second function");
    found = function_of(is_wrapper ? child.children.front() : child, 0);
  }
  return found;
}

}  // namespace condyle::io
