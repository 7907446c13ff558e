#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/pose.hpp"
#include "io/model/model_function.hpp"
#include "io/model/xml_tree.hpp"

namespace condyle::io {

/// Whether an element of this name is a function, read or not.
bool is_function(std::string_view element) noexcept;

/// Reads the values of elements of a model; errors name the file, the line and what they are of.
class ModelElement {
 public:
  /// All borrowed. `of` begins what is said about it: "joint 'knee_r'".
  ModelElement(const Source& source, const XmlElement& element, std::string of = {})
      : source_(&source), element_(&element), of_(std::move(of)) {}

  const XmlElement& xml() const noexcept { return *element_; }
  const Source& source() const noexcept { return *source_; }

  [[noreturn]] void fail(std::string_view what) const { fail_at(*element_, what); }
  [[noreturn]] void fail_at(const XmlElement& element, std::string_view what) const;

  /// The first of these children that is there; null if none is.
  const XmlElement* first_of(std::initializer_list<std::string_view> names) const noexcept;

  /// Its name; fails for one that no joint file may have, as require_plain() does.
  std::string name() const;

  /// Fails for a text with control characters, or that is not UTF-8.
  void require_plain(std::string_view text, std::string_view what) const;

  // Values of children, or their defaults where a child is missing or empty.
  std::string text(std::string_view child) const;  ///< plain, as the name
  double number(std::string_view child, double otherwise) const;
  Vec3 triple(std::initializer_list<std::string_view> children, const Vec3& otherwise) const;
  bool flag(std::string_view child, bool otherwise) const;

  /// Numbers of an element, finite ones, separated by blanks and line ends.
  std::vector<double> numbers(const XmlElement& element) const;

  /// The function that an element is, or that stands in it under "function"; nothing if none does.
  std::optional<ModelFunction> function() const;

 private:
  ModelFunction function_of(const XmlElement& element, int depth) const;
  std::vector<double> required_numbers(const XmlElement& function, std::string_view child) const;
  void require_points(const XmlElement& function, const std::vector<double>& x,
                      const std::vector<double>& y) const;

  const Source* source_;
  const XmlElement* element_;
  std::string of_;
};

}  // namespace condyle::io
